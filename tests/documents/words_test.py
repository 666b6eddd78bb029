"""Words that docs/glossary.md replaces stand nowhere: not in identifiers, comments, messages, pages.

    words_test.py SOURCE_DIR [Class.test_name]
"""

import os
import re
import subprocess
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))
GLOSSARY = os.path.join(SOURCE, "docs/glossary.md")

# Text that people write and read. Decisions and changes tell of what was, in the words of their day.
FOLDERS = ("libs", "apps", "python", "bench", "validation", "docs", "README.md", "CONTRIBUTING.md")
ENDINGS = (".h", ".cpp", ".py", ".md")
LEFT_OUT = ("docs/glossary.md", "docs/decisions/")


def rivals(glossary):
    """(identifiers, words): what the last column of each table refuses."""
    identifiers, words = set(), set()
    for line in glossary.splitlines():
        cells = re.split(r"(?<!\\)\|", line)
        if len(cells) != 6 or set(cells[1].strip()) <= {"-"} or cells[1].strip() == "word":
            continue
        last = cells[4]
        identifiers |= set(re.findall(r"`([^`]+)`", last))
        words |= {word.strip() for word in re.sub(r"`[^`]+`", "", last).split(",") if word.strip()}
    return identifiers, words


def expression(identifiers, words):
    parts = [re.escape(word) for word in sorted(identifiers)] + [re.escape(word) for word in sorted(words)]
    return re.compile(r"(?<![\w-])(" + "|".join(parts) + r")(?![\w-])") if parts else None


def found_in(text, pattern):
    """[(line, word)]; a word by itself in double quotes is a key of a file, which older programs have written, and no text."""
    return [(number, match[1]) for number, line in enumerate(text.splitlines(), 1) for match in pattern.finditer(line)
            if line[max(match.start() - 1, 0):match.end() + 1] != f'"{match[1]}"']


def files():
    listed = subprocess.run(["git", "-C", SOURCE, "ls-files", *FOLDERS], capture_output=True, text=True, check=False)
    names = listed.stdout.split() if listed.returncode == 0 else walked()
    return [name for name in names if name.endswith(ENDINGS) and not name.startswith(LEFT_OUT)]


def walked():
    """The same of a tree that is no clone."""
    for folder in FOLDERS:
        top = os.path.join(SOURCE, folder)
        if os.path.isfile(top):
            yield folder
        for path, _, names in os.walk(top):
            yield from (os.path.relpath(os.path.join(path, name), SOURCE) for name in names)


class Words(unittest.TestCase):
    def test_no_rival_of_the_glossary_is_used(self):
        with open(GLOSSARY, encoding="utf-8") as file:
            pattern = expression(*rivals(file.read()))
        self.assertIsNotNone(pattern)
        used = []
        for name in files():
            with open(os.path.join(SOURCE, name), encoding="utf-8", errors="replace") as file:
                used += [f"{name}:{line}: '{word}'" for line, word in found_in(file.read(), pattern)]
        self.assertEqual(used, [], "words that docs/glossary.md replaces by others")

    def test_each_word_is_explained_once_in_a_sentence(self):
        with open(GLOSSARY, encoding="utf-8") as file:
            rows = [re.split(r"(?<!\\)\|", line) for line in file if line.startswith("| ")]
        words = []
        for cells in rows:
            if cells[1].strip() == "word":
                continue
            self.assertEqual(len(cells), 6, cells)
            self.assertTrue(cells[2].strip().endswith("."), cells[1])
            words += [word.strip() for word in cells[1].split(",")]
        self.assertEqual(sorted(set(words)), sorted(words))

    def test_a_rival_is_found_in_any_text(self):
        glossary = "| word | meaning | source | instead of |\n|---|---|---|---|\n| cavitated | At p_cav. | E | `was_broken`, broken film |\n"
        pattern = expression(*rivals(glossary))
        self.assertEqual(found_in("// The broken film\nif (was_broken) return;  // unbroken films", pattern),
                         [(1, "broken film"), (2, "was_broken")])

    def test_a_key_in_quotes_is_no_text(self):
        pattern = expression(set(), {"told"})
        self.assertEqual(found_in('entry["told"] = 1;  // told\nprint("told by the run")', pattern), [(1, "told"), (2, "told")])


if __name__ == "__main__":
    unittest.main()
