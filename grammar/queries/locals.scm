; Generated from language.toml by `make generate`.

(source_file) @local.scope

(declaration name: (identifier) @local.definition)

(identifier) @local.reference
