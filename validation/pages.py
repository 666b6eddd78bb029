#!/usr/bin/python3
"""Every command that README, documentation and examples tell their reader to run, in full.

The tests run the same commands with the longest runs shortened (tests/documents/commands_test.py).

Usage: pages.py HERSEY [FOLDER]   (what HERSEY's build folder holds is tried; FOLDER is not needed)
exit code 0 if all of them ended well.
"""

import glob
import os
import subprocess
import sys

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
PLACES = ("README.md", "docs/*.md", "docs/*/*.md", "examples/*/README.md")


def has_commands(page):
    with open(page, encoding="utf-8") as file:
        return "\n```sh\n" in file.read()


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    build = os.path.dirname(os.path.abspath(sys.argv[1]))
    failed = 0
    pages = [page for place in PLACES for page in sorted(glob.glob(os.path.join(SOURCE, place))) if has_commands(page)]
    for page in pages:
        name = os.path.relpath(page, SOURCE)
        run = subprocess.run(["/usr/bin/python3", os.path.join(SOURCE, "tests/documents/commands_test.py"), SOURCE, build,
                              name, "--whole"], check=False)
        failed += run.returncode != 0
        print(f"{name}: {'as it says' if run.returncode == 0 else 'FAILED'}")
    print(f"{len(pages)} pages, {failed} failed")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
