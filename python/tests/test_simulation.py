"""Stepping from Python: the bits of a run, inputs, outputs, saved states, what goes wrong."""

import copy
import pickle

import numpy as np
import pytest

import hersey


def test_steps_have_the_bits_of_a_run(machine, tmp_path):
    model = hersey.Model.from_dict(machine)
    run = model.run(tmp_path / "run").bearing()
    with hersey.Simulation(model, tmp_path / "stepped") as sim:
        thinnest = [sim["bearings.main.h_min"]]
        while sim.step():
            thinnest.append(sim["bearings.main.h_min"])
    assert sim.time == sim.end
    assert np.array_equal(thinnest, run["h_min"].values[: len(thinnest)]) and len(thinnest) >= len(run["h_min"]) - 1
    stepped = hersey.open_results(tmp_path / "stepped")
    assert stepped.status == "completed" and np.array_equal(stepped.bearing()["force"], run["force"])


def test_advance_is_exact_and_ends_with_the_run(machine):
    sim = hersey.Simulation(hersey.Model.from_dict(machine))
    assert sim.advance_to(3.3e-3) and sim.time == pytest.approx(3.3e-3, rel=1e-12)
    with pytest.raises(hersey.InputError, match="not before"):
        sim.advance_to(1e-3)
    sim.advance_to(1.0)
    assert sim.time == sim.end and not sim.step()


def test_inputs_act_and_are_given_back(machine):
    model = hersey.Model.from_dict(machine)
    (name,) = [name for name in hersey.Simulation(model).inputs if name.startswith("forces.push") and name.endswith("y")]
    pushed, left = hersey.Simulation(model), hersey.Simulation(model)
    pushed[name] = "-2 kN"
    assert pushed.input(name) == -2000 and left.input(name) == -500
    for sim in (pushed, left):
        sim.advance_to(5e-3)
    assert pushed["bearings.main.h_min"] < left["bearings.main.h_min"]
    pushed.release(name)
    assert pushed.input(name) == -500


def test_saved_state_goes_on_with_the_same_bits(machine):
    model = hersey.Model.from_dict(machine)
    sim, other = hersey.Simulation(model), hersey.Simulation(model)
    sim.advance_to(4e-3)
    state = sim.save()
    sim.advance_to(8e-3)
    other.restore(state)
    assert other.time == 4e-3
    other.advance_to(8e-3)
    assert np.array_equal(sim["bearings.main.force"], other["bearings.main.force"])
    assert sim["bearings.main.force"].shape == sim.outputs["bearings.main.force"].shape == (3,)


def test_states_about_the_loss_of_a_blade_go_on_with_the_same_bits(machine):
    machine["forces"]["blade"] = {"type": "unbalance", "on": "shaft", "amount": "2 g.m", "begins": "4.13 ms"}
    sim = hersey.Simulation(hersey.Model.from_dict(machine))
    states, courses = [], []
    for until in (4e-3, 4.13e-3, 4.2e-3):  # before it, at it, after it
        sim.advance_to(until)
        states.append(sim.save())

    def course():
        rows = [sim["bearings.main.eccentricity"]]
        while sim.step():
            rows.append(sim["bearings.main.eccentricity"])
        return np.array(rows)

    for state in states * 2:
        sim.restore(state)
        courses.append(course())
    for first, again in zip(courses[:3], courses[3:]):
        assert np.array_equal(first, again)
    assert courses[0][-len(courses[2]):] == pytest.approx(courses[2], rel=1e-9)  # round-off of the instants that are asked for
    machine["forces"].pop("blade")
    without = hersey.Simulation(hersey.Model.from_dict(machine))
    without.advance_to(4.13e-3)
    sim.restore(states[1])
    assert np.array_equal(sim["bearings.main.eccentricity"], without["bearings.main.eccentricity"])
    sim.advance_to(8e-3), without.advance_to(8e-3)
    assert not np.allclose(sim["bearings.main.eccentricity"], without["bearings.main.eccentricity"], rtol=1e-3)


def test_a_controller_of_python_keeps_a_film(machine):
    """A force that lifts the journal where its film is thin: the film stays thicker than without."""
    model = hersey.Model.from_dict(machine)
    name = next(name for name in hersey.Simulation(model).inputs if name.startswith("forces.push") and name.endswith("y"))
    thinnest = []
    for gain in (0, 2e7):
        sim, least = hersey.Simulation(model), 1.0
        while sim.step():
            h = sim["bearings.main.h_min"]
            least = min(least, h)
            if gain:
                sim[name] = -500 + gain * max(0.0, 30e-6 - h)
        thinnest.append(least)
    assert thinnest[1] > thinnest[0]


def test_unknown_names_have_the_nearest(machine):
    sim = hersey.Simulation(hersey.Model.from_dict(machine))
    with pytest.raises(hersey.InputError, match="bearings.main.h_min"):
        sim["bearings.main.hmin"]
    with pytest.raises(hersey.InputError, match="unknown input"):
        sim["nothing"] = 1
    with pytest.raises(hersey.InputError):
        sim[next(iter(sim.inputs))] = "3 parrots"


def test_failure_is_reported_with_the_last_good_time(machine, tmp_path):
    machine["forces"]["push"]["components"] = ["0 N", {"expression": "t < 0.004 ? -500 : log(-1)", "unit": "N"}, "0 N"]
    machine["simulation"]["smallest_step"] = "0.1 ms"
    sim = hersey.Simulation(hersey.Model.from_dict(machine), tmp_path)
    with pytest.raises(hersey.RunError) as caught:
        sim.advance_to(1)
    assert 3e-3 < sim.time <= 4.2e-3
    assert len(caught.value.results.bearing()["time"]) > 10


def test_bearings_alone_are_not_stepped(alone):
    with pytest.raises(hersey.InputError, match="model.bearing"):
        hersey.Simulation(alone)


def test_saved_states_pickle_and_copy(machine):
    model = hersey.Model.from_dict(machine)
    sim = hersey.Simulation(model)
    sim.advance_to(2e-3)
    state = sim.save()
    sim.advance_to(4e-3)
    for again in (pickle.loads(pickle.dumps(state)), copy.copy(state), copy.deepcopy(state)):
        other = hersey.Simulation(pickle.loads(pickle.dumps(model)))
        other.restore(again)
        assert other.time == 2e-3
        other.advance_to(4e-3)
        assert np.array_equal(sim["bearings.main.force"], other["bearings.main.force"])
