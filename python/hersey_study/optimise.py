"""The best values of parameters, by NLopt. Its methods repeat themselves exactly, so that what the folder holds already
is not computed again: a search that was killed goes on where it was."""

import math

from . import distributions
from .folder import identity
from .study import StudyError, number
from .workers import answer_all

# Steps below this share of a parameter's range are not worth a run.
TOLERANCE = 1e-4


def _known(study):
    return {record["run"]: record for record in study.folder.read()}


def search(study, jobs):
    """Runs the search. Returns the texts of every run it has looked at, in order."""
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
    low = np.array([p["distribution"]["low"] for p in parameters])
    high = np.array([p["distribution"]["high"] for p in parameters])
    known, seen = _known(study), []

    def record_at(x):
        texts = [distributions.text(p, v) for p, v in zip(parameters, low + x * (high - low))]
        run = identity(settings, texts)
        seen.append(texts)
        if run not in known:
            for request, answer in answer_all(settings, iter([study.request(texts)]), 1):
                study.record(request, answer)
                if request is not None:
                    known[run] = answer
        record = known[run]
        if record["status"] == "completed":
            study.check_names(record)
        return record

    def figure(record, name):
        return number(record["figures"].get(name)) if record["status"] == "completed" else math.nan

    first = record_at(_start(parameters, low, high))
    if first["status"] != "completed":
        raise StudyError(f"the search's first run failed: {first.get('error', '')}; expected bounds within which the "
                         "middle has a solution, or a parameter whose own value has one")
    sign = -1.0 if objective["maximise"] else 1.0
    scale = abs(figure(first, objective["name"])) or 1.0

    def cost(x, gradient):
        value = figure(record_at(x), objective["name"])
        # A run without an answer is worse than any other.
        return sign * value / scale if math.isfinite(value) else 1e6

    def violation(constraint):
        bound = _bound(study, constraint)
        size = abs(bound) or 1.0
        side = -1.0 if constraint["lower"] else 1.0

        def of(x, gradient):
            value = figure(record_at(x), constraint["name"])
            return side * (value - bound) / size if math.isfinite(value) else 1e6

        return of

    def run(method, x, most, seeded):
        optimiser = nlopt.opt(method, len(parameters))
        optimiser.set_lower_bounds(0.0)
        optimiser.set_upper_bounds(1.0)
        optimiser.set_min_objective(cost)
        for constraint in settings["constraints"]:
            optimiser.add_inequality_constraint(violation(constraint), 1e-6)
        optimiser.set_maxeval(most)
        optimiser.set_xtol_abs(TOLERANCE)
        if seeded:
            nlopt.srand(settings["seed"] + 1)
        else:
            optimiser.set_initial_step(0.1)
        try:
            return optimiser.optimize(x)
        except (nlopt.RoundoffLimited, nlopt.ForcedStop):
            return x

    x = _start(parameters, low, high)
    budget = settings["samples"]
    if settings["search"] == "global":
        x = run(nlopt.GN_ISRES, x, max(budget // 2, 1), True)
        x = _best_of(study, seen, known, low, high, x)
    run(nlopt.LN_COBYLA, x, budget, False)
    return seen


def _start(parameters, low, high):
    import numpy as np

    start = [p["nominal"] if p["nominal"] is not None else distributions.centre(p) for p in parameters]
    return np.clip((np.array(start) - low) / (high - low), 0.0, 1.0)


def _bound(study, constraint):
    unit = study.folder.units.get(constraint["name"], {"si_unit": "1"})["si_unit"] or "1"
    if unit not in constraint["bounds"]:
        raise StudyError(f"subject_to '{constraint['text']}': the figure is in {unit}; expected a bound in {unit}")
    return constraint["bounds"][unit]


def _best_of(study, seen, known, low, high, otherwise):
    """The best run so far that keeps to every bound, as a point of the unit cube."""
    import numpy as np

    settings = study.settings
    objective = settings["objectives"][0]
    best, where = math.inf, otherwise
    for texts in seen:
        record = known[identity(settings, texts)]
        if record["status"] != "completed":
            continue
        figures = record["figures"]
        value = number(figures.get(objective["name"])) * (-1.0 if objective["maximise"] else 1.0)
        keeps = all((number(figures.get(c["name"])) >= _bound(study, c)) == c["lower"] for c in settings["constraints"])
        if keeps and value < best:
            best = value
            where = (np.array([float(t.split(" ")[0]) for t in texts]) - low) / (high - low)
    return np.clip(where, 0.0, 1.0)
