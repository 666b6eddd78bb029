"""Points of the unit interval as values of a parameter."""

import importlib
import math
import signal
import sys
import threading

# Standard deviations off the mean that stand for the smallest and largest value of a distribution without end.
CORNER = 3.0


def quantile(parameter, u):
    """The values of `parameter` at the shares `u` (array, from 0 to 1), in its unit; of a list of values, their places."""
    import numpy as np

    u = np.asarray(u, dtype=float)
    d = parameter.get("distribution")
    if d is None:
        count = len(parameter["values"])
        return np.minimum((u * count).astype(int), count - 1)
    if d["kind"] == "uniform":
        return d["low"] + u * (d["high"] - d["low"])
    if d["kind"] == "triangular":
        low, mode, high = d["low"], d["mode"], d["high"]
        split = (mode - low) / (high - low)
        rising = low + np.sqrt(u * (high - low) * (mode - low))
        falling = high - np.sqrt((1 - u) * (high - low) * (high - mode))
        return np.where(u < split, rising, falling)
    from scipy.special import ndtri

    mean, deviation = d["mean"], d["standard_deviation"]
    if d["kind"] == "normal":
        # The ends of the interval are infinitely far away; no finite sample means them.
        u = np.clip(u, 1e-12, 1 - 1e-12)
        return mean + deviation * ndtri(u)
    low, high = (d["low"] - mean) / deviation, (d["high"] - mean) / deviation
    return np.clip(mean + deviation * _truncated(u, low, high), d["low"], d["high"])


def _truncated(u, low, high):
    """Quantiles of the standard normal distribution between `low` and `high`."""
    import numpy as np
    from scipy.special import log_ndtr, ndtri_exp

    # By logarithms, and from the side of the smaller numbers: right in the tails too, where both ends lie on one side of
    # the mean.
    if low > 0:
        return -_truncated(1 - u, -high, -low)
    with np.errstate(divide="ignore"):
        rising = np.log(np.maximum(u, 0.0)) + log_ndtr(high)
        return ndtri_exp(np.logaddexp(rising, np.log1p(-u) + log_ndtr(low)))


def ends(parameter):
    """Smallest and largest value for a plan of corners."""
    d = parameter.get("distribution")
    if d is None:
        return 0, len(parameter["values"]) - 1
    if d["kind"] == "normal":
        return d["mean"] - CORNER * d["standard_deviation"], d["mean"] + CORNER * d["standard_deviation"]
    return d["low"], d["high"]


def centre(parameter):
    """A value in the middle: the mean, the mode, or between the bounds."""
    d = parameter["distribution"]
    return {"normal": d["mean"], "truncated_normal": d["mean"], "triangular": d["mode"],
            "uniform": 0.5 * (d["low"] + d["high"])}[d["kind"]]


def text(parameter, value):
    """A value as the model file would have it: '40.25 um'. Ten digits, so that the text is the value."""
    if parameter.get("distribution") is None:
        return parameter["values"][int(value)]
    number = f"{value:.10g}"
    if not math.isfinite(float(number)):
        raise ValueError(f"{parameter['name']} has no value {number}")
    return f"{number} {parameter['unit']}".strip()


_loading = None  # a thread, and what Python does at signals


def begin_to_load_openturns():
    """Loads it, which takes half a second, while runs go on; mend_signals() is to be called now and then."""
    global _loading
    if _loading is None and "openturns" not in sys.modules:
        before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
        thread = threading.Thread(target=lambda: importlib.import_module("openturns"), daemon=True)
        _loading = (thread, before)
        thread.start()


def mend_signals():
    """OpenTURNS takes SIGINT for itself and aborts at one: what Python did before is put back."""
    global _loading
    if _loading is None or _loading[0].is_alive() or threading.current_thread() is not threading.main_thread():
        return
    for number, handler in _loading[1].items():
        signal.signal(number, handler)
    _loading = None


def load_openturns():
    """The module."""
    begin_to_load_openturns()
    if _loading is not None:
        _loading[0].join()
        mend_signals()
    return importlib.import_module("openturns")


def to_openturns(parameter):
    """The distribution for OpenTURNS; None of a list of values."""
    ot = load_openturns()
    d = parameter.get("distribution")
    if d is None:
        return None
    if d["kind"] == "normal":
        return ot.Normal(d["mean"], d["standard_deviation"])
    if d["kind"] == "uniform":
        return ot.Uniform(d["low"], d["high"])
    if d["kind"] == "triangular":
        return ot.Triangular(d["low"], d["mode"], d["high"])
    return ot.TruncatedNormal(d["mean"], d["standard_deviation"], d["low"], d["high"])
