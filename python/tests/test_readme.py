"""The lines of the README, on the files that ship."""

import os
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def test_the_readme_finds_the_bore_that_moved(monkeypatch, capsys):
    readme = ROOT / "README.md"
    if not readme.exists():
        pytest.skip("the tests are not beside the repository")
    [block] = re.findall(r"```python\n(.*?)```", readme.read_text(), re.DOTALL)
    monkeypatch.chdir(ROOT)
    exec(compile(block, os.fspath(readme), "exec"), {})
    within, lower, upper = capsys.readouterr().out.split()
    # A bore of radius 9 is moved by 0.3: the far side of its wall is 0.3 from where it was.
    assert within == "False"
    assert float(lower) <= 0.3 <= float(upper)
