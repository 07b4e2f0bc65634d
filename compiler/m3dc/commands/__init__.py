"""The commands m3dc and m3dfmt."""
