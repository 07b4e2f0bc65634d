"""What the server answers, a module a feature. Adding one is a module, and its name below."""

from . import configuration, diagnostics

MODULES = (configuration, diagnostics)
