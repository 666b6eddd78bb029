"""An analysis driver for Dakota: figures of a bearing, and their gradients where Dakota asks for them.

    interface
      fork
        analysis_drivers = 'python3 -m hersey.dakota bearing.yaml'
    variables
      continuous_design = 2
        descriptors 'load' 'clearance'
    responses
      objective_functions = 1
        descriptors 'friction_journal'
      analytic_gradients
      no_hessians

Descriptors of variables are names as `Model.bearing` takes them, or key paths; those of responses are keys of figures. All is
in SI. Files are those of Dakota's manual, chapters "Dakota Parameters File Data Format" (standard) and "Dakota Results File
Data Format". Where no film is found the results are `fail`, which Dakota's `failure_capture` deals with; what is wrong in the
input is an error, without results.
"""

from __future__ import annotations

import argparse
import os
import sys
from typing import Any, NamedTuple, Optional, Sequence

from .errors import HerseyError, InputError, SolutionError
from .model import Model
from .openmdao import slopes, solve

VALUE, GRADIENT, HESSIAN = 1, 2, 4  #: bits of Dakota's active set


class Request(NamedTuple):
    """What a parameters file asks for."""

    values: dict[str, Any]  #: of the variables, by descriptor
    active: dict[str, int]  #: of the responses, by descriptor: bits of what is wanted
    by: list[str]  #: descriptors of the variables by which gradients are


def read_parameters(text: str) -> Request:
    """Reads a parameters file of the standard format. Raises `InputError`.

    >>> read_parameters("1 variables\\n5e2 load\\n1 functions\\n3 ASV_1:h_min\\n1 derivative_variables\\n1 DVV_1:load\\n")
    Request(values={'load': 500.0}, active={'h_min': 3}, by=['load'])
    """
    blocks: dict[str, list[tuple[str, str]]] = {}
    left, block = 0, ""
    for number, line in enumerate(text.splitlines(), 1):
        value, _, tag = line.strip().rpartition(" ")
        if not tag:
            continue
        if left > 0:
            blocks[block].append((value.strip(), tag))
            left -= 1
            continue
        is_array = tag != "eval_id" and value.strip().isdigit()
        block, left = tag, int(value) if is_array else 0
        if not value.strip():
            raise InputError(f"line {number} of Dakota's parameters: '{line.strip()}'; expected a value and its tag: the "
                             "standard format, without `aprepro`")
        blocks[block] = []
    for needed in ("variables", "functions"):
        if needed not in blocks or left > 0:
            raise InputError(f"Dakota's parameters end within or before the block '{needed}'; expected the standard format")
    values = {tag: _number(value) for value, tag in blocks["variables"]}
    active = {tag.partition(":")[2]: int(value) for value, tag in blocks["functions"]}
    names = list(values)
    by = [names[int(value) - 1] for value, _ in blocks.get("derivative_variables", [])]
    return Request(values, active, by)


def _number(text: str) -> Any:
    try:
        return float(text)
    except ValueError:
        return text  # a variable of texts, such as the name of an oil


def answer(model: Model, request: Request, bearing: Optional[str] = None) -> str:
    """The text of a results file. Raises `InputError`; a film that is not found is `fail`."""
    if any(wanted & HESSIAN for wanted in request.active.values()):
        raise InputError("Hessians are asked for; expected `no_hessians` or `quasi_hessians`")
    to = request.by if any(wanted & GRADIENT for wanted in request.active.values()) else []
    try:
        solution = solve(model, bearing, request.values, to)
        by = slopes(solution, to)
        for name in request.active:
            if name not in solution:
                raise InputError(f"no figure '{name}'; there are {', '.join(solution)}")
        lines = [f"{float(solution[name])!r} {name}" for name, wanted in request.active.items() if wanted & VALUE]
        for name, wanted in request.active.items():
            if wanted & GRADIENT:
                missing = [parameter for parameter in to if name not in by[parameter].derivatives]
                if missing:
                    raise SolutionError(f"{name} has no derivative by {', '.join(missing)}")
                lines.append("[ " + " ".join(repr(by[parameter].derivatives[name]) for parameter in to) + " ]")
    except SolutionError as error:
        return f"fail\n{error}\n"
    return "\n".join(lines) + "\n"


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Reads the parameters, solves, writes the results. Returns 0, or 2 where the input is wrong."""
    parser = argparse.ArgumentParser(prog="python3 -m hersey.dakota", description="Analysis driver for Dakota.")
    parser.add_argument("model", help="model file")
    parser.add_argument("parameters", help="file of Dakota's, which names it")
    parser.add_argument("results", help="file for Dakota, which names it")
    parser.add_argument("--bearing", help="which, of a model with several")
    given = parser.parse_args(arguments)
    try:
        with open(given.parameters, encoding="utf-8") as file:
            request = read_parameters(file.read())
        text = answer(Model.load(given.model), request, given.bearing)
        with open(given.results + ".new", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(given.results + ".new", given.results)  # Dakota finds all of it or none
    except (HerseyError, OSError) as error:
        print(f"hersey.dakota: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
