"""Writes the same points as LAS, LAZ and E57, for damage.py and as the seeds of the reader's fuzz target.

    python3 benches/trimmed/scan_samples.py FOLDER

Needs numpy, laspy with laszip, and pye57: LAZ is written by LASzip and E57 by libE57Format, which share no
code with the readers here; LAS by its specification. `FOLDER/seeds` has the files with the byte before them
that names their reader, as tests/soundness/fuzz/seeds/mesh_file/scans has them.
"""

import struct
import sys
from pathlib import Path

import laspy
import numpy as np
import pye57

COUNT = 40
SCALE, OFFSET = (0.001, 0.01, 0.5), (100.0, -20.0, 0.25)
# The readers' numbers in tests/soundness/fuzz/mesh_file.rs.
LAS, E57 = 6, 7


def integers() -> np.ndarray:
    """The integers of point k, which crates/meshes/src/scans/las/tests.rs has too."""
    k = np.arange(COUNT)
    return np.stack([k * k * 37 % 2003 - 900, 31 * k % 83, k % 7 - 3], axis=1).astype(np.int32)


def las() -> bytes:
    header = bytearray(227)
    header[:4], header[24:26] = b"LASF", bytes([1, 2])
    struct.pack_into("<HIIBHI", header, 94, 227, 227, 0, 0, 20, COUNT)
    struct.pack_into("<6d", header, 131, *SCALE, *OFFSET)
    return bytes(header) + b"".join(struct.pack("<3i8x", *point) for point in integers())


def laz(path: Path, point_format: int) -> None:
    header = laspy.LasHeader(point_format=point_format, version="1.4" if point_format >= 6 else "1.2")
    header.scales, header.offsets = SCALE, OFFSET
    header.add_extra_dim(laspy.ExtraBytesParams(name="more", type=np.int16))
    data = laspy.LasData(header)
    data.X, data.Y, data.Z = integers().T
    data.intensity = data.more = np.arange(COUNT)
    data.write(str(path), laz_backend=laspy.LazBackend.Laszip)


def e57(path: Path) -> None:
    """A scan that is turned from x to y to z and moved, whose every fifth point is invalid, and a plain one."""
    points = integers().astype(float)
    file = pye57.E57(str(path), mode="w")
    axes = {f"cartesian{axis}": points[:, place] for place, axis in enumerate("XYZ")}
    invalid = np.where(np.arange(COUNT) % 5 == 0, 2, 0)
    turn, shift = np.full(4, 0.5), np.array([10.0, 20.0, 30.0])
    file.write_scan_raw({**axes, "cartesianInvalidState": invalid}, name="turned", rotation=turn, translation=shift)
    grey = {color: np.arange(COUNT) for color in ("colorRed", "colorGreen", "colorBlue")}
    file.write_scan_raw({**axes, **grey}, name="plain", rotation=np.array([1.0, 0, 0, 0]), translation=np.zeros(3))
    file.close()


def main() -> None:
    folder = Path(sys.argv[1])
    seeds = folder / "seeds"
    seeds.mkdir(parents=True, exist_ok=True)
    (folder / "points.las").write_bytes(las())
    laz(folder / "points.laz", 1)
    laz(folder / "layers.laz", 7)
    e57(folder / "scans.e57")
    readers = {"points.las": LAS, "points.laz": LAS, "layers.laz": LAS, "scans.e57": E57}
    for name, reader in readers.items():
        seed = name.replace(".", "-")
        (seeds / seed).write_bytes(bytes([reader]) + (folder / name).read_bytes())


if __name__ == "__main__":
    main()
