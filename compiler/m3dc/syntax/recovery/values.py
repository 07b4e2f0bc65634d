"""Values: numbers, names and vectors, and what other languages write for them."""

from __future__ import annotations

import re

from m3d_language.table import LANGUAGE

from ...diagnostics import catalogue
from ...diagnostics.spelling import certain
from ...text.span import Span
from .. import ast, numerals
from . import skip, wording
from .calculation import colour_of
from .cursor import Cursor
from .expressions import OPERATORS, PARTS, operand_follows, pass_part, report_expression, report_percent
from .lexer import CLOSERS, Token

HEX_COLOUR = re.compile(r"#(?:[0-9a-fA-F]{3}|[0-9a-fA-F]{6})")
_VECTOR_WORDS = frozenset({"rgb", "rgba", "rgbf", "rgbt", "srgb", "color", "colour", "vec3", "float3", "vector"})
_NUMBERS = re.compile(r"[^\s,]+")
_DECIMAL_COMMA = re.compile(rb"[0-9],[0-9]")
_DASHES = frozenset("\u2212\u2013\u2014\u2010\u2011\ufe63\uff0d")


def starts_value(cursor: Cursor) -> bool:
    token = cursor.peek()
    if token.kind in ("number", "<", "word", "string", "hash"):
        return True
    if token.kind == "{":
        return is_bracketed(cursor)
    return token.text in ("-", "+", "(", "[") or token.text in _DASHES


def is_bracketed(cursor: Cursor) -> bool:
    """Whether a brace is used as the bracket of a vector or number: `{ 1, 2, 3 }`."""
    return cursor.peek().kind == "{" and cursor.peek(1).kind == "number"


def read_value(cursor: Cursor, shape: str | None, *, table: bool = False) -> ast.Argument | None:
    """A value, and what is taken for one; None where it stands for nothing certain."""
    first = cursor.peek()
    value = _operand(cursor, shape)
    if table:
        return value
    token = cursor.peek()
    operator = token.text in OPERATORS and token.kind == "other"
    signed = token.kind == "number" and token.text[0] in "+-" and (not token.gap or shape is not None)
    if token.text == "%" and not operand_follows(cursor, 1):
        report_percent(cursor, first, cursor.next())
        return value
    if token.kind == "other" and token.text in ("\u00b0", "\u2032", "\u2033"):
        says = f"{wording.found(token)}; angles are in degrees, without a unit"
        edits = [(token.span, "")] if token.text == "\u00b0" else None
        cursor.invalid_here(token.span, says, edits=edits, title="Remove it")
        cursor.next()
        return value
    if token.text in PARTS and first.kind == "word" and cursor.before == first.end and not token.gap:
        pass_part(cursor)
        return report_expression(cursor, first)
    if token.text == "?" or (token.kind == ">" and cursor.peek(1).kind in ("number", "word") and shape == "number"):
        while (token := cursor.peek()).kind not in ("keyword", "{", "}", "end", ";") and not token.first:
            cursor.next()
        return report_expression(cursor, first)
    if (operator and operand_follows(cursor, 1)) or (signed and isinstance(value, (ast.Number, ast.Name)) and shape):
        return report_expression(cursor, first)
    return value


def report_bare_vector(cursor: Cursor, first: Token) -> None:
    """Report the numbers from `first` on, of which one is still to come, as a vector without its brackets."""
    while (token := cursor.peek()).kind in ("number", ","):
        cursor.next()
    numbers = _NUMBERS.findall(cursor.data[first.start : cursor.before].decode("utf-8", "replace"))
    if token.kind == ">":
        cursor.next()
    edits = [((first.start, cursor.before), f"< {', '.join(numbers)} >")] if len(numbers) == 3 else None
    title = f"Write {edits[0][1]}" if edits else ""
    span = (first.start, cursor.before)
    cursor.faults.add(catalogue.EXPECTED_VECTOR, span, "a vector stands between < and >", edits=edits, title=title)
    cursor.doubtful = True


