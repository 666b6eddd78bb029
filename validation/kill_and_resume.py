#!/usr/bin/python3
"""Runs that SIGKILL ends at random instants go on with --resume to the same results, bit by bit.

Three models: a mechanism with steps of its own choosing, a film, a journal in a mesh that bends under its film
(validation/interrupted). Each is run undisturbed once; then again and again, killed at a random instant between its
start and its end, resumed, every third time killed once more, and resumed to the end. Every dataset must then have the
bytes of the undisturbed run, and nothing may lie beside the results but the report.

Usage: kill_and_resume.py HERSEY [FOLDER] [--kills N] [--seed N] [--short]
exit code 0 if all runs killed came to the same results. --kills: per model (100); --short: runs of a fraction of a second.
"""

import argparse
import math
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py

MODELS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "interrupted")
DURATIONS = {"mechanism": ("300 ms", "60 ms"), "film": ("200 ms", "25 ms"), "flexible_ehd": ("8 ms", "2 ms")}  # long, short
CHECKPOINTS = "simulation.checkpoint.wall_time=15 ms"


def write_ring(path, inner=22.5, outer=30.0, width=15.6, around=24, along=3):
    """A ring of hexahedra about the z-axis in the format of Abaqus, with the sets bore and outside; lengths in mm."""
    def label(layer, i, k):
        return 1 + layer + 2 * (i % around) + 2 * around * k

    with open(path, "w", encoding="utf-8") as file:
        file.write("*NODE\n")
        for k in range(along + 1):
            for i in range(around):
                phi = 2 * math.pi * i / around
                for layer, r in enumerate((inner, outer)):
                    z = width * k / along - width / 2
                    file.write(f"{label(layer, i, k)}, {r * math.cos(phi):.12g}, {r * math.sin(phi):.12g}, {z:.12g}\n")
        file.write("*ELEMENT, TYPE=C3D8, ELSET=all\n")
        for k in range(along):
            for i in range(around):
                corners = [label(*c) for z in (k, k + 1) for c in ((0, i, z), (1, i, z), (1, i + 1, z), (0, i + 1, z))]
                file.write(f"{1 + i + around * k}, {', '.join(map(str, corners))}\n")
        for layer, name in enumerate(("bore", "outside")):
            file.write(f"*NSET, NSET={name}\n")
            file.writelines(f"{label(layer, i, k)},\n" for k in range(along + 1) for i in range(around))


def datasets(path):
    """Every dataset of a results file, as bytes or text."""
    found = {}
    with h5py.File(path) as file:
        def keep(name, item):
            if isinstance(item, h5py.Dataset):
                found[name] = item[()].tobytes() if item.dtype.kind in "fiu" else str(item[()])
        file.visititems(keep)
        found["status"] = file.attrs["status"]
    return found


class Model:
    """One model, and how often its runs were killed."""

    def __init__(self, hersey, folder, name, short):
        self.name = name
        self.folder = os.path.join(folder, name)
        os.makedirs(self.folder)
        model = shutil.copy(os.path.join(MODELS, name + ".yaml"), self.folder)
        write_ring(os.path.join(self.folder, "ring.inp"))
        self.command = [hersey, "run", model, "--set", f"duration={DURATIONS[name][short]}", "--set", CHECKPOINTS]
        self.kills = self.anew = self.same = self.trials = 0
        begun = time.monotonic()
        self.run("undisturbed")
        self.span = time.monotonic() - begun
        self.expected = datasets(os.path.join(self.folder, "undisturbed/results.h5"))

    def run(self, output, *options):
        """To its end; returns what it says."""
        run = subprocess.run([*self.command, "--output", os.path.join(self.folder, output), *options], check=False,
                             capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=600)
        if run.returncode:
            raise AssertionError(f"{self.name}: {' '.join(run.args)}\nended with {run.returncode}:\n{run.stderr}")
        return run.stderr

    def kill(self, after, *options):
        """Begins or resumes a run and kills it after some seconds; returns whether it was still at work."""
        with subprocess.Popen([*self.command, "--output", os.path.join(self.folder, "killed"), *options],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                              text=True) as process:
            try:
                process.wait(timeout=after)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
            errors = process.communicate()[1]
        if process.returncode not in (0, -signal.SIGKILL):
            raise AssertionError(f"{self.name}: resumed run ended with {process.returncode}:\n{errors}")
        self.kills += process.returncode != 0
        return process.returncode != 0

    def trial(self, chance):
        """One run that is killed at least once; returns what is wrong with its results, or nothing."""
        killed = os.path.join(self.folder, "killed")
        shutil.rmtree(killed, ignore_errors=True)
        while not self.kill(chance.uniform(0, self.span)):
            shutil.rmtree(killed, ignore_errors=True)
        if chance.random() < 1 / 3:
            self.kill(chance.uniform(0, self.span), "--resume")
        said = self.run("killed", "--resume")
        self.trials += 1
        self.anew += "began anew" in said
        found = datasets(os.path.join(killed, "results.h5"))
        different = sorted(name for name in self.expected.keys() | found.keys()
                           if self.expected.get(name) != found.get(name))
        beside = sorted(set(os.listdir(killed)) - {"results.h5", "report.html"})
        self.same += not different and not beside
        return ([f"other values in {', '.join(different)}"] if different else []) + (
            [f"left behind: {', '.join(beside)}"] if beside else [])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hersey")
    parser.add_argument("folder", nargs="?", default=tempfile.gettempdir())
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=random.randrange(2**32))
    parser.add_argument("--short", action="store_true")
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    chance = random.Random(options.seed)
    os.makedirs(options.folder, exist_ok=True)
    folder = tempfile.mkdtemp(prefix="kills-", dir=options.folder)
    failed = trials = same = 0
    try:
        for name in DURATIONS:
            model = Model(os.path.abspath(options.hersey), folder, name, options.short)
            while model.kills < options.kills:
                for fault in model.trial(chance):
                    print(f"{name}: after {model.kills} kills: {fault}", flush=True)
            print(f"{name:13} {model.kills} kills of {model.trials} runs ({model.span:.2f} s undisturbed); "
                  f"{model.anew} began anew; {model.same} ended with the same bits", flush=True)
            failed += model.trials - model.same
            trials, same = trials + model.trials, same + model.same
    except AssertionError as error:
        print(error)
        failed += 1
    print(f"{same} of {trials} runs that were killed came to the same results")
    if not failed:
        shutil.rmtree(folder)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
