"""Where things are."""

from pathlib import Path

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parent.parent
SHARED = REPOSITORY.parent / "shared" / "models"
# Made by a run, ignored by git.
ENVIRONMENT = HERE / ".venv"
WORK = HERE / ".work"
CGAL = WORK / "cgal-hausdorff"
BREP_KERNEL = WORK / "cargo" / "release" / "peer-brep-kernel"
