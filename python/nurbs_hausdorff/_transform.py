"""Rigid motions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import NurbsHausdorffError

#: Largest difference of a matrix from that of its motion: the rounding of single precision.
MATRIX_TOLERANCE = 1e-5


@dataclass(frozen=True)
class Transform:
    """A rotation about the origin followed by a translation.

    Attributes
    ----------
    rotation : tuple of float
        Unit quaternion (x, y, z, w).
    translation : tuple of float
        (x, y, z), in model units.
    """

    rotation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    translation: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @staticmethod
    def from_matrix(matrix: ArrayLike) -> Transform:
        """Make the motion of a matrix of shape (4, 4), last row (0, 0, 0, 1).

        Raises
        ------
        NurbsHausdorffError
            ``TRANSFORM_NOT_RIGID`` for a matrix that is none of a rotation and a translation.
        """
        given = np.asarray(matrix, dtype=np.float64)
        if given.shape != (4, 4):
            raise NurbsHausdorffError(
                "ARGUMENT_INVALID", f"transform has shape {given.shape}, expected (4, 4)"
            )
        x, y, z, w = _quaternion(given[:3, :3])
        a, b, c = given[:3, 3].tolist()
        motion = Transform((x, y, z, w), (a, b, c))
        if not np.allclose(motion.matrix(), given, rtol=0.0, atol=MATRIX_TOLERANCE):
            raise NurbsHausdorffError(
                "TRANSFORM_NOT_RIGID", f"the matrix is no rotation and translation: {given.tolist()}"
            )
        return motion

    def matrix(self) -> NDArray[np.float64]:
        """Return the matrix, of shape (4, 4)."""
        x, y, z, w = self.rotation
        matrix = np.eye(4)
        matrix[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        matrix[:3, 3] = self.translation
        return matrix


def _quaternion(rotation: NDArray[np.float64]) -> list[float]:
    """Return the unit quaternion of a rotation matrix: the eigenvector of Bar-Itzhack 2000."""
    r = rotation
    k = np.array(
        [
            [r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[2, 1] - r[1, 2]],
            [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1], r[0, 2] - r[2, 0]],
            [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], r[0, 0] + r[1, 1] + r[2, 2]],
        ]
    )
    if not np.all(np.isfinite(k)):
        raise NurbsHausdorffError("TRANSFORM_NOT_RIGID", f"the matrix is {rotation.tolist()}")
    quaternion: list[float] = np.linalg.eigh(k)[1][:, -1].tolist()
    return quaternion


def native(transform: Transform | ArrayLike | None) -> tuple[
    tuple[float, float, float, float], tuple[float, float, float]
]:
    """Return the native form of a transform, or of a matrix of shape (4, 4)."""
    if transform is None:
        transform = Transform()
    elif not isinstance(transform, Transform):
        transform = Transform.from_matrix(transform)
    return transform.rotation, transform.translation
