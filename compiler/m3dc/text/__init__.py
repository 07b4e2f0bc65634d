"""Text and its places: sources, spans, comments, and what differs between two texts."""
