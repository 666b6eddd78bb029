"""What the program says about its own command line, read from its --help: man pages and completion follow from it."""

import dataclasses
import re
import subprocess


@dataclasses.dataclass
class Entry:
    """One option, positional, sub-command or exit code: how it is written, and what it means."""
    names: str
    meaning: str

    @property
    def spellings(self):
        """`-h`, `--help`: what is typed, without its value."""
        return re.findall(r"(?<![\w-])--?[A-Za-z][\w-]*", self.names.split(" Excludes:")[0])

    @property
    def shown(self):
        """As a manual writes it: without what the option parser says of itself."""
        text = re.split(r" (?:Excludes|Needs):", self.names)[0]
        return re.sub(r" (?:TEXT|REQUIRED)\b", "", text).replace("INT:POSITIVE", "N").replace("... ...", "...").replace(",--", ", --")

    @property
    def value(self):
        """The words that stand for an option's value, `FILE`; empty for a flag."""
        return re.sub(r"^(?:--?[\w-]+,?\s*)+", "", re.split(r" (?:Excludes|Needs):", self.names)[0]).strip()


@dataclasses.dataclass
class Help:
    """The help of the program or of one command, in its sections."""
    name: str
    about: str
    usage: str
    sections: dict  # title -> [Entry]; "Examples" and "Exit codes" of the footer as well


def entries(lines):
    """`  names    meaning`, a meaning continued in column 30; names too long for it stand in a line of their own."""
    found = []
    for line in lines:
        if line.startswith(" " * 20) and found:
            found[-1].meaning = (found[-1].meaning + " " + line.strip()).strip()
        elif line.strip():
            parts = re.split(r"\s{2,}", line.strip(), maxsplit=1)
            if len(parts) == 1 and len(line) > 30 and line[29] == " ":  # one blank only before the column
                parts = [line[:29].strip(), line[30:].strip()]
            found.append(Entry(parts[0], parts[1] if len(parts) > 1 else ""))
    return found


def read_help(program, *command):
    """The help of the program, or of one of its commands."""
    text = subprocess.run([program, *command, "--help"], text=True, capture_output=True, check=True).stdout
    about, _, rest = text.partition("\nUsage: ")
    usage, _, rest = rest.partition("\n")
    sections, title = {}, None
    for line in rest.splitlines():
        if re.fullmatch(r"[A-Z][\w ]*:", line):
            title = line[:-1]
            sections[title] = []
        elif title:
            sections[title].append(line)
    return Help(" ".join(["hersey", *command]), about.strip(), usage.strip(),
                {title: entries(lines) for title, lines in sections.items()})


def read_program(program):
    """The program's own help, and that of each of its commands by name."""
    top = read_help(program)
    return top, {entry.names: read_help(program, entry.names) for entry in top.sections["Subcommands"]}
