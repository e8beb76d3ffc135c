"""The calls of the package."""
