; Generated from language.toml by `make generate`.

[(body) (variables) (table) (comment)] @fold
