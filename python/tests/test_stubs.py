"""The stubs of the extension module name what it has."""

import ast

from conftest import ROOT

from hersey import _core


def test_stubs_name_every_function_and_member():
    tree = ast.parse((ROOT / "python" / "hersey" / "_core.pyi").read_text(encoding="utf-8"))
    named = {node.name: {part.target.id if isinstance(part, ast.AnnAssign) else part.name for part in node.body
                         if isinstance(part, (ast.AnnAssign, ast.FunctionDef))} if isinstance(node, ast.ClassDef) else None
             for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    for name in (name for name in dir(_core) if not name.startswith("_")):
        assert name in named, name
        if named[name] is not None:
            members = {member for member in vars(getattr(_core, name)) if not member.startswith("_")}
            assert members == {member for member in named[name] if not member.startswith("_")}, name
