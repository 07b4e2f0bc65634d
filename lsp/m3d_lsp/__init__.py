"""The language server of the Mirage3D scene language."""
