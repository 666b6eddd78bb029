#!/usr/bin/python3
"""man_pages.py PROGRAM FOLDER   writes hersey(1) and one page for each command, from what the program says of itself."""

import datetime
import gzip
import os
import subprocess
import sys

import command_line


def roff(text):
    """Text that troff shows as it is: no line starts a request, hyphens are what is typed."""
    text = text.replace("\\", "\\(rs").replace("-", "\\-").replace("~", "\\(ti").replace("^", "\\(ha")
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in text.splitlines())


def tagged(entry):
    return f".TP\n.B {roff(entry.shown)}\n{roff(entry.meaning)}\n"


def section_text(title, entries):
    if title != "Examples":
        return f".SH {title.upper()}\n" + "".join(map(tagged, entries))
    return ".SH EXAMPLES\n" + "".join(f".TP\n{roff(e.meaning) or 'as it is'}:\n.br\n.B {roff(e.names)}\n" for e in entries)


def page(help_text, version, commands=()):
    name = help_text.name.replace(" ", "-")
    day = datetime.date.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", datetime.datetime.now().timestamp())))
    first = help_text.about.splitlines()[0].removeprefix("hersey: ").rstrip(".")
    text = (f'.TH {roff(name.upper())} 1 "{day}" "hersey {version}" "User commands"\n'
            f".SH NAME\n{roff(name)} \\- {roff(first)}\n"
            f".SH SYNOPSIS\n.B {roff(help_text.usage)}\n"
            f".SH DESCRIPTION\n{roff(help_text.about)}\n")
    for title, entries in help_text.sections.items():
        if not commands and title == "Examples":
            entries = [entry for entry in entries if entry.names.startswith(help_text.name + " ")]
        if entries:
            text += section_text(title, entries)
    others = [f"hersey\\-{command}" for command in commands] or ["hersey"]
    return text + ".SH SEE ALSO\n" + ",\n".join(f".BR {other} (1)" for other in others) + "\n"


def main():
    program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    version = subprocess.run([program, "--version"], text=True, capture_output=True, check=True).stdout.split()[-1]
    top, commands = command_line.read_program(program)
    pages = {"hersey": page(top, version, tuple(commands))}
    pages |= {f"hersey-{name}": page(text, version) for name, text in commands.items()}
    for name, text in pages.items():
        with open(os.path.join(folder, f"{name}.1.gz"), "wb") as file:
            file.write(gzip.compress(text.encode(), 9, mtime=0))


if __name__ == "__main__":
    main()
