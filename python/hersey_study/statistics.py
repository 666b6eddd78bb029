"""What the runs of a study say: scatter, Sobol indices, surrogate, sensitivities, the best of them."""

import math

import numpy as np

from . import distributions
from .study import is_drawn

PERCENTILES = (1, 5, 25, 50, 75, 95, 99)
# With fewer runs than this for each parameter a surrogate has nothing to go by.
RUNS_PER_PARAMETER = 4
MOST_TERMS = 400
MOST_DEGREES = 14
# Runs that a surrogate is fitted to, and more where each parameter would have fewer than the second number: what there
# are beside them would cost minutes and change the third digit.
MOST_FITTED, MOST_FITTED_PER_PARAMETER = 1024, 100
# Errors as shares of the variance: below the first a higher degree is not worth its time, and above the second lower
# ones have not yet observed what there is to see.
SMALL_ERROR, LARGE_ERROR = 1e-6, 0.1


def scatter(values):
    """Mean, deviation, extremes and percentiles of one figure."""
    values = values[np.isfinite(values)]
    if not len(values):
        return None
    return {"count": len(values), "mean": float(values.mean()),
            "standard_deviation": float(values.std(ddof=1)) if len(values) > 1 else 0.0,
            "smallest": float(values.min()), "largest": float(values.max()),
            "percentiles": {str(p): float(v) for p, v in zip(PERCENTILES, np.percentile(values, PERCENTILES))}}


def degrees(dimensions, runs):
    """Of the polynomials, those to try: their terms are no more than half the runs, and few enough to be quick."""
    most = min(runs // 2, MOST_TERMS)
    tried = [n for n in range(1, MOST_DEGREES + 1) if n == 1 or math.comb(dimensions + n, dimensions) <= most]
    # Every one up to 4, then every second one.
    return [n for n in tried if n <= 4 or (n - tried[-1]) % 2 == 0]


def surrogate(settings, inputs, values):
    """Polynomial chaos by OpenTURNS: least squares on a sparse basis, chosen by cross-validation.

    Returns Sobol indices (they follow from its coefficients), first-order sensitivities at the centre, its curves over
    each parameter, and its error on runs that it has not observed: None without enough runs.
    """
    count = len(settings["parameters"])
    good = np.flatnonzero(np.isfinite(values))[: max(MOST_FITTED, MOST_FITTED_PER_PARAMETER * count)]
    inputs, values = inputs[good], values[good]
    if not count or len(values) < max(RUNS_PER_PARAMETER * count, 8):
        return None
    spread = values.std()
    if spread <= 1e-12 * max(abs(values).max(), 1e-300):
        return None
    ot = distributions.load_openturns()
    ot.Log.Show(ot.Log.NONE)
    marginals = [distributions.to_openturns(p) for p in settings["parameters"]]
    joint = ot.ComposedDistribution(marginals)

    def fit(x, y, most):
        basis = ot.OrthogonalProductPolynomialFactory(marginals, ot.LinearEnumerateFunction(count))
        strategy = ot.FixedStrategy(basis, math.comb(count + most, count))
        chosen = ot.LeastSquaresStrategy(
            ot.LeastSquaresMetaModelSelectionFactory(ot.LARS(), ot.CorrectedLeaveOneOut()))
        algorithm = ot.FunctionalChaosAlgorithm(ot.Sample(x), ot.Sample(y.reshape(-1, 1)), joint, strategy, chosen)
        algorithm.run()
        return algorithm.getResult()

    def best_fit(x, y):
        """The degree whose error by leaving out one run is least; higher ones are not tried once two have been worse."""
        best, least, grown = None, math.inf, 0
        for most in degrees(count, len(y)):
            result = fit(x, y, most)
            error = result.getRelativeErrors()[0]
            grown = grown + 1 if error >= least else 0
            if best is None or error < least:
                best, least = (most, result), error
            if least < SMALL_ERROR or (grown >= 2 and least < LARGE_ERROR):
                break
        return best

    scaled = values / spread
    chosen_degree, result = best_fit(inputs, scaled)
    indices = ot.FunctionalChaosSobolIndices(result)
    model = result.getMetaModel()
    middle = np.array([distributions.centre(p) for p in settings["parameters"]])
    lines, slopes = [], []
    for k, parameter in enumerate(settings["parameters"]):
        low, high = np.quantile(inputs[:, k], [0.0, 1.0])
        x = np.linspace(low, high, 41)
        points = np.tile(middle, (len(x), 1))
        points[:, k] = x
        y = np.array(model(ot.Sample(points))).ravel() * spread
        lines.append({"x": x.tolist(), "y": y.tolist()})
        step = 1e-3 * (high - low)
        ends = np.tile(middle, (2, 1))
        ends[:, k] += [-step, step]
        below, above = np.array(model(ot.Sample(ends))).ravel() * spread
        slopes.append(float((above - below) / (2 * step)))
    # Error on runs that were left out: five parts, each predicted from the other four.
    parts = np.arange(len(scaled)) % 5
    predicted = np.empty_like(scaled)
    for part in range(5):
        out = parts == part
        predicted[out] = np.array(fit(inputs[~out], scaled[~out], chosen_degree).getMetaModel()(ot.Sample(inputs[out]))).ravel()
    error = float(((predicted - scaled) ** 2).mean() / scaled.var())
    return {"terms": len(result.getIndices()), "degree": chosen_degree, "cross_validated_error": error,
            "first": [indices.getSobolIndex(k) for k in range(count)],
            "total": [indices.getSobolTotalIndex(k) for k in range(count)],
            "centre": float(model(middle)[0] * spread), "sensitivities": slopes, "lines": lines}


def corners(results):
    """Runs with the smallest and the largest value of each figure."""
    values = results.outputs()
    found = []
    for k, name in enumerate(results.names):
        column = values[:, k]
        if not np.isfinite(column).any():
            continue
        for word, place in (("smallest", np.nanargmin(column)), ("largest", np.nanargmax(column))):
            found.append({"figure": name, "which": word, "value": float(column[place]), "run": results.runs[place]})
    return found


def pareto(results):
    """Runs that keep to every bound and that none other beats in all objectives; with one objective: the best."""
    objectives = results.settings["objectives"]
    if not objectives or not results.runs:
        return []
    values = results.outputs()[:, [results.names.index(o["name"]) for o in objectives]]
    values = values * np.array([-1.0 if o["maximise"] else 1.0 for o in objectives])
    good = np.flatnonzero(results.is_feasible() & np.isfinite(values).all(axis=1))
    front = [i for i in good
             if not any((values[j] <= values[i]).all() and (values[j] < values[i]).any() for j in good)]
    return [results.runs[i] for i in sorted(front, key=lambda i: values[i, 0])]


def summary(results):
    """All of it, as plain data."""
    settings = results.settings
    inputs, values = results.inputs(), results.outputs()
    figures = []
    for k, name in enumerate(results.names):
        figure = {"key": name, "name": results.units[name]["name"], "unit": results.units[name]["unit"],
                  "scatter": scatter(values[:, k]) if len(values) else None, "surrogate": None}
        if is_drawn(settings) and len(values):
            figure["surrogate"] = surrogate(settings, inputs, values[:, k])
        figures.append(figure)
    return {"figures": figures, "corners": corners(results), "best": pareto(results)}
