#!/usr/bin/python3
"""commands_test.py SOURCE BUILD PAGE [--whole]   runs the commands that a page tells its reader to run.

Every ```sh block of the page is executed, in order, in a folder that looks like the repository's root with the program
built; ```text blocks are not. Long runs of examples go over the first part of their time only (SHORTENED), unless
--whole is given, as `make validate` does.
"""

import os
import re
import shlex
import stat
import subprocess
import sys
import tempfile

SOURCE, BUILD, PAGE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
WHOLE = "--whole" in sys.argv[4:]

# What `hersey run` of a page is given besides, by how its arguments begin, where the whole run takes more than a few seconds.
SHORTENED = {
    "examples/flexible_big_end/model.yaml": "simulation.duration=90deg",
    "examples/flexible_rotor/films.yaml": "simulation.duration=0.06s",
    "examples/flexible_rotor/model.yaml": "simulation.duration=0.3s",
    "examples/flexible_slider_crank/model.yaml": "simulation.duration=60deg",
    "examples/geared_rotors/model.yaml": "simulation.duration=20ms",
    "examples/oil_whirl/flexible.yaml": "simulation.duration=0.06s",
    "examples/oil_whirl/model.yaml": "simulation.duration=0.06s",
    "examples/oil_whirl/unbalance.yaml": "study.parameters.speed=[9000rpm]",
    "examples/paper_big_end/model.yaml": "study.parameters.load=[2500N]",
    "examples/rotor_run_up/model.yaml": "duration=0.3s",
    "examples/slider_crank/model.yaml --output build/slider_crank": "simulation.duration=60deg",
    "examples/slider_crank/pin_hole.yaml": "simulation.duration=60deg",
    "examples/turbocharger/model.yaml": "simulation.duration=20ms",
    "build/tutorial/big_end/model.yaml": "simulation.duration=180deg",
}


def blocks(text):
    """The ```sh blocks of a page, with the line each starts in."""
    for match in re.finditer(r"^```sh\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, match.start()) + 2, match.group(1)


def stand_in_for_the_repository(folder):
    """Links to the sources, with build/release being the build under test, so that nothing is written to either."""
    for name in os.listdir(SOURCE):
        if not name.startswith((".", "build")):
            os.symlink(os.path.join(SOURCE, name), os.path.join(folder, name))
    build = os.path.join(folder, "build/release")
    os.makedirs(build)
    for name in os.listdir(BUILD):
        os.symlink(os.path.join(BUILD, name), os.path.join(build, name))
    if not WHOLE:
        shorten_runs(os.path.join(build, "hersey"))


def shorten_runs(program):
    """In the place of `program`, a link, comes a script that starts it with more settings."""
    real = shlex.quote(os.path.realpath(program))
    cases = "".join(f"  'run {begin}'*) set -- \"$@\" --set {shlex.quote(setting)} ;;\n" for begin, setting in SHORTENED.items())
    os.unlink(program)
    with open(program, "w", encoding="utf-8") as script:
        script.write(f'#!/bin/sh\ncase "$*" in\n{cases}esac\nexec {real} "$@"\n')
    os.chmod(program, os.stat(program).st_mode | stat.S_IXUSR)


def main():
    with open(os.path.join(SOURCE, PAGE), encoding="utf-8") as file:
        found = list(blocks(file.read()))
    if not found:
        sys.exit(f"{PAGE} has no commands to try")
    failed = 0
    with tempfile.TemporaryDirectory(prefix="hersey-docs-") as folder:
        stand_in_for_the_repository(folder)
        for line, commands in found:
            # Recipes name the program alone, as where it is installed.
            path = os.pathsep.join([os.path.join(folder, "build/release"), os.environ["PATH"]])
            run = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, text=True, capture_output=True,
                                 env=os.environ | {"PATH": path},
                                 stdin=subprocess.DEVNULL, timeout=None if WHOLE else 280, check=False)
            if run.returncode != 0:
                failed += 1
                print(f"{PAGE}:{line}: exit code {run.returncode}\n{commands}\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
