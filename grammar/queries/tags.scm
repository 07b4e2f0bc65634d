; Generated from language.toml by `make generate`.

(declaration name: (identifier) @name) @definition.constant

(assignment target: (identifier) @name) @reference.assignment

(assignment source: (identifier) @name) @reference.constant

(assignment value: (identifier) @name) @reference.constant

(block name: (identifier) @name) @reference.constant

(statement argument: (identifier) @name) @reference.constant

(vector component: (identifier) @name) @reference.constant

(table entry: (identifier) @name) @reference.constant
