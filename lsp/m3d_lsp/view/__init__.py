"""Views of what becomes of a scene, for read-only documents beside it (docs/protocol.md), a module a view."""
