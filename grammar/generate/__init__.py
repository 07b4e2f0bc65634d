"""Writes what is made of grammar/language.toml: `python -m generate`, in the folder grammar.

Each module makes one kind of file: `table` the table as JSON, `keywords` the keyword sets of the tree-sitter grammar,
`formal` the formal grammar, `automaton` its parse table, `queries` the editor queries, `textmate` and
`snippets` what VS Code colours and offers by itself, `reference` the language reference.
"""
