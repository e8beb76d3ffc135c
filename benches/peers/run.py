"""Installs the peers and measures them: `python3 benches/peers/run.py [--help]`.

Makes a virtual environment beside this file, installs the peers in it from PyPI
and Debian, builds those that must be built, and runs `bench.py`. What cannot be
installed is said, and the run goes on without.
"""

import subprocess
import sys
import venv

from build import build
from places import ENVIRONMENT, HERE, REPOSITORY, WORK


def main():
    WORK.mkdir(exist_ok=True)
    python = str(ENVIRONMENT / "bin" / "python")
    if not (ENVIRONMENT / "bin" / "python").is_file():
        venv.create(ENVIRONMENT, with_pip=True)
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    # The benchmark itself cannot do without these; without a peer it can.
    subprocess.run([*pip, "-r", str(HERE / "requirements.txt")], check=True)
    for line in (HERE / "requirements-peers.txt").read_text().split():
        # One by one, so that one that cannot be had does not take the others with it.
        if subprocess.run([*pip, line], check=False).returncode:
            print(f"SKIPPED package {line}: pip could not install it", flush=True)
    subprocess.run(
        ["cargo", "build", "--release", "--quiet", "--bin", "nurbs-hausdorff"], cwd=REPOSITORY, check=True
    )
    build()
    sys.exit(subprocess.run([python, str(HERE / "bench.py"), *sys.argv[1:]], check=False).returncode)


if __name__ == "__main__":
    main()
