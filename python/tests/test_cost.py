"""What Python costs beside the solver."""

import time

import pytest

import hersey


@pytest.fixture(scope="module")
def cycle(tmp_path_factory):
    """As many rows and fields as an engine leaves of 720 degrees: every half degree, and every five."""
    from conftest import MACHINE

    machine = {**MACHINE, "bearings": {"main": {**MACHINE["bearings"]["main"], "grid": {"circumferential": 60, "axial": 13}}},
               "simulation": {"duration": "144 ms", "step": "0.1 ms"}, "output": {"fields_every": "1 ms"}}
    model = hersey.Model.from_dict(machine)
    begin = time.perf_counter()
    results = model.run(tmp_path_factory.mktemp("cycle"), progress=True)
    return results, time.perf_counter() - begin


def test_python_takes_little_of_a_run(cycle):
    results, seconds = cycle
    # What the solver does not count as its own; the bar's calls are inside, at most ten thousand of some microseconds.
    assert seconds - results.summary["wall_time"] < 0.02 * seconds


def test_a_cycle_is_read_in_half_a_second(cycle):
    results, _ = cycle
    results.bearing()  # what is imported once
    begin = time.process_time()
    film, fields = results.bearing().load(), results.film().load()
    assert time.process_time() - begin < 0.5
    assert len(film["time"]) == 1441 and fields["pressure"].shape == (145, 60, 13)
