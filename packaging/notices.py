#!/usr/bin/python3
"""notices.py PROGRAM FOLDER   writes what a Debian package has to say of licences: FOLDER/copyright, hersey's own in Debian's
format with the notices of what is compiled in, and FOLDER/licences/PACKAGE, the notice of each library that the program links.

A library that THIRD_PARTY.md does not name, or whose notice is not installed, ends it with an error."""

import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
HEAD = """Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: hersey
Comment: The full notices of every library that the program links or contains are in /usr/share/doc/hersey/licences,
 the list of them, with the texts of the MIT and BSD-3-Clause licences, in /usr/share/doc/hersey/THIRD_PARTY.md.
 Compiled in or contained in reports:
{contained}

Files: *
Copyright: {holder}
License: BSD-3-Clause
"""


def read(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return file.read()


def indented(text):
    return "".join(f" {line.strip() or '.'}\n" for line in text.strip().splitlines())


def third_parties():
    """(library, [Debian packages], licence, holders) of each row of THIRD_PARTY.md's tables."""
    for row in re.findall(r"^\| (?!library|package|-)(.+) \|$", read("THIRD_PARTY.md"), re.MULTILINE):
        cells = [cell.strip() for cell in row.split("|")]
        yield (cells[0], cells[1].split(", "), *cells[2:4]) if len(cells) == 5 else (cells[0], [], *cells[1:3])


def linked_packages(program):
    """The Debian packages of the libraries that the program itself asks for."""
    needed = re.findall(r"NEEDED\s+(\S+)", subprocess.run(["objdump", "-p", program], text=True, capture_output=True, check=True).stdout)
    where = dict(re.findall(r"(\S+) => (\S+)", subprocess.run(["ldd", program], text=True, capture_output=True, check=True).stdout))
    for name in needed:
        if name.startswith("ld-linux"):
            continue
        path = os.path.realpath(where.get(name, name))
        # Merged /usr: packages register their libraries below either.
        found = subprocess.run(["dpkg-query", "-S", path, path.removeprefix("/usr")], text=True, capture_output=True, check=False)
        yield name, found.stdout.split(":")[0] if found.stdout else None


def copyright_file():
    licence = read("LICENSE")
    holder = re.search(r"^Copyright (?:\(c\) )?(.+)$", licence, re.MULTILINE | re.IGNORECASE).group(1)
    contained = [f" {library}: {terms}, {holders}" for library, packages, terms, holders in third_parties()
                 if not packages or any(package.endswith("-dev") for package in packages)]
    return HEAD.format(holder=holder, contained="\n".join(contained)) + indented(licence)


def main():
    program, folder = sys.argv[1:]
    licences = os.path.join(folder, "licences")
    shutil.rmtree(licences, ignore_errors=True)
    os.makedirs(licences)
    named = {package for _, packages, *_ in third_parties() for package in packages}
    linked = dict(linked_packages(program))
    unnamed = {name: package for name, package in linked.items() if package not in named | {"libc6"}}
    if unnamed:
        sys.exit(f"notices: the program links what THIRD_PARTY.md does not name: {unnamed}")
    for package in sorted(named):
        notice = f"/usr/share/doc/{package}/copyright"
        if os.path.exists(notice):
            shutil.copyfile(notice, os.path.join(licences, package))
        elif package in linked.values() or package.endswith("-dev"):
            sys.exit(f"notices: {notice} is missing")
    with open(os.path.join(folder, "copyright"), "w", encoding="utf-8") as file:
        file.write(copyright_file())


if __name__ == "__main__":
    main()
