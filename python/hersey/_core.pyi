from typing import Any, Callable, Optional, Sequence

import numpy as np

__version__: str

class CheckedModel:
    text: str
    file: str
    overrides: list[str]
    title: str
    description: str
    warnings: list[str]
    resolved_text: str
    is_of_bearings_alone: bool
    bearings: list[str]
    study: list[tuple[str, list[str]]]
    def lubricant_of(self, bearing: str) -> str: ...
    def position_of(self, path: str) -> tuple[str, int, int]: ...
    def check(self) -> list[str]: ...

class BearingSolution:
    error: str
    label: str
    warnings: list[str]
    linearisations: int
    wall_time: float
    eccentricity: np.ndarray
    load: np.ndarray
    clearance: float
    stiffness: np.ndarray
    damping: np.ndarray
    phi: np.ndarray
    z: np.ndarray
    def figures(self) -> list[tuple[str, str, str, str, str, float, float, float, str]]: ...
    def fields(self) -> dict[str, tuple[str, str, np.ndarray]]: ...

class BearingSolver:
    def __init__(self) -> None: ...
    def solve(self, model: CheckedModel, bearing: str, grid_error: bool, coefficients: str) -> BearingSolution: ...

class Progress:
    t: float
    t_start: float
    t_end: float
    dt: float
    newton_iterations: int
    moft: float
    elapsed: float

class UserCalls:
    name: str
    calls: int
    seconds: float
    trouble: str
    exception: Optional[BaseException]

class ElasticBody:
    nodes: np.ndarray
    labels: list[int]
    sets: list[str]
    mass: float
    def modes(self, hold: Sequence[str], count: int) -> tuple[np.ndarray, list[np.ndarray], int]: ...
    def solve_static(self, hold: Sequence[str], pressure: dict[str, float], force: dict[str, np.ndarray],
                     gravity: np.ndarray) -> StaticResult: ...
    def reduce(self, frames: Sequence[tuple[str, str, bool]], modes: int, loads: Sequence[str], harmonics: int,
               static_error: float) -> ReducedBody: ...

class StaticResult:
    displacement: np.ndarray
    reaction: np.ndarray
    stress: np.ndarray
    von_mises: np.ndarray
    energy: float

class ReducedBody:
    stiffness: np.ndarray
    mass: np.ndarray
    shapes: np.ndarray
    frequencies: np.ndarray
    def save(self, path: str) -> None: ...

def read_file(path: str, overrides: Sequence[str]) -> CheckedModel: ...
def read_text(text: str, file: str, overrides: Sequence[str]) -> CheckedModel: ...
def written_json(text: str, file: str, overrides: Sequence[str], path: str) -> str: ...
def schema_json() -> str: ...
def parse_quantity(text: str, unit: str) -> float: ...
def solve_all(model: CheckedModel, combinations: Sequence[tuple[str, Sequence[str], Sequence[str]]], bearing: str,
              grid_error: bool, coefficients: str, threads: int) -> list[BearingSolution]: ...
def with_functions(model: CheckedModel, functions: Sequence[tuple[str, Any, Any, int]]) -> tuple[CheckedModel, list[UserCalls]]: ...
def simulate(model: CheckedModel, results: str, overwrite: bool, resume: bool, step_error: bool,
             on_progress: Optional[Callable[[Progress], Any]],
             is_in_trouble: Callable[[], bool]) -> tuple[str, Optional[BaseException], float]: ...
def read_body(file: str, length_unit: str, material: Sequence[str]) -> ElasticBody: ...
def write_report(results: Sequence[str], out: str, title: str) -> None: ...
def summary_table_json(results: Sequence[str]) -> str: ...
def lock_hdf5() -> None: ...
def unlock_hdf5() -> None: ...
