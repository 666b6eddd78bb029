"""A study from its model file to its results."""

import difflib
import importlib.util
import json
import math
import os
import subprocess
import sys

from . import distributions, plan
from .folder import Folder, identity
from .workers import answer_all


# What a record has of an answer.
KEPT = ("run", "status", "error", "seconds", "figures", "report", "doubts", "slopes", "no_slopes")


class StudyError(Exception):
    """What is wrong with a study, in words for the user."""


def load(program, model, overrides=(), runner="", text=""):
    """The study of a model file, checked by the program itself: its messages are those of `hersey check`. `text` names
    a file whose text stands in for the model's."""
    command = [program, "study-plan", model, *(f"--set={change}" for change in overrides)]
    if runner:
        command.append("--any-figure")
    if text:
        command += ["--text", text]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        if importlib.util.find_spec("numpy"):
            importlib.import_module("numpy")  # meanwhile
        out, err = process.communicate()
    sys.stderr.write(err)
    if process.returncode:
        raise StudyError("")
    study = json.loads(out)
    study.update(program=program, runner=runner)
    names = [*study["outputs"], *(o["name"] for o in study["objectives"]), *(c["name"] for c in study["constraints"])]
    study["wanted"] = list(dict.fromkeys(names))
    study["bearings_wanted"] = sorted({n.split(".")[1] for n in names if n.startswith("bearings.") and n.count(".") > 1})
    return study


def is_drawn(settings):
    """Whether runs stand for distributions, so that surrogate and indices mean something."""
    kinds = ("latin_hypercube", "sobol", "halton")
    return settings["plan"] in kinds and all(p.get("distribution") for p in settings["parameters"])


def runs_of_model(study):
    """Figures that are shown where the study names none."""
    kinds = ("h_min", "p_max", "power_film") if study["analysis"] == "steady" else ("moft", "pofp", "film_loss")
    return [f"bearings.{bearing}.{kind}" for bearing in study["bearings"] for kind in kinds]


class Study:
    """A study and its folder. Use it as a context: the folder is locked meanwhile."""

    def __init__(self, settings, folder, table=None):
        self.settings = settings
        self.folder = Folder(folder)
        self.table = table
        self.failed = {}
        self.seconds = 0.0
        self.search = None  # how an optimum was looked for
        self._identities = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.folder.close()

    def identity(self, texts):
        """Name of the run with these values."""
        key = tuple(texts)
        if key not in self._identities:
            self._identities[key] = identity(self.settings, texts)
        return self._identities[key]

    def request(self, texts, slopes=False):
        """A run as the program that answers it wants it; `slopes`: with its derivatives, where it has exact ones."""
        settings = self.settings
        run = self.identity(texts)
        values = [[p["name"], text] for p, text in zip(settings["parameters"], texts)]
        request = {"run": run, "set": [f"{name}={text}" for name, text in values], "values": values}
        if slopes:
            request["slopes"] = {p["name"]: p.get("key", p["name"]) for p in settings["parameters"]}
        if settings["analysis"] == "simulation":
            request["results"] = self.folder.file("runs", run + ".h5")
            request["events"] = self.folder.file("runs", run + ".events")  # while the run goes on
            # Spectra are read from the results file.
            spectra = settings["diagram"] == "run_up" and settings["keep"] == "figures"
            request["keep"] = "results" if spectra else settings["keep"]
            if settings["keep"] == "report":
                request["report"] = self.folder.file("runs", run + ".html")
        return request

    def missing(self, texts_of_runs, again):
        """Runs that have no record yet, each once."""
        done = self.folder.done(failed_too=not again)
        for texts in texts_of_runs:
            request = self.request(texts)
            if request["run"] not in done:
                done.add(request["run"])
                yield request

    def record(self, request, answer):
        """Puts an answer into the folder."""
        if request is None:
            self.folder.describe(answer)
            return
        kept = {key: answer[key] for key in KEPT if key in answer}
        if kept["status"] == "completed":
            self.check_names(kept)
        kept["values"] = request["values"]
        self.folder.add(kept)
        self.seconds += kept.get("seconds", 0.0)
        if kept["status"] != "completed":
            self.failed[kept["run"]] = kept
        if self.table:
            self.table.add(kept)

    def check_names(self, record):
        """The first answer tells whether every figure that is asked for exists."""
        if self.settings.get("checked"):
            return
        self.settings["checked"] = True
        if not self.settings["wanted"]:
            self.settings["wanted"] = ([name for name in runs_of_model(self.settings) if name in record["figures"]]
                                       or list(record["figures"])[:8])
        for name in self.settings["wanted"]:
            if name in record["figures"]:
                continue
            near = difflib.get_close_matches(name, record["figures"], 1, 0.6)
            hint = f"did you mean '{near[0]}'?" if near else "one of " + ", ".join(list(record["figures"])[:6]) + ", ..."
            raise StudyError(f"unknown figure '{name}': the runs have none of that name; {hint}")

    def run(self, texts_of_runs, jobs, again=False):
        """Has all runs done that are not yet."""
        is_first = is_drawn(self.settings)
        for request, answer in answer_all(self.settings, self.missing(texts_of_runs, again), jobs):
            if is_first:
                distributions.begin_to_load_openturns()
                is_first = False
            self.record(request, answer)
            distributions.mend_signals()

    def planned(self):
        try:
            return plan.runs(self.settings)
        except plan.PlanError as error:
            raise StudyError(str(error)) from None

    def collect(self, texts_of_runs):
        """What the runs of the plan have given: a Results."""
        wanted_runs = {}
        for texts in texts_of_runs:
            wanted_runs.setdefault(self.identity(texts), texts)
        found = {}
        for record in self.folder.read():
            if record["run"] not in wanted_runs:
                continue
            if record["status"] == "completed":
                self.check_names(record)
                figures = record["figures"]
                modes = {k: v for k, v in figures.items() if k.startswith("modes.")} if self.settings["diagram"] else {}
                found[record["run"]] = {
                    "status": "completed", "seconds": record.get("seconds", 0.0), "report": record.get("report", ""),
                    "figures": [number(figures.get(name)) for name in self.settings["wanted"]], "modes": modes}
            else:
                found[record["run"]] = {"status": "failed", "error": record.get("error", "")}
        return Results(self.settings, self.folder.units, wanted_runs, found)


