; Generated from language.toml by `make generate`.

[(body) (variables) (table)] @indent.begin

"}" @indent.branch @indent.end

(comment) @indent.ignore
