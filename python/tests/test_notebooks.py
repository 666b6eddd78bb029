"""The notebooks run from their first cell to their last."""

import os
import subprocess
import sys

import pytest
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "python" / "notebooks").glob("*.py"))


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs(notebook, tmp_path):
    os.symlink(ROOT / "examples", tmp_path / "examples")
    run = subprocess.run([sys.executable, "-W", "ignore", notebook], cwd=tmp_path, capture_output=True, text=True,
                         timeout=300, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    assert "# %%" in notebook.read_text(encoding="utf-8")


def test_there_are_five():
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    assert len(NOTEBOOKS) == 5 and all(f"`{path.name}`" in page for path in NOTEBOOKS)
