#!/usr/bin/python3
"""bench/key_figures.py PROGRAM [--update] [--why TEXT] [--jobs N] [--only REGEX] [--against OTHER]

Runs every example in a short form and compares its key figures (minimum film thickness, peak pressure, losses, flows, temperatures,
stiffness, forces of joints, positions) with the last column of `bench/key_figures.csv`, which has one column a release and the last one,
`unreleased`, of the program as it is. A figure that differs needs a line in `why it changed`, or the comparison ends with status 1.
`--update` writes the column, and the day before each line that it has used: an old line excuses no new change.
`--against OTHER` compares two programs, tells how far their numbers lie apart at most and leaves the table alone; examples that
OTHER cannot run are named and skipped.
`bench/key_figure_rules.py` says what is run and what counts.
"""
import argparse
import concurrent.futures
import csv
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import key_figure_rules as rules

SOURCE = pathlib.Path(__file__).resolve().parent.parent
TABLE = SOURCE / "bench" / "key_figures.csv"
KEYS = ["example", "command", "quantity", "unit"]
WHY = "why it changed"
NEXT = "unreleased"
USED = re.compile(r"\d{4}-\d\d-\d\d: ")  # the day that --update has put before a reason


def examples(source=SOURCE):
    """Names of all examples, as folder/file of their models."""
    return sorted(f"{path.parent.name}/{path.stem}" for path in (source / "examples").glob("*/*.yaml"))


class CannotRun(Exception):
    """The program did not answer; its message."""


def text_of_command(command):
    """As the table holds it: what is typed, less the model."""
    kind, *settings = command
    return " ".join([kind] + [f"--set '{setting}'" if " " in setting else f"--set {setting}" for setting in settings])


def figures_of(program, example, command):
    """{(example, command, quantity): (value, unit)} of one command."""
    kind, *settings = command
    with tempfile.TemporaryDirectory(prefix="hersey-figures-") as folder:
        call = [program, kind, str(SOURCE / "examples" / f"{example}.yaml"), "--json", "--threads", "1", "--jobs", "1"]
        call += [word for setting in settings for word in ("--set", setting)]
        call += ["--output", folder, "--force"] if kind == "run" else ["--no-grid-error"]
        done = subprocess.run(call, capture_output=True, text=True, env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "HERSEY_CACHE": "off"}, check=False)
        if done.returncode != 0:
            raise CannotRun(f"{example}: `hersey {kind}` ended with status {done.returncode}: {done.stderr.strip()[-400:]}")
        answer = json.loads(done.stdout)
        found = rules.of_bearing(answer) if kind == "bearing" else []
        for run in answer.get("runs", []):
            # A study's runs are distinguished by their folders.
            below = pathlib.Path(run["results"]).parent.relative_to(folder)
            found += rules.of_run(run["results"], "" if str(below) == "." else f"{below}: ")
    return {(example, text_of_command(command), quantity): (value, unit) for quantity, value, unit in found if not rules.is_zero(value, unit)}


def all_figures(program, names, jobs):
    """Figures of these examples, and the messages of commands that did not answer."""
    figures, failures = {}, {}
    work = [(name, command) for name in names for command in rules.commands(name)]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        waiting = {pool.submit(figures_of, program, *item): item for item in work}
        for count, done in enumerate(concurrent.futures.as_completed(waiting), 1):
            try:
                figures |= done.result()
            except CannotRun as failure:
                failures[waiting[done][0]] = str(failure)
            if sys.stderr.isatty():
                print(f"\r{count}/{len(work)} ", end="", file=sys.stderr, flush=True)
    order = {item: k for k, item in enumerate(names)}
    return dict(sorted(figures.items(), key=lambda item: order[item[0][0]])), failures


def text_of(value):
    return value if isinstance(value, str) else f"{value:.10g}"


def number(text):
    """The number that a cell holds, or its text."""
    try:
        return float(text)
    except ValueError:
        return text


def change(before, after, unit):
    """How much two cells differ, as words, or "" where they are equal; an empty cell is a figure that is zero or not there."""
    before, after = number(before), number(after)
    if isinstance(before, str) or isinstance(after, str):
        if before == after or before == "" and rules.is_zero(after, unit) or after == "" and rules.is_zero(before, unit):
            return ""
        return "new" if before == "" else "gone" if after == "" else "another answer"
    off = abs(after - before)
    if off <= max(rules.RELATIVE * max(abs(before), abs(after)), rules.ZERO.get(unit, 0.0)):
        return ""
    return f"{after / before - 1:+.2g}" if before != 0 else f"{after - before:+.2g} {unit}"


