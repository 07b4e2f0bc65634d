"""Files that are written whole or not at all, and work that can be interrupted."""
