#!/usr/bin/python3
"""Tells which branches of the modules their tests take, and which they do not.

    coverage.py SOURCE BUILD [--jobs N] [--keep] [--with-mbd]      as `make coverage`

Runs the test programs of `MODULES` from a build of the preset `coverage` and reads clang's own counts of what stands in the
sources. A condition of an `if`, a loop, `?:`, `&&`, `||` or a `case` has two branches: it holds, it does not. Exceptions are none. What
HERSEY_REQUIRE asks is no condition either: its other side is a fault of the code (docs/architecture.md), nor is what is decided when compiling
(`if constexpr`, `requires`). A function that is made from a template counts once, whatever it was made for.

Every branch of `HELD` that no test takes needs its reason in tests/coverage/reasons.txt, a line each:

    FILE | CONDITION | true or false | why no test can, or need, take it

exit code 0 if at least BAR of the branches of each module of `HELD` are taken and all others have a reason, else 1
--keep: reads the counts of the last run, runs nothing
--with-mbd: `mbd` and its tests, too, of which nothing is asked: so built they take longer than all the others together
"""

import argparse
import collections
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import tempfile

MODULES = ["solver", "film", "bearing"]
HELD, BAR = ("film", "solver"), 0.95

Branch = collections.namedtuple("Branch", "file line condition side")


class Sources:
    """Text of the sources, and where their contracts stand."""

    def __init__(self, root):
        self.root, self.lines, self.contracts = root, {}, {}

    def of(self, file):
        if file not in self.lines:
            with open(os.path.join(self.root, file), encoding="utf-8") as handle:
                self.lines[file] = handle.read().split("\n")
            self.contracts[file] = spans_of_contracts(self.lines[file])
        return self.lines[file]

    def text(self, file, start_line, start, end_line, end):
        lines = self.of(file)
        if start_line == end_line:
            return lines[start_line - 1][start - 1:end - 1]
        part = [lines[start_line - 1][start - 1:], *lines[start_line:end_line - 1], lines[end_line - 1][:end - 1]]
        return " ".join(" ".join(part).split())

    def is_contract(self, file, line, column):
        self.of(file)
        return any(first <= (line, column) <= last for first, last in self.contracts[file])


def spans_of_contracts(lines):
    """((line, column), (line, column)) of each HERSEY_REQUIRE(...), both inclusive."""
    text = "\n".join(lines)
    places, spans = [], []
    for k, line in enumerate(lines):
        places += [(k + 1, column + 1) for column in range(len(line) + 1)]
    for match in re.finditer(r"\bHERSEY_REQUIRE\(", text):
        depth, k, quoted = 1, match.end(), False
        while depth and k < len(text):
            if text[k] == '"' and text[k - 1] != "\\":
                quoted = not quoted
            elif not quoted:
                depth += {"(": 1, ")": -1}.get(text[k], 0)
            k += 1
        spans.append((places[match.start()], places[k - 1]))
    return spans


def run(command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", check=False,
                          **options)
    if done.returncode:
        sys.exit(f"coverage: {' '.join(command)} ended with {done.returncode}:\n{(done.stdout + done.stderr)[-3000:]}")
    return done.stdout


def tool(name):
    """llvm's tool of the compiler's own version where the system has several."""
    version = re.search(r"version (\d+)", run(["clang", "--version"]))[1]
    for place in os.get_exec_path():
        for candidate in (f"{name}-{version}", name):
            if os.access(os.path.join(place, candidate), os.X_OK):
                return os.path.join(place, candidate)
    sys.exit(f"coverage: {name} is missing: `scripts/setup coverage` installs it")


def count(build, jobs):
    """Runs the test programs, each in a folder of its own."""
    def run_one(module):
        with tempfile.TemporaryDirectory(prefix="hersey-coverage-") as folder:
            run([os.path.join(build, f"{module}_test"), "--minimal"], cwd=folder,
                env={**os.environ, "LLVM_PROFILE_FILE": profile_of(build, module), "OPENBLAS_NUM_THREADS": "1"})

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(run_one, MODULES))


def profile_of(build, module):
    return os.path.join(build, "profiles", f"{module}.profraw")


def is_of_compiling(condition, line):
    """Whether it is decided then: `if constexpr`, `requires`, or a template's number, N > 0."""
    return "if constexpr" in line or condition.startswith("requires") or re.fullmatch(r"[A-Z] (==|>|<) \d+", condition)


