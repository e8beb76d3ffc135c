"""All pairs, in the order of the table."""

from pairs import quadrics, shapes, shared, sheets


def catalogue():
    """Yields every pair; those of others' models only where these are there."""
    yield sheets.large_nets()
    yield quadrics.offset_spheres()
    yield quadrics.rotated_sphere()
    yield sheets.ridge()
    yield sheets.spike()
    yield sheets.saddle_in_ellipsoid(quadrics.sphere())
    yield quadrics.octant_fit()
    yield from shapes.pairs()
    yield from shared.pairs()