def number(value):
    return math.nan if value is None else float(value)


class Results:
    """The runs of a plan and what they have given, in the units people use."""

    def __init__(self, settings, units, wanted, found):
        self.settings = settings
        self.names = settings["wanted"]
        self.units = {name: units.get(name, {"name": name, "unit": "", "si_unit": "1", "si": 1}) for name in self.names}
        self.runs = [run for run in wanted if found.get(run, {}).get("status") == "completed"]
        self.failed = {run: found[run]["error"] for run in wanted if found.get(run, {}).get("status") == "failed"}
        self.missing = [run for run in wanted if run not in found]
        self.texts = wanted
        self.found = found

    def inputs(self):
        """Values of the parameters, shape (runs, parameters); places in its list of a parameter that is words."""
        import numpy as np

        columns = []
        for k, parameter in enumerate(self.settings["parameters"]):
            texts = [self.texts[run][k] for run in self.runs]
            if parameter.get("distribution"):
                columns.append([float(text.split(" ")[0]) for text in texts])
            else:
                known = dict(zip(parameter["values"], parameter["numbers"]))
                numbers = [known[text] for text in texts]
                places = [parameter["values"].index(text) for text in texts]
                columns.append(places if any(n is None for n in numbers) else numbers)
        return np.array(columns, dtype=float).T.reshape(len(self.runs), len(columns))

    def outputs(self):
        """Figures in their display units, shape (runs, figures)."""
        import numpy as np

        values = np.array([self.found[run]["figures"] for run in self.runs], dtype=float)
        values = values.reshape(len(self.runs), len(self.names))
        return values / np.array([self.units[name]["si"] for name in self.names])

    def bound(self, constraint):
        """A bound in the display unit of its figure."""
        unit = self.units[constraint["name"]]
        si_unit = unit["si_unit"] or "1"
        if si_unit not in constraint["bounds"]:
            raise StudyError(f"subject_to '{constraint['text']}': the figure is in {unit['unit'] or 'no unit'}; "
                             f"expected a bound in {si_unit if si_unit != '1' else 'no unit'}")
        return constraint["bounds"][si_unit] / unit["si"]

    def is_feasible(self):
        """Which runs keep to every bound."""
        import numpy as np

        values = self.outputs()
        good = np.ones(len(self.runs), dtype=bool)
        for constraint in self.settings["constraints"]:
            column = values[:, self.names.index(constraint["name"])]
            bound = self.bound(constraint)
            good &= (column >= bound) if constraint["lower"] else (column <= bound)
        return good


def default_folder(model):
    name = os.path.splitext(os.path.basename(model))[0]
    if name == "model":
        name = os.path.basename(os.path.dirname(os.path.abspath(model))) or name
    return os.path.join("studies", name)


__all__ = ["Results", "Study", "StudyError", "default_folder", "distributions", "load"]