def branches(source, build):
    """{Branch: how often it was taken} of the modules."""
    merged = os.path.join(build, "profiles", "merged.profdata")
    run([tool("llvm-profdata"), "merge", "-sparse", *(profile_of(build, m) for m in MODULES), "-o", merged])
    programs = [os.path.join(build, f"{m}_test") for m in MODULES]
    objects = [part for program in programs[1:] for part in ("-object", program)]
    exported = json.loads(run([tool("llvm-cov"), "export", "-instr-profile", merged, programs[0], *objects, "-skip-functions"]))
    sources, found = Sources(source), collections.Counter()
    for entry in exported["data"][0]["files"]:
        file = os.path.relpath(entry["filename"], source)
        if not re.match(rf"libs/({'|'.join(MODULES)})/(src|include)/", file):
            continue
        for start_line, start, end_line, end, taken, not_taken, *_ in entry["branches"]:
            if sources.is_contract(file, start_line, start):
                continue
            condition = sources.text(file, start_line, start, end_line, end)
            if is_of_compiling(condition, sources.of(file)[start_line - 1]):
                continue
            place = (start_line, start, end_line, end)
            found[file, place, condition, "true"] += taken
            found[file, place, condition, "false"] += not_taken
    return found


def reasons(source):
    """{(file, condition, side): reason}"""
    path = os.path.join(source, "tests/coverage/reasons.txt")
    found = {}
    with open(path, encoding="utf-8") as handle:
        for number, line in enumerate(handle, 1):
            if not line.strip() or line.startswith("#"):
                continue
            parts = [part.strip() for part in line.split(" | ")]
            if len(parts) != 4 or parts[2] not in ("true", "false") or not parts[3]:
                sys.exit(f"{path}:{number}: expected FILE | CONDITION | true or false | reason")
            found[tuple(parts[:3])] = parts[3]
    return found


def module_of(file):
    return file.split("/")[1]


def report(source, build):
    found, why = branches(source, build), reasons(source)
    by_file, status, unused = collections.defaultdict(lambda: [0, 0]), 0, set(why)
    listed = collections.defaultdict(list)
    for (file, place, condition, side), taken in sorted(found.items()):
        by_file[file][0] += taken > 0
        by_file[file][1] += 1
        if taken == 0:
            reason = why.get((file, condition, side))
            unused.discard((file, condition, side))
            listed[module_of(file)].append((file, place[0], condition, side, reason))
    path = os.path.join(build, "uncovered.txt")
    with open(path, "w", encoding="utf-8") as handle:
        for module in MODULES:
            for file, line, condition, side, reason in listed[module]:
                handle.write(f"{file}:{line} | {condition} | {side}" + (f" | {reason}" if reason else "") + "\n")
    for file, (taken, of) in sorted(by_file.items()):
        if taken < of:
            print(f"{file:<60} {taken:5} of {of:5}")
    for module in MODULES:
        taken = sum(t for file, (t, _) in by_file.items() if module_of(file) == module)
        of = sum(n for file, (_, n) in by_file.items() if module_of(file) == module)
        missing = [entry for entry in listed[module] if not entry[4]]
        print(f"{module}: {taken} of {of} branches taken, {100 * taken / max(of, 1):.1f} %"
              + (f"; {len(missing)} of the others without a reason" if module in HELD else ""))
        if module not in HELD:
            continue
        if taken < BAR * of:
            print(f"  at least {100 * BAR:.0f} % are asked for")
            status = 1
        for file, line, condition, side, _ in missing:
            print(f"  {file}:{line} | {condition} | {side}")
            status = 1
    for file, condition, side in sorted(unused):
        print(f"tests/coverage/reasons.txt: {file} | {condition} | {side} is taken or is no longer there: take the line out")
        status = 1
    print(f"branches that no test takes: {os.path.relpath(path, source)}")
    return status


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source")
    parser.add_argument("build")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--with-mbd", action="store_true")
    options = parser.parse_args()
    if options.with_mbd:
        MODULES.append("mbd")
    source, build = os.path.abspath(options.source), os.path.abspath(options.build)
    os.makedirs(os.path.join(build, "profiles"), exist_ok=True)
    if not options.keep:
        count(build, options.jobs)
    return report(source, build)


if __name__ == "__main__":
    sys.exit(main())
