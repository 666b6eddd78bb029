"""A bearing as a component of OpenMDAO, with exact derivatives.

    import openmdao.api as om
    from hersey.openmdao import BearingComponent

    problem = om.Problem()
    problem.model.add_subsystem("film", BearingComponent(model="bearing.yaml", inputs=["load", "clearance"],
                                                         outputs=["h_min", "friction_journal"]), promotes=["*"])
    problem.setup()
    problem.run_model()
    problem.compute_totals(of=["h_min"], wrt=["load", "clearance"])

OpenMDAO (pip install openmdao, 3.0 or later) is imported when `BearingComponent` is asked for, and not before.
"""

from __future__ import annotations

import functools
from typing import Any, Sequence

from .errors import InputError, SolutionError
from .model import Model

__all__ = ["BearingComponent"]


def variable_name(name: str) -> str:
    """The name of an input or a figure as OpenMDAO allows it: its own paths have the dots.

    >>> variable_name("bearings.main.width")
    'bearings:main:width'
    """
    return name.replace(".", ":")


def unit_name(unit: str) -> Any:
    """A unit as OpenMDAO writes it; None of a pure number.

    >>> unit_name("m^3/s"), unit_name("N.m"), unit_name("1")
    ('m**3/s', 'N*m', None)
    """
    return None if unit in ("", "1") else unit.replace("^", "**").replace(".", "*")


def solve(model: Model, bearing: Any, values: dict[str, Any], to: Sequence[str] = ()) -> Any:
    """A bearing at values by the names of `Model.bearing` or by key paths, with derivatives by those in `to`."""
    paths = {name: value for name, value in values.items() if "." in name}
    if paths:
        model = model.copy()
        model.set(paths)
    named = {name: value for name, value in values.items() if "." not in name}
    return model.bearing(bearing, grid_error=False, sensitivity_to=list(to), **named)


def slopes(solution: Any, to: Sequence[str]) -> dict[str, Any]:
    """The sensitivities of a solution under the names by which they were asked for.

    Raises `SolutionError` where there are none, with the reason.
    """
    found = dict(zip(to, solution.sensitivities.values()))
    for name, each in found.items():
        if each.error:
            raise SolutionError(f"no derivatives by {name}: {each.error}")
    return found


@functools.lru_cache(maxsize=None)
def _component_class() -> Any:
    try:
        import openmdao.api as om
    except ImportError as error:
        raise ImportError("hersey.openmdao needs OpenMDAO, which is not installed: pip install openmdao") from error

    class BearingComponent(om.ExplicitComponent):
        """Figures of a steady bearing by numbers of its model.

        Options: `model`, a `hersey.Model` or the path of a model file; `inputs`, names as `Model.bearing` takes them, or
        key paths, in which dots become colons; `outputs`, keys of figures; `bearing`, of a model with several. Inputs begin
        at the model's own values; all is in SI. Partial derivatives are those of `Model.bearing(sensitivity_to=...)`. Where
        no film is found, or a value is none that the model takes, it raises OpenMDAO's `AnalysisError`, from which optimisers
        step back.
        """

        def initialize(self) -> None:
            """Declares the options."""
            self.options.declare("model")
            self.options.declare("inputs", types=(list, tuple))
            self.options.declare("outputs", types=(list, tuple))
            self.options.declare("bearing", default=None, allow_none=True)

        def setup(self) -> None:
            """Solves the model as it stands, which gives units and first values. Raises `InputError`."""
            model = self.options["model"]
            self._hersey_model = model if isinstance(model, Model) else Model.load(str(model))
            self._hersey_inputs, self._hersey_outputs = list(self.options["inputs"]), list(self.options["outputs"])
            first = solve(self._hersey_model, self.options["bearing"], {}, self._hersey_inputs)
            for name, each in slopes(first, self._hersey_inputs).items():
                self.add_input(variable_name(name), val=each.value, units=unit_name(each.unit))
            for name in self._hersey_outputs:
                if name not in first:
                    raise InputError(f"no figure '{name}'; there are {', '.join(first)}")
                self.add_output(variable_name(name), val=float(first[name]), units=unit_name(first[name].unit))
            self.declare_partials("*", "*")

        def _hersey_solution(self, inputs: Any, to: Sequence[str] = ()) -> Any:
            values = {name: float(inputs[variable_name(name)].item()) for name in self._hersey_inputs}
            try:
                return solve(self._hersey_model, self.options["bearing"], values, to)
            except (SolutionError, InputError) as error:  # names are good since setup: a value is out of its range
                raise om.AnalysisError(str(error)) from error

        def compute(self, inputs: Any, outputs: Any, discrete_inputs: Any = None, discrete_outputs: Any = None) -> None:
            """Solves the film at the inputs."""
            solution = self._hersey_solution(inputs)
            for name in self._hersey_outputs:
                outputs[variable_name(name)] = float(solution[name])

        def compute_partials(self, inputs: Any, partials: Any, discrete_inputs: Any = None) -> None:
            """Solves the film and its derivatives."""
            solution = self._hersey_solution(inputs, self._hersey_inputs)
            for name, each in slopes(solution, self._hersey_inputs).items():
                for figure in self._hersey_outputs:
                    if figure not in each.derivatives:
                        raise om.AnalysisError(f"{figure} has no derivative by {name}")
                    partials[variable_name(figure), variable_name(name)] = each.derivatives[figure]

    return BearingComponent


def __getattr__(name: str) -> Any:
    if name == "BearingComponent":
        return _component_class()
    raise AttributeError(f"module 'hersey.openmdao' has no attribute '{name}'")
