"""From text to the abstract syntax tree, and what is wrong where the text is broken."""
