"""Which runs a study has: lists of texts, one value per parameter."""

import itertools

from . import distributions

MOST_RUNS = 100_000


class PlanError(Exception):
    """A plan that cannot be made, in words for the user."""


def unit_points(kind, samples, dimensions, seed):
    """Points of the unit cube, shape (samples, dimensions): SciPy's generators, the same for the same seed."""
    import warnings

    from scipy.stats import qmc

    if kind == "latin_hypercube":
        return qmc.LatinHypercube(dimensions, seed=seed).random(samples)
    if kind == "halton":
        return qmc.Halton(dimensions, scramble=True, seed=seed).random(samples)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # balanced at powers of two only, which docs/studies.md says
        return qmc.Sobol(dimensions, scramble=True, seed=seed).random(samples)


def _refuse_many(count):
    if count > MOST_RUNS:
        raise PlanError(f"a plan of {count} runs; expected at most {MOST_RUNS}")


def runs(study):
    """Every run of a study that is not an optimisation, as a list of lists of texts."""
    parameters, kind = study["parameters"], study["plan"]
    if not parameters:
        return [[]]
    if kind == "full_factorial":
        count = 1
        for parameter in parameters:
            count *= len(parameter["values"])
        _refuse_many(count)
        return [list(values) for values in itertools.product(*(p["values"] for p in parameters))]
    if kind == "list":
        return [list(values) for values in zip(*(p["values"] for p in parameters))]
    if kind == "corners":
        _refuse_many(2 ** len(parameters))
        sides = [sorted(set(distributions.ends(p))) for p in parameters]
        return [[distributions.text(p, v) for p, v in zip(parameters, values)] for values in itertools.product(*sides)]
    _refuse_many(study["samples"])
    points = unit_points(kind, study["samples"], len(parameters), study["seed"])
    columns = [distributions.quantile(p, points[:, k]) for k, p in enumerate(parameters)]
    return [[distributions.text(p, columns[k][i]) for k, p in enumerate(parameters)] for i in range(len(points))]
