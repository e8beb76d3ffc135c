"""Rigid motions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._errors import NurbsHausdorffError

#: Largest difference of a matrix from that of its motion: the rounding of products of rotations. A
#: matrix that is farther off is another map, whose distances would be false.
MATRIX_ROUNDING = 1e-13


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
    def from_matrix(matrix: ArrayLike, *, tolerance: float = MATRIX_ROUNDING) -> Transform:
        """Make the motion of a matrix of shape (4, 4), last row (0, 0, 0, 1).

        Parameters
        ----------
        matrix : array of shape (4, 4)
            A rotation and a translation.
        tolerance : float, optional
            Largest difference of an entry from the motion's. Above the default, 1e-13, the nearest
            motion stands for a matrix that is another map: ``tolerance=1e-6`` takes matrices in
            single precision. Distances are then those of the motion.

        Raises
        ------
        NurbsHausdorffError
            ``TRANSFORM_NOT_RIGID`` for a matrix that is none of a rotation and a translation, with
            the difference; ``ARGUMENT_INVALID`` for one that is not real or of another shape.
        """
        plain = np.asarray(matrix)
        if plain.shape != (4, 4) or plain.dtype.kind not in "iuf" or np.ma.is_masked(matrix):
            raise NurbsHausdorffError(
                "ARGUMENT_INVALID",
                f"transform is {plain.dtype} of shape {plain.shape}, expected real numbers, none "
                "masked, of shape (4, 4)",
            )
        given = plain.astype(np.float64)
        x, y, z, w = _quaternion(given[:3, :3])
        a, b, c = given[:3, 3].tolist()
        motion = Transform((x, y, z, w), (a, b, c))
        difference = float(np.max(np.abs(motion.matrix() - given)))
        if not difference <= tolerance:
            raise NurbsHausdorffError(
                "TRANSFORM_NOT_RIGID",
                f"the matrix {given.tolist()} is off a rotation and translation by {difference:.3g}, "
                f"expected at most {tolerance:.3g}; Transform.from_matrix has a tolerance",
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
