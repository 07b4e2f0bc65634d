"""Scripts that make the documentation's pages and pictures: `make gallery`, and part of `make generate`."""
