"""Builds the peers that are programs: one in C++ with Debian's CGAL, one in Rust."""

import os
import shutil
import subprocess

from places import BREP_KERNEL, CGAL, HERE, WORK

CGAL_SOURCE = HERE / "peers" / "cgal" / "hausdorff.cpp"
CGAL_PACKAGES = ["g++", "libcgal-dev"]
BREP_KERNEL_FOLDER = HERE / "peers" / "brep_kernel"


def build():
    """Builds what can be built, and says what cannot."""
    for name, make in (("CGAL", _cgal), ("BREP_kernel", _brep_kernel)):
        failure = make()
        if failure:
            print(f"SKIPPED program for {name}: {failure}", flush=True)


def _cgal():
    if CGAL.is_file() and CGAL.stat().st_mtime > CGAL_SOURCE.stat().st_mtime:
        return None
    installed = ["dpkg-query", "--show", *CGAL_PACKAGES]
    if (
        shutil.which("dpkg-query") is None
        or subprocess.run(installed, capture_output=True, check=False).returncode
    ):
        if shutil.which("apt-get") is None or os.geteuid() != 0:
            return f"install {' '.join(CGAL_PACKAGES)}"
        for command in (["update"], ["install", "--yes", "--no-install-recommends", *CGAL_PACKAGES]):
            subprocess.run(["apt-get", "--quiet", *command], capture_output=True, check=False)
    return _failure(
        ["g++", "-std=c++17", "-O3", "-DNDEBUG", str(CGAL_SOURCE), "-o", str(CGAL), "-lgmp", "-lmpfr"]
    )


def _brep_kernel():
    # Does nothing if it is built.
    target = BREP_KERNEL.parent.parent
    return _failure(
        ["cargo", "build", "--release", "--quiet", "--locked", "--target-dir", str(target)],
        cwd=BREP_KERNEL_FOLDER,
    )


def _failure(command, cwd=WORK):
    """Runs a compiler; the first line of what it complains about, if it fails."""
    try:
        run = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return f"no {command[0]}"
    return (run.stderr.strip().splitlines() or ["it failed"])[0] if run.returncode else None
