#!/usr/bin/python3
"""Random bearings by hersey and by the second film solver, at rest and on an orbit in time: where both differ by more than the errors
they tell.

    second_opinion.py HERSEY [--count N] [--seed SEED] [--only NAME] [--jobs N] [--output FOLDER]

exit code 1 if any pair differs. Models of those are left in FOLDER. docs/validation.md tells what is compared.
"""

import argparse
import os
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import comparison  # noqa: E402
import in_time  # noqa: E402


def one_case(program, seed, name, output):
    with tempfile.TemporaryDirectory(prefix="hersey-second-") as folder:
        begin = time.time()
        examine = in_time.examine if name.startswith("orbit") else comparison.examine
        found = examine(program, seed, name, folder)
    if found.off and output:
        os.makedirs(output, exist_ok=True)
        with open(os.path.join(output, f"{name}.yaml"), "w", encoding="utf-8") as file:
            file.write("".join(f"# {key}: {text}\n" for key, text in found.off) + found.model)
    return name, found, time.time() - begin


def table(results):
    """How each case ended, and the worst difference of each figure over what both errors allow."""
    lines = [f"{sum(found.ending == kind for _, found, _ in results):6} {kind}"
             for kind in ("answer", "one has no answer", "not compared")]
    figures = sorted({key for _, found, _ in results for key in found.ratios})
    for key in figures:
        ratios = sorted(found.ratios[key] for _, found, _ in results if key in found.ratios)
        lines.append(f"  {key:20} median {ratios[len(ratios) // 2]:.2f}, largest {ratios[-1]:.2f} of what is allowed")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=100, help="of bearings at rest; a quarter as many go round an orbit")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--only", action="append")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--output", default="build/second-opinion")
    arguments = parser.parse_args()
    print(f"seed {arguments.seed}", flush=True)
    program = os.path.abspath(arguments.program)
    names = arguments.only or [f"bearing-{k}" for k in range(arguments.count)] + [f"orbit-{k}" for k in range(arguments.count // 4)]
    results = []
    with ProcessPoolExecutor(arguments.jobs) as pool:
        waiting = [pool.submit(one_case, program, arguments.seed, name, arguments.output) for name in names]
        for future in waiting:
            results.append(future.result())
            name, found, seconds = results[-1]
            if found.ending != "answer":
                print(f"{name}: {found.ending}: {found.text.splitlines()[0]}")
            for key, text in found.off:
                print(f"{name}: {key} {text}")
            sys.stdout.flush()
    print(table(results))
    return 1 if any(found.off for _, found, _ in results) else 0


if __name__ == "__main__":
    sys.exit(main())
