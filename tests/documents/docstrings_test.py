#!/usr/bin/python3
"""Every public function of a module's headers says what its name and types leave open, in a docstring above it."""

import glob
import os
import re
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))

TYPE_OR_NAMESPACE = re.compile(r"(?:template\s*<.*>\s*)?(?:inline\s+)?(namespace|class|struct|union|enum)\b\s*([\w:]*)", re.S)


def blanked(text):
    """The text without comments, strings and preprocessor lines, each character at its place."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#(?:\\\n|[^\n])*'
    return re.sub(pattern, lambda found: re.sub(r"[^\n]", " ", found[0]), text, flags=re.DOTALL | re.MULTILINE)


def closing(code, opening):
    """Where the brace at `opening` is closed."""
    depth = 0
    for at in range(opening, len(code)):
        depth += {"{": 1, "}": -1}.get(code[at], 0)
        if depth == 0:
            return at
    raise ValueError("an open brace")


def declarations(code, begin, end, is_public=True, scope=""):
    """(first character, last character, text, scope) of what is declared in the open and in public parts of types."""
    start, at, depth = None, begin, 0
    while at < end:
        char = code[at]
        if start is None and not char.isspace():
            if access := re.compile(r"(public|protected|private)\s*:(?!:)").match(code, at):
                is_public = access[1] == "public"
                at = access.end()
                continue
            start = at
        depth += {"(": 1, ")": -1}.get(char, 0)
        if depth == 0 and char == "{":
            head, last = code[start:at], closing(code, at)
            if kind := TYPE_OR_NAMESPACE.match(head):
                if kind[1] == "namespace" or (is_public and kind[1] in ("class", "struct")):
                    yield from declarations(code, at + 1, last, kind[1] != "class", kind[2])
                if kind[1] == "namespace":
                    start = None
            elif "(" in head and not re.match(r"\s*[,{]", code[last + 1:end]):  # a body, or the last of an initialiser list
                if is_public:
                    yield start, last, head, scope
                start = None
                if following := re.compile(r"\s*;").match(code, last + 1):
                    last = following.end() - 1
            at = last
        elif depth == 0 and char == ";":
            if is_public and start is not None:
                yield start, at, code[start:at], scope
            start = None
        at += 1


def name_of(declaration):
    """The function's name; None for whatever is no function."""
    text = re.sub(r"\[\[.*?\]\]", " ", declaration)
    while (shorter := re.sub(r"<[^<>()]*(?:\([^()]*\))?[^<>()]*>", " ", text)) != text:
        text = shorter
    text = re.sub(r"\btemplate\s*(requires\s*\([^()]*\))?", " ", text)
    before, bracket, _ = text.partition("(")
    if not bracket or "=" in before or "{" in before or re.match(r"\s*(using|friend|typedef|static_assert)\b", text):
        return None
    if "operator" in before:
        return "operator"
    found = re.search(r"(~?\w+)\s*$", before)
    return found[1] if found else None


class Docstrings(unittest.TestCase):
    def test_public_functions_have_one(self):
        faults = []
        for path in sorted(glob.glob(os.path.join(SOURCE, "libs/*/include/hersey/**/*.h"), recursive=True)):
            with open(path, encoding="utf-8") as file:
                text = file.read()
            faults += [f"{os.path.relpath(path, SOURCE)}:{line}: {name} has no docstring"
                       for line, name in self.bare_functions(text)]
        if faults:
            self.fail("\n".join(faults))

    def bare_functions(self, text):
        lines, code = text.splitlines(), blanked(text)
        group, group_ends = None, -1  # the function that a docstring is about, and the line where what it covers ends
        for start, end, declaration, scope in declarations(code, 0, len(code)):
            name = name_of(declaration)
            if name is None or self.speaks_for_itself(name, declaration, scope):
                continue
            first, last = text.count("\n", 0, start), text.count("\n", 0, end)
            has_own = lines[first - 1].lstrip().startswith("///") or any("///<" in line for line in lines[first:last + 1])
            is_accessor = re.search(r"\(\s*\)\s*const\b", declaration)
            if has_own:
                group = name
            elif not (group_ends == first - 1 and (name == group or is_accessor)):
                yield first + 1, name
                continue
            group_ends = last

    def speaks_for_itself(self, name, declaration, scope):
        """Operators, what overrides, destructors, and constructors that make a copy or nothing in particular."""
        if name == "operator" or name.startswith("~") or re.search(r"\b(override|final)\b|=\s*(default|delete)\s*$", declaration):
            return True
        return name == scope and re.search(rf"\b{scope}\s*\(\s*(const\s+)?({scope}\s*&&?\s*\w*)?\s*\)", declaration) is not None


if __name__ == "__main__":
    unittest.main(verbosity=2)
