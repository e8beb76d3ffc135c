"""Results, as frozen dataclasses. Lengths are in model units."""
