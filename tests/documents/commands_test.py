#!/usr/bin/python3
"""commands_test.py SOURCE BUILD PAGE   runs the commands that a page tells its reader to run.

Every ```sh block of the page is executed, in order, in a folder that looks like the repository's root with the program
built; ```text blocks are not.
"""

import os
import re
import subprocess
import sys
import tempfile

SOURCE, BUILD, PAGE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]


def blocks(text):
    """The ```sh blocks of a page, with the line each starts in."""
    for match in re.finditer(r"^```sh\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, match.start()) + 2, match.group(1)


def stand_in_for_the_repository(folder):
    """Links to the sources, with build/release being the build under test, so that nothing is written to either."""
    for name in os.listdir(SOURCE):
        if not name.startswith((".", "build")):
            os.symlink(os.path.join(SOURCE, name), os.path.join(folder, name))
    os.mkdir(os.path.join(folder, "build"))
    os.symlink(BUILD, os.path.join(folder, "build/release"))


def main():
    with open(os.path.join(SOURCE, PAGE), encoding="utf-8") as file:
        found = list(blocks(file.read()))
    if not found:
        sys.exit(f"{PAGE} has no commands to try")
    failed = 0
    with tempfile.TemporaryDirectory(prefix="hersey-docs-") as folder:
        stand_in_for_the_repository(folder)
        for line, commands in found:
            run = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, text=True, capture_output=True,
                                 stdin=subprocess.DEVNULL, timeout=280, check=False)
            if run.returncode != 0:
                failed += 1
                print(f"{PAGE}:{line}: exit code {run.returncode}\n{commands}\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