def _operand(cursor: Cursor, shape: str | None) -> ast.Argument | None:
    token = cursor.next()
    if token.kind == "number":
        return _number(cursor, token.span)
    if token.kind == "<":
        return _vector(cursor, token)
    if token.kind == "word":
        return _name_or_call(cursor, token, shape)
    if token.kind == "hash":
        return _hash(cursor, token)
    if token.kind == "string":
        return _string_value(cursor, token, shape)
    if token.text in CLOSERS:
        return _bracketed(cursor, token, shape)
    return _sign(cursor, token)


def _number(cursor: Cursor, span: Span) -> ast.Number:
    value, fault = numerals.read(cursor.data[slice(*span)])
    if fault is not None:
        place = (span[0] + fault.start, span[1])
        cursor.faults.findings.add(fault.entry, place, fault.detail, fix=fault.fix(span))
    return ast.Number(value, cursor.relative(span))


def _name_or_call(cursor: Cursor, token: Token, shape: str | None) -> ast.Argument | None:
    after = cursor.peek()
    is_word = token.text.lower() in _VECTOR_WORDS
    if after.kind == "<" and (shape == "vector" or is_word):
        says = "leave it out: a colour is three numbers" if is_word else "a vector stands alone"
        edits = [((token.start, after.start), "")] if is_word else None
        cursor.invalid_here(token.span, f"{wording.found(token)}; {says}", edits=edits, title="Remove it")
        if not is_word:
            cursor.doubtful = True
        return _vector(cursor, cursor.next())
    if after.text == "(" and is_word:
        bracket = cursor.next()
        return _bracketed(cursor, bracket, "vector", token)
    if is_word and after.kind == "number" and shape == "vector":
        cursor.next()
        text = f"< {after.text}, {after.text}, {after.text} >"
        span = (token.start, after.end)
        cursor.faults.add(
            catalogue.EXPECTED_VECTOR, span, "a colour is three numbers", edits=[(span, text)], title=f"Write {text}"
        )
        cursor.doubtful = True
        return None
    name = ast.Name(token.text, cursor.relative(token.span))
    cursor.check_length(name)
    return name


def _hash(cursor: Cursor, token: Token) -> ast.Argument | None:
    if HEX_COLOUR.fullmatch(token.text):
        text = colour_of(token.text)
        says = f"{wording.found(token)}; a colour is three numbers between 0 and 1: {text}"
        cursor.faults.add(
            catalogue.EXPECTED_VECTOR, token.span, says, edits=[(token.span, text)], title=f"Write {text}"
        )
    else:
        cursor.faults.add(catalogue.INVALID_AT_TOP, token.span, wording.found(token))
    cursor.doubtful = True
    return None


def _string_value(cursor: Cursor, token: Token, shape: str | None) -> ast.Argument | None:
    inner = token.text[1:-1].strip()
    if HEX_COLOUR.fullmatch(inner):
        return _hash(cursor, token._replace(text=inner))
    colour = LANGUAGE.colours.get(inner.lower()) if shape != "number" else None
    if colour is not None:
        says = f"found {wording.shown(token)}; a colour is three numbers between 0 and 1: {colour}"
        edits, title = [(token.span, colour)], f"Write {colour}"
        cursor.faults.add(catalogue.EXPECTED_VECTOR, token.span, says, edits=edits, title=title, sure=shape == "vector")
    else:
        cursor.invalid_here(token.span, f"found {wording.shown(token)}; there are no texts in quotes")
    cursor.doubtful = True
    return None


def _sign(cursor: Cursor, token: Token) -> ast.Argument | None:
    after = cursor.peek()
    if after.kind == "number":
        cursor.next()
        if after.text[0] in "+-":
            return report_expression(cursor, token)
        says = f"{wording.found(token)}; a minus sign is -" if token.text in _DASHES else (
            f"{wording.found(token)}; a sign stands right before its number, without a blank"
        )  # fmt: skip
        sign = "-" if token.text in _DASHES else token.text
        edits = [((token.start, after.start), sign)]
        cursor.faults.add(catalogue.EXPECTED_NUMBER, token.span, says, edits=edits, title=f"Write {sign}{after.text}")
        number = _number(cursor, after.span)
        return number._replace(value=-number.value if sign == "-" else number.value,
                               span=cursor.relative((token.start, after.end)))  # fmt: skip
    if after.kind in ("word", "<") or after.text in ("(", "-", "+"):
        cursor.next() if after.kind == "word" else None
        if after.kind == "<":
            skip.vector(cursor)
        if after.text == "(":
            skip.brackets(cursor)
        says = f"{wording.found(token)}; a sign belongs to a number, not to a "
        says += "vector: write it in front of each" if after.kind == "<" else "variable: write another variable"
        cursor.faults.add(catalogue.NO_EXPRESSIONS, (token.start, cursor.before), says)
    else:
        cursor.invalid_here(token.span, wording.found(token))
    cursor.doubtful = True
    return None


