"""Which runs a study has: lists of texts, one value per parameter."""

import importlib
import itertools
import os
import sys
import types

from . import distributions

MOST_RUNS = 100_000


class PlanError(Exception):
    """A plan that cannot be made, in words for the user."""


def _generators():
    """SciPy's module of them. The package around it, scipy.stats, takes a third of a second to load and is not needed:
    its folder stands in for it meanwhile, where this version of SciPy can do with that."""
    if "scipy.stats" not in sys.modules:
        import scipy

        package = types.ModuleType("scipy.stats")
        package.__path__ = [os.path.join(folder, "stats") for folder in scipy.__path__]
        sys.modules["scipy.stats"] = package
        try:
            return importlib.import_module("scipy.stats._qmc")
        except (ImportError, AttributeError):
            pass
        finally:
            for name in [name for name in sys.modules if name == "scipy.stats" or name.startswith("scipy.stats.")]:
                del sys.modules[name]
            vars(scipy).pop("stats", None)
    return importlib.import_module("scipy.stats.qmc")


def unit_points(kind, samples, dimensions, seed):
    """Points of the unit cube, shape (samples, dimensions): SciPy's generators, the same for the same seed."""
    import warnings

    qmc = _generators()
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