class Table:
    """The file: columns, and rows by (example, command, quantity)."""

    def __init__(self, columns=(), rows=()):
        self.columns = list(columns) or [*KEYS, NEXT, WHY]
        self.rows = {(row["example"], row["command"], row["quantity"]): row for row in rows}

    @staticmethod
    def read(path):
        if not path.exists():
            return Table()
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            return Table(reader.fieldnames, list(reader))

    def write(self, path):
        rows = sorted(self.rows.values(), key=lambda row: row["example"])  # stable: figures stay in the order of their rules
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, self.columns, lineterminator="\n", restval="")
            writer.writeheader()
            writer.writerows(rows)

    @property
    def last(self):
        """The column that is compared with: the newest."""
        return self.columns[-2]

    def differences(self, figures, names):
        """[(key, before, after, change, reason)] of the examples named; a reason that has been used already is none."""
        found = []
        for key in [*figures, *(key for key in self.rows if key not in figures)]:
            row = self.rows.get(key, {})
            value, unit = figures.get(key, ("", row.get("unit", "")))
            shown = change(row.get(self.last, ""), text_of(value), unit)
            if key[0] in names and shown:
                reason = row.get(WHY, "")
                found.append((key, row.get(self.last, ""), text_of(value), shown, "" if USED.match(reason) else reason))
        return found

    def update(self, figures, names, why, day):
        """Writes the column `unreleased`; returns the differences that have no reason, and then writes nothing. A command that is
        new, or no longer run, needs none."""
        known, run = ({key[:2] for key in keys} for keys in (self.rows, figures))
        differences = [d for d in self.differences(figures, names) if d[0][:2] in known & run]
        unexplained = [d for d in differences if not (why or d[4])]
        if unexplained:
            return unexplained
        if self.last != NEXT:
            self.columns.insert(-1, NEXT)
        reasons = {d[0]: why or d[4] for d in differences}
        written, others = {}, set(examples()) - set(names)
        for key, (value, unit) in figures.items():
            row = self.rows.get(key, dict(zip(KEYS, key)) | {"unit": unit})
            self.explain(row, reasons.get(key, ""), day)
            written[key] = row | {NEXT: text_of(value)}
        for key, row in self.rows.items():
            if key not in figures and (key[0] in others or self.released(row)):
                if key in reasons:
                    self.explain(row, reasons[key], day)
                written[key] = row | ({} if key[0] in others else {NEXT: ""})
        self.rows = written
        return []

    def released(self, row):
        return any(row.get(column) for column in self.columns[len(KEYS):-2])

    @staticmethod
    def explain(row, reason, day):
        """Puts the reason of a change, with its day, before those of earlier ones."""
        if reason:
            old = row.get(WHY, "")
            row[WHY] = "; ".join([f"{day}: {reason}"] + ([old] if USED.match(old) else []))


def show(differences, left, right):
    """Prints differences, example after example; digits enough to see them."""
    place = None
    for (example, command, quantity), before, after, shown, reason in differences:
        if (example, command) != place:
            place = (example, command)
            print(f"{example}: {command}")
        print(f"  {quantity}: {left} {before or '-'}, {right} {after or '-'} ({shown})" + (f"; {reason}" if reason else ""))


def farthest(before, after):
    """Of the numbers that both have and that are not zero, how far the two lie apart at most, as a line of text."""
    off = [(abs(value / before[key][0] - 1), key) for key, (value, unit) in after.items()
           if key in before and not any(isinstance(v, str) or v == 0 or rules.is_zero(v, unit) for v in (value, before[key][0]))]
    if not off:
        return "no number to compare"
    most, (example, command, quantity) = max(off)
    return f"largest relative difference {most:.1e}: {example}, {command}: {quantity}" if most else "every number the same to the last bit"


def against(arguments, names):
    """Compares two programs."""
    after, failures = all_figures(arguments.program, names, arguments.jobs)
    before, skipped = all_figures(arguments.against, names, arguments.jobs)
    table = Table(rows=[dict(zip(KEYS, key)) | {"unit": unit, NEXT: text_of(value)} for key, (value, unit) in before.items()])
    differences = table.differences({k: v for k, v in after.items() if k[0] not in skipped}, [n for n in names if n not in skipped])
    show(differences, "before", "after")
    for message in skipped.values():
        print(f"skipped, {arguments.against} cannot run it: {message}")
    print(farthest(before, after))
    print(f"{len(before)} key figures, {len(differences)} differ")
    return fail(failures) or int(bool(differences))


def fail(failures):
    for message in failures.values():
        print(message, file=sys.stderr)
    return int(bool(failures))


def compare(arguments, names):
    """Compares with the table, or writes it."""
    table = Table.read(arguments.table)
    figures, failures = all_figures(arguments.program, names, arguments.jobs)
    if failures:
        return fail(failures)
    if arguments.update:
        day = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
        show(table.differences(figures, names) if table.rows else [], table.last, "now")
        unexplained = table.update(figures, names, arguments.why, day)
        if not unexplained:
            table.write(arguments.table)
            print(f"{len(figures)} key figures written to {arguments.table}")
            return 0
    else:
        differences = table.differences(figures, names)
        show(differences, table.last, "now")
        unexplained = [d for d in differences if not d[4]]
        print(f"{len(figures)} key figures, {len(differences)} differ from `{table.last}`")
    if unexplained:
        print(f"{len(unexplained)} without a reason: find what has changed them; a change that is meant gets a line under `{WHY}` of its row, or "
              "all of them one by `make key-figures UPDATE=1 WHY='...'`", file=sys.stderr)
    return int(bool(unexplained))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--update", action="store_true", help="write the column `unreleased`")
    parser.add_argument("--why", default="", help="the reason of every change, with --update")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="commands at the same time")
    parser.add_argument("--only", default="", help="examples whose names this regular expression finds")
    parser.add_argument("--against", type=lambda path: str(pathlib.Path(path).resolve()), help="another program to compare with, in place of the table")
    parser.add_argument("--table", type=pathlib.Path, default=TABLE, help="the table, if it is another")
    arguments = parser.parse_args()
    forgotten = rules.complaints(examples())
    if forgotten:
        print("\n".join(forgotten), file=sys.stderr)
        return 1
    names = [name for name in examples() if re.search(arguments.only, name)]
    return against(arguments, names) if arguments.against else compare(arguments, names)


if __name__ == "__main__":
    sys.exit(main())