def _bracketed(cursor: Cursor, opener: Token, shape: str | None, word: Token | None = None) -> ast.Argument | None:
    """A vector or number in brackets that are not those of the language."""
    closer = CLOSERS[opener.text]
    first = word or opener
    inside: list[ast.Argument] = []
    start = cursor.before
    simple = True
    while (token := cursor.peek()).kind not in ("end", "keyword", "}") and token.text != closer:
        if token.kind in ("number", "word") and cursor.peek(1).text in (",", closer):
            inside += [
                _number(cursor, token.span)
                if token.kind == "number"
                else ast.Name(token.text, cursor.relative(token.span))
            ]
            cursor.next()
        elif token.kind == "," and inside and cursor.peek(1).kind in ("number", "word"):
            cursor.next()
        else:
            simple = False
            cursor.next()
    end = cursor.before
    if cursor.peek().text == closer:
        cursor.next()
    span = (first.start, cursor.before)
    text = cursor.data[start:end].decode("utf-8", "replace").strip()
    if simple and len(inside) == 3 and not any(isinstance(each, ast.Vector) for each in inside):
        new = f"< {text} >"
        values = [each.value for each in inside if isinstance(each, ast.Number)]
        if word is not None and word.text.lower() == "rgb" and len(values) == 3 and 1 < max(values) <= 255:
            new = f"< {', '.join(f'{round(value / 255, 3):g}' for value in values)} >"
            says = f"a colour is three numbers between 0 and 1: {new}"
            cursor.faults.add(catalogue.EXPECTED_VECTOR, span, says, edits=[(span, new)], title=f"Write {new}")
            cursor.doubtful = True
            return None
        cursor.faults.add(
            catalogue.EXPECTED_VECTOR,
            span,
            "a vector stands between < and >",
            edits=[(span, new)],
            title=f"Write {new}",
        )
        components = tuple(each for each in inside if not isinstance(each, ast.Vector))
        return ast.Vector(components, cursor.relative(span))
    cursor.doubtful = True
    if simple and len(inside) == 1 and cursor.peek().kind == "number" and text.lower() in LANGUAGE.types_elsewhere:
        says = f"found '({text})'; a number is of no other type"
        cursor.faults.add(catalogue.EXPECTED_NUMBER, span, says, edits=[(span, "")], title="Remove it")
        cursor.doubtful = False
        return _number(cursor, cursor.next().span)
    if simple and len(inside) == 1:
        detail = "a number stands alone, without brackets"
        cursor.faults.add(
            catalogue.EXPECTED_NUMBER,
            first.span,
            f"{wording.found(first)}; {detail}",
            edits=[(span, text)],
            title=f"Write {text}",
        )
        cursor.doubtful = False
        return inside[0]
    if shape == "vector":
        cursor.faults.add(catalogue.EXPECTED_VECTOR, span, "a vector is three numbers < x, y, z >")
    else:
        report_expression(cursor, first)
    return None


