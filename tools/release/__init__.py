"""Makes what others install: `make wheels` and `make release VERSION=x.y.z`.

`build` makes the wheels and source distributions, `proof` tries them as a stranger would, `bom` lists what is in them,
`checks` says whether this may be released at all. The tools that this needs (zig, maturin, auditwheel and more) are
those of the dependency group `release`, in an environment of their own: out/packaging/tools.
"""
