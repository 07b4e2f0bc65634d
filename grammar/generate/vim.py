"""The syntax file that colours a scene in Vim and Neovim.

It tells the roles of words as the TextMate grammar does. A word that is both a block and a property is no `keyword` of
Vim's, since these win over every match: of two matches at one place the later counts, so that the block's comes last.
"""

from __future__ import annotations

from collections.abc import Iterable

from m3d_language.table import Language

from . import keywords

_SYNTAX = r"""
if exists('b:current_syntax')
  finish
endif

syntax case match
syntax iskeyword @,48-57,_

{keywords}

syntax match m3dVariable /\<[A-Za-z][A-Za-z0-9_]*\>/
syntax match m3dProperty /\<\%({both}\)\>/
syntax match m3dBlock /\<\%({both}\)\>\ze\s*\%({{\|\/\*\|$\)/
" A malformed numeral is one token too.
syntax match m3dNumber /[+-]\?\.\?[0-9]\%([eE][+-]\|[A-Za-z0-9_.]\)*/
syntax match m3dOperator /=/
syntax match m3dDelimiter /[{{}}<>,;]/
" Comments nest.
syntax region m3dComment start=+/\*+ end=+\*/+ contains=m3dComment,@Spell
syntax sync minlines=300

highlight default link m3dBlock Type
highlight default link m3dProperty Statement
highlight default link m3dFlag Constant
highlight default link m3dKeyword Keyword
highlight default link m3dVariable Identifier
highlight default link m3dNumber Number
highlight default link m3dOperator Operator
highlight default link m3dDelimiter Delimiter
highlight default link m3dComment Comment

let b:current_syntax = 'm3d'
"""


def text(language: Language) -> str:
    """The text of m3d.vim."""
    roles = keywords.roles(language)
    lines = [
        _keyword("m3dBlock", roles.types),
        _keyword("m3dProperty", roles.properties),
        _keyword("m3dFlag", roles.flags),
        _keyword("m3dKeyword", roles.others),
    ]
    header = '" Generated from grammar/language.toml by `make generate`.\n'
    return header + _SYNTAX.format(keywords="\n".join(lines), both=r"\|".join(sorted(roles.both)))


def _keyword(group: str, words: Iterable[str]) -> str:
    return f"syntax keyword {group} {' '.join(sorted(words))}"
