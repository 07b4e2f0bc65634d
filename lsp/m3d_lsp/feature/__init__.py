"""What the server answers, a module a feature. Adding one is a module: every module of this folder is a feature."""
