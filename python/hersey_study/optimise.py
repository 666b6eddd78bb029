"""The best values of parameters, by NLopt. Its methods repeat themselves exactly, so that what the folder holds already
is not computed again: a search that was killed goes on where it was."""

import math

from . import distributions
from .study import StudyError, number
from .workers import answer_all

# Steps below this share of a parameter's range are not worth a run.
TOLERANCE = 1e-4
# Nor are gains below this share of the objective, where derivatives tell that there are no larger ones near.
GAIN = 1e-6
# Bounds are kept to this share of theirs inside: an optimum that lies on one is not to be beyond it by round-off.
INSIDE = 1e-6
# What a run without an answer counts as: worse than any other.
WORST = 1e6


def _known(study):
    return {record["run"]: record for record in study.folder.read()}


class _Runs:
    """Runs at points of the unit cube, each done once, and what they say about objective and bounds."""

    def __init__(self, study):
        import numpy as np

        self.study, self.parameters = study, study.settings["parameters"]
        self.low = np.array([p["distribution"]["low"] for p in self.parameters])
        self.range = np.array([p["distribution"]["high"] for p in self.parameters]) - self.low
        self.known, self.observed, self.looked_at = _known(study), [], set()
        self.names = [study.settings["objectives"][0]["name"], *(c["name"] for c in study.settings["constraints"])]

    def at(self, x, slopes=False):
        """The record of a run, with its derivatives or the reason why there are none if `slopes`."""
        study = self.study
        texts = [distributions.text(p, v) for p, v in zip(self.parameters, self.low + x * self.range)]
        run = study.identity(texts)
        self.observed.append(texts)
        self.looked_at.add(run)
        record = self.known.get(run)
        is_asked = slopes and record is not None and record["status"] == "completed" and not (
            "slopes" in record or "no_slopes" in record)
        if record is None or is_asked:
            for request, answer in answer_all(study.settings, iter([study.request(texts, slopes)]), 1):
                if slopes and request is not None and "slopes" not in answer:
                    answer.setdefault("no_slopes", "what answers the runs tells none")
                study.record(request, answer)
                if request is not None:
                    self.known[run] = record = answer
        if record["status"] == "completed":
            study.check_names(record)
        return record

    def why_no_slopes(self, record):
        """Why a record has not the derivatives of all that is asked for; empty: it has them."""
        if record["status"] != "completed":
            return "the run failed"
        slopes = record.get("slopes")
        if slopes is None:
            return record.get("no_slopes", "none were asked for")
        for parameter in self.parameters:
            for name in self.names:
                if not math.isfinite(number(slopes.get(parameter["name"], {}).get(name))):
                    return f"there is none of {name} with {parameter['name']}"
        return ""

    def slope(self, record, name):
        """Of a figure in SI over the edges of the unit cube."""
        return [record["slopes"][p["name"]][name] * r for p, r in zip(self.parameters, self.range)]


def figure_of(record, name):
    return number(record["figures"].get(name)) if record["status"] == "completed" else math.nan


