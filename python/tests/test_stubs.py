"""The stubs of the extension module are those of what was built, and the package's own annotations fit together."""

import importlib.util
import os
import subprocess
import sys

import pytest
from conftest import ROOT

ALLOWED = ROOT / "python" / "tests" / "stubtest_allowlist.txt"

needs_mypy = pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")


def run(folder, *command):
    # What mypy knows of the libraries lies outside of the tree, where `scripts/python-tests` says; else it goes again.
    environment = {"MYPY_CACHE_DIR": str(folder / "cache")} | os.environ
    done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, cwd=folder, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr


@needs_mypy
def test_stubs_are_what_was_built(tmp_path):
    run(tmp_path, "mypy.stubtest", "hersey._core", "--concise", "--allowlist", str(ALLOWED))


@needs_mypy
def test_annotations_fit_together(tmp_path):
    run(tmp_path, "mypy", "--ignore-missing-imports", "-p", "hersey")
