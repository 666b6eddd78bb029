"""Oil-film bearings inside moving machines.

    import hersey

    model = hersey.Model.load("engine.yaml")
    model["bearings.big_end.radial_clearance"] = "40 um"
    results = model.run(output="out", progress=True)
    results.bearing("big_end")["h_min"].plot()

Numbers that come out are SI. Quantities that go in are texts with their unit, "40 um", pairs, (40, "um"), or quantities of
pint's; a bare number is SI.
"""

from . import fem, plot
from ._core import Progress, __version__
from .bearing import BearingSolution, Sensitivity
from .errors import Fault, HerseyError, InputError, RunError, SolutionError, Stopped, UserFunctionError
from .figure import Figure
from .functions import Function, surface_profile, viscosity_law
from .model import Model
from .one_bearing import bearing, bearing_model
from .orders import order_tracking
from .results import Results, Summary, open_results, report
from .simulation import Port, Simulation
from .studies import Study, study

__all__ = [
    "BearingSolution", "Fault", "Figure", "Function", "HerseyError", "InputError", "Model", "Port", "Progress", "Results", "RunError",
    "Sensitivity", "Simulation", "SolutionError", "Stopped", "Study", "Summary", "UserFunctionError", "__version__", "bearing",
    "bearing_model", "fem", "open_results", "order_tracking", "plot", "report", "study", "surface_profile", "viscosity_law",
]
