"""The snippets of docs/python.md run, in their order."""

import os
import re

from conftest import ROOT


def test_snippets_run(tmp_path, monkeypatch):
    os.symlink(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    names = {}
    for match in re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        line = text.count("\n", 0, match.start()) + 2
        exec(compile("\n" * (line - 1) + match[1], "docs/python.md", "exec"), names)  # the page's line in a traceback
    assert "hersey" in names and (tmp_path / "out" / "own" / "results.h5").exists()