def _vector(cursor: Cursor, opener: Token) -> ast.Vector | None:
    components: list[ast.Number | ast.Name] = []
    good = True
    doubled = cursor.peek().kind == "<" and not cursor.peek().gap
    if doubled:
        cursor.faults.superfluous(cursor.next(), "a vector stands between < and >")
    while True:
        token = cursor.peek()
        if token.kind in ("number", "word") or token.text in ("-", "+", "(") or token.text in _DASHES:
            value = _component(cursor, len(components))
            if value is None:
                good = False
                components.append(ast.Number(0.0, cursor.relative(token.span)))
            else:
                components.append(value)
        else:
            break
        token = cursor.peek()
        if token.kind == ",":
            if len(components) == 3 and cursor.peek(1).kind in ("number", "word"):
                says = f"{wording.found(token)}; a vector has three numbers < x, y, z >"
                if _DECIMAL_COMMA.search(cursor.data, opener.end, token.end):
                    says += "; a decimal point is a point, as in 2.5"
                cursor.faults.add(catalogue.MISSING_MARK, token.span, says, fill=">")
                cursor.doubtful = True
                while cursor.peek().kind in (",", "number", "word"):
                    cursor.next()
                break
            cursor.next()
        elif token.kind == ";" and len(components) < 3 and cursor.peek(1).kind == "number":
            says = f"{wording.found(token)}; the numbers of a vector are separated by commas"
            edits, kind = [(token.span, ",")], "semicolon in a vector"
            cursor.faults.add(
                catalogue.MISSING_MARK, token.span, says, fill=",", edits=edits, title="Write ','", kind=kind
            )
            cursor.next()
        elif token.kind in ("number", "word") and len(components) < 3:
            if token.kind == "word" and (token.first or certain(token.text, LANGUAGE.keywords)):
                break
            cursor.missing(",")
        else:
            break
    token = cursor.peek()
    count = len(components)
    if count < 3:
        says = f"{wording.found(token)}; a vector has three numbers < x, y, z >"
        entry, fill = (catalogue.MISSING_MARK, ",") if count else (catalogue.EXPECTED_NUMBER, "")
        cursor.faults.add(entry, cursor.place(token), says, fill=fill)
        cursor.doubtful = True
        good = False
    if token.kind == ">":
        cursor.next()
        if doubled and cursor.peek().kind == ">":
            more = cursor.next()
            cursor.faults.add(catalogue.SUPERFLUOUS, more.span, "", edits=[(more.span, "")], kind="<")
    elif count >= 3 or token.kind in ("}", "keyword", "end", "word"):
        if count >= 3:
            _close_vector(cursor, token)
    else:
        skip.rest_of_vector(cursor)
    if not good or count < 3:
        return None
    return ast.Vector(tuple(components[:3]), cursor.relative((opener.start, cursor.before)))


def _close_vector(cursor: Cursor, token: Token) -> None:
    if token.text in (")", "]"):
        cursor.faults.add(
            catalogue.MISSING_MARK,
            token.span,
            wording.found(token),
            fill=">",
            edits=[(token.span, ">")],
            title="Write '>'",
        )
        cursor.next()
        return
    if token.kind == "number":
        cursor.faults.add(
            catalogue.MISSING_MARK,
            token.span,
            f"{wording.found(token)}; a vector has three numbers < x, y, z >",
            fill=">",
        )
        cursor.doubtful = True
        skip.rest_of_vector(cursor)
        return
    if token.kind == "other" or token.kind in (";", "string", "name", "hash"):
        cursor.faults.add(catalogue.MISSING_MARK, token.span, wording.found(token), fill=">")
        cursor.doubtful = True
        skip.rest_of_vector(cursor)
        return
    cursor.missing(">")


def _component(cursor: Cursor, before: int) -> ast.Number | ast.Name | None:
    """A component of a vector, of which so many stand `before` it."""
    first = cursor.peek()
    value = _operand(cursor, None)
    token = cursor.peek()
    if token.text in PARTS and first.kind == "word" and not token.gap:
        pass_part(cursor)
        report_expression(cursor, first)
        return None
    if token.kind == "other" and token.text in OPERATORS and operand_follows(cursor, 1):
        report_expression(cursor, first)
        return None
    signed = token.kind == "number" and token.text[0] in "+-" and isinstance(value, (ast.Number, ast.Name))
    # With the comma there are three numbers: it is missing. Otherwise something is calculated.
    if signed and (not token.gap or _numbers_to_close(cursor) + before + 1 != 3):
        report_expression(cursor, first)
        return None
    return value if not isinstance(value, ast.Vector) else None


def _numbers_to_close(cursor: Cursor) -> int:
    """How many numbers stand up to the end of the vector."""
    count = ahead = 0
    while (token := cursor.peek(ahead)).kind in ("number", "word", ","):
        count += token.kind != ","
        ahead += 1
    return count
