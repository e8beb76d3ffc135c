"""Files exported again by OpenCASCADE: no face may count as changed beyond the gaps.

    python exports.py FILE.stp…

needs cadquery-ocp. Each file is read by OpenCASCADE and written as STEP; the limit of `diff` is a
millionth of the diagonal. One line a file: faces by state, and by the state that holds for the
files themselves, whose faces are known up to their gaps.
"""

import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import nurbs_hausdorff as nh
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.STEPControl import STEPControl_Reader, STEPControl_StepModelType, STEPControl_Writer

#: The limit, as a fraction of the diagonal.
RELATIVE_LIMIT = 1e-6


def exported(source: Path, target: Path) -> None:
    """Read a STEP file and write it again."""
    reader, writer = STEPControl_Reader(), STEPControl_Writer()
    if reader.ReadFile(str(source)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        sys.exit(f"{source} cannot be read")
    reader.TransferRoots()
    writer.Transfer(reader.OneShape(), STEPControl_StepModelType.STEPControl_AsIs)
    if writer.Write(str(target)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        sys.exit(f"{target} cannot be written")


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        for path in map(Path, sys.argv[1:]):
            again = Path(folder) / f"{path.stem}.step"
            exported(path, again)
            a, b = nh.read(path), nh.read(again)
            low, high = a.bounding_box
            limit = RELATIVE_LIMIT * float(((high - low) ** 2).sum() ** 0.5)
            begun = time.process_time()
            result = nh.diff(a, b, limit=limit)
            seconds = time.process_time() - begun
            faces = result.faces_of_a + result.faces_of_b
            for face in faces:
                if face.with_gaps == "changed":
                    print("  changed:", face, file=sys.stderr)
            print(
                f"{path.name}: limit {limit:.2g}, gaps {result.gap:.2g}, {len(faces)} faces,",
                f"{dict(Counter(face.state for face in faces))},",
                f"of the files {dict(Counter(face.with_gaps for face in faces))},",
                f"largest {max(face.lower for face in faces):.3g},",
                f"left out {len(a.report.skipped)} and {len(b.report.skipped)}, {seconds:.2f} s of CPU",
            )


if __name__ == "__main__":
    main()