def search(study, jobs):
    """Runs the search. Returns the texts of every run it has looked at, in order.

    With derivatives (Answer.slopes) sequential quadratic programming, else COBYLA; study.search says which and why.
    """
    try:
        import nlopt
        import numpy as np
    except ImportError:
        raise StudyError("plan 'optimise' needs NLopt for Python: `scripts/setup study` installs it "
                         "(python3-nlopt)") from None
    settings = study.settings
    parameters, objective = settings["parameters"], settings["objectives"][0]
    if not parameters:
        raise StudyError("plan 'optimise' with every parameter fixed by --set; expected one that is free")
    runs = _Runs(study)
    start = _start(parameters, runs.low, runs.range)
    first = runs.at(start, slopes=True)
    if first["status"] != "completed":
        raise StudyError(f"the search's first run failed: {first.get('error', '')}; expected bounds within which the "
                         "middle has a solution, or a parameter whose own value has one")
    sign = -1.0 if objective["maximise"] else 1.0
    scale = abs(figure_of(first, objective["name"])) or 1.0
    failures = []  # why derivatives are given up

    def function(name, factor, offset, with_slopes, margin=0.0):
        """factor (figure - offset) + margin, its gradient where it is asked for, of the run at x."""

        def of(x, gradient):
            if with_slopes and len(runs.looked_at) >= settings["samples"]:
                raise nlopt.ForcedStop
            record = runs.at(x, slopes=with_slopes)
            value = figure_of(record, name)
            if gradient.size:
                gradient[:] = 0.0
                if math.isfinite(value):
                    why = runs.why_no_slopes(record)
                    if why:
                        failures.append(why)
                        raise nlopt.ForcedStop
                    gradient[:] = [factor * slope for slope in runs.slope(record, name)]
            return factor * (value - offset) + margin if math.isfinite(value) else WORST

        return of

    def run(method, x, most, seeded=False, with_slopes=False):
        optimiser = nlopt.opt(method, len(parameters))
        optimiser.set_lower_bounds(0.0)
        optimiser.set_upper_bounds(1.0)
        optimiser.set_min_objective(function(objective["name"], sign / scale, 0.0, with_slopes))
        for constraint in settings["constraints"]:
            bound = _bound(study, constraint)
            side = -1.0 if constraint["lower"] else 1.0
            optimiser.add_inequality_constraint(
                function(constraint["name"], side / (abs(bound) or 1.0), bound, with_slopes, INSIDE), INSIDE)
        optimiser.set_maxeval(most)
        optimiser.set_xtol_abs(TOLERANCE)
        if with_slopes:
            optimiser.set_ftol_rel(GAIN)
        elif seeded:
            nlopt.srand(settings["seed"] + 1)
        else:
            optimiser.set_initial_step(0.1)
        try:
            return optimiser.optimize(x)
        except (nlopt.RoundoffLimited, nlopt.ForcedStop, RuntimeError):
            return x

    x, budget = start, settings["samples"]
    before = []
    if settings["search"] == "global":
        before = ["ISRES"]
        run(nlopt.GN_ISRES, x, max(budget // 2, 1), seeded=True)
        x = _best_of(study, runs, x)
    why = runs.why_no_slopes(first)
    if not why:
        run(nlopt.LD_SLSQP, x, 10 * budget, with_slopes=True)
        if not failures:
            study.search = {"methods": [*before, "SLSQP"], "derivatives": "exact", "reason": "", "runs": len(runs.looked_at)}
            return runs.observed
        why, before = failures[0], [*before, "SLSQP"]
        x = _best_of(study, runs, x)
    run(nlopt.LN_COBYLA, x, budget)
    study.search = {"methods": [*before, "COBYLA"], "derivatives": "none", "reason": why, "runs": len(runs.looked_at)}
    return runs.observed


def _start(parameters, low, extent):
    import numpy as np

    start = [p["nominal"] if p["nominal"] is not None else distributions.centre(p) for p in parameters]
    return np.clip((np.array(start) - low) / extent, 0.0, 1.0)


def _bound(study, constraint):
    unit = study.folder.units.get(constraint["name"], {"si_unit": "1"})["si_unit"] or "1"
    if unit not in constraint["bounds"]:
        raise StudyError(f"subject_to '{constraint['text']}': the figure is in {unit}; expected a bound in {unit}")
    return constraint["bounds"][unit]


def _best_of(study, runs, otherwise):
    """The best run so far that keeps to every bound, as a point of the unit cube."""
    import numpy as np

    settings = study.settings
    objective = settings["objectives"][0]
    best, where = math.inf, otherwise
    for texts in runs.observed:
        record = runs.known[study.identity(texts)]
        if record["status"] != "completed":
            continue
        figures = record["figures"]
        value = number(figures.get(objective["name"])) * (-1.0 if objective["maximise"] else 1.0)
        keeps = all((number(figures.get(c["name"])) >= _bound(study, c)) == c["lower"] for c in settings["constraints"])
        if keeps and value < best:
            best = value
            where = (np.array([float(t.split(" ")[0]) for t in texts]) - runs.low) / runs.range
    return np.clip(where, 0.0, 1.0)
