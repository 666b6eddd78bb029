#!/usr/bin/python3
"""Runs random valid models through hersey and checks what must hold of every answer.

    random_models.py HERSEY [--steady N] [--machines N] [--time SECONDS] [--seed SEED] [--only NAME] [--small] [--jobs N] [--output FOLDER]

Each case has a name, such as steady-17, and is made from the seed and its name alone: `--seed 1 --only steady-17` runs it again.
The model of a case that fails is left in FOLDER, its first lines saying what does not hold and how to repeat it.
docs/random-models.md lists the invariants.
"""

import argparse
import collections
import itertools
import os
import random
import re
import shutil
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import machine_case  # noqa: E402
import steady_case  # noqa: E402

KINDS = {"steady": steady_case.examine, "machine": machine_case.examine}

# What counts against the program; a message that says why there is no answer does not.
BAD_ENDINGS = ("hangs", "assertion", "crash", "refused")


@dataclass
class Result:
    name: str
    ending: str
    text: str = ""
    findings: list = field(default_factory=list)
    models: dict = field(default_factory=dict)  # file name: text
    seconds: float = 0.0

    def fails(self):
        return self.ending in BAD_ENDINGS or bool(self.findings)


def examine(program, seed, name, output, is_small=False):
    """One case from its name: `steady-17` of this seed. A failing one leaves its model in `output`."""
    kind = name.split("-")[0]
    begin = time.time()
    folder = tempfile.mkdtemp(prefix="hersey-random-")
    try:
        # A string as seed gives the same numbers on every machine and version of Python.
        result = Result(name, *KINDS[kind](program, random.Random(f"{seed}/{name}"), folder, is_small))
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    result.seconds = time.time() - begin
    if result.fails() and output:
        save(program, seed, result, output, is_small)
    return result


def save(program, seed, result, output, is_small):
    os.makedirs(output, exist_ok=True)
    lines = [f"{result.ending}: {result.text}"] if result.ending != "answer" else []
    lines += [f"{invariant}: {text}" for invariant, text in result.findings]
    lines.append(f"repeat: {os.path.relpath(__file__)} {program} --seed {seed} --only {result.name}{' --small' * is_small}")
    note = "".join(f"# {line}\n" for text in lines for line in text.splitlines())
    for file, text in result.models.items():
        with open(os.path.join(output, f"{result.name}-{file}.yaml"), "w", encoding="utf-8") as model:
            model.write(note + text)


def names(steady, machines):
    """Cases in turn, so that a run cut short has tried both kinds."""
    cases = itertools.zip_longest((f"steady-{k}" for k in range(steady)), (f"machine-{k}" for k in range(machines)))
    return (name for pair in cases for name in pair if name)


def run_all(program, seed, cases, jobs, output, seconds=None, is_small=False):
    """Results of all cases, or of as many as `seconds` allow, in their order."""
    results, end = [], time.time() + seconds if seconds else None
    with ProcessPoolExecutor(jobs) as pool:
        waiting, cases = collections.deque(), iter(cases)
        while True:
            while len(waiting) < 2 * jobs and (end is None or time.time() < end):
                name = next(cases, None)
                if name is None:
                    break
                waiting.append(pool.submit(examine, program, seed, name, output, is_small))
            if not waiting:
                return results
            results.append(waiting.popleft().result())
            tell(results[-1])


def tell(result):
    if not result.fails():
        return
    print(f"{result.name}: {result.ending} {result.text.splitlines()[0] if result.text else ''}".rstrip())
    for invariant, text in result.findings:
        print(f"    {invariant}: {text}")
    sys.stdout.flush()


def table(results):
    """Endings by kind, then how often each invariant failed."""
    kinds = sorted({r.name.split("-")[0] for r in results})
    endings = ["answer", "message", "refused", "hangs", "assertion", "crash"]
    lines = [f"{'':40}" + "".join(f"{kind:>10}" for kind in kinds)]

    def row(title, count):
        lines.append(f"{title:40}" + "".join(f"{sum(count(r) for r in results if r.name.startswith(kind)):>10}" for kind in kinds))

    row("cases", lambda r: 1)
    for ending in endings:
        row(f"  {ending}", lambda r, ending=ending: r.ending == ending)
    row("failing", lambda r: r.fails())
    for invariant in sorted({i for r in results for i, _ in r.findings}):
        row(f"  {invariant}", lambda r, invariant=invariant: any(i == invariant for i, _ in r.findings))
    messages = collections.defaultdict(list)
    for r in results:
        if r.ending != "answer":
            messages[re.sub(r"-?\d[\d.e+-]*", "#", r.text)[:150]].append(r.name)
    for text, of in sorted(messages.items(), key=lambda item: -len(item[1]))[:12]:
        lines.append(f"{len(of):5} x {text} ({', '.join(of[:3])}{', ...' if len(of) > 3 else ''})")
    lines.append(f"slowest: {max(results, key=lambda r: r.seconds).name}, {max(r.seconds for r in results):.1f} s")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--steady", type=int, default=0)
    parser.add_argument("--machines", type=int, default=0)
    parser.add_argument("--time", type=float, help="as many cases of both kinds as this many seconds allow")
    parser.add_argument("--seed", default=None, help="default: a new one, which is printed")
    parser.add_argument("--only", action="append", help="a case by its name")
    parser.add_argument("--small", action="store_true", help="coarser grids and fewer steps, as `make test` has them")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--output", default="build/random", help="where models of failing cases are left")
    arguments = parser.parse_args()
    seed = arguments.seed or str(int(time.time()))
    print(f"seed {seed}", flush=True)
    if arguments.only:
        cases = arguments.only
    elif arguments.time:
        cases = (f"{kind}-{k}" for k in itertools.count() for kind in KINDS)
    else:
        cases = names(arguments.steady, arguments.machines)
    program = os.path.abspath(arguments.program)
    results = run_all(program, seed, cases, arguments.jobs, arguments.output, arguments.time, arguments.small)
    if not results:
        parser.error("no case: give --steady, --machines, --time or --only")
    print(table(results))
    failing = [r.name for r in results if r.fails()]
    if failing:
        print(f"models of failing cases: {arguments.output}")
    return 1 if failing else 0


if __name__ == "__main__":
    sys.exit(main())
