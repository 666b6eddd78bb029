"""The strict reader from Python."""

import copy
import json
import math
import pickle
import subprocess

import pytest

import hersey


def test_values_read_as_written(alone):
    assert alone["bearings.main.radial_clearance"] == "34 um"
    assert alone["load"] == alone["parameters.load"] == "2500 N"
    assert alone["bearings.main.grid"] == {"circumferential": 120, "axial": 25}
    assert alone["bearings.main.operating_point.load"] == "2500 N"  # its parameter in place


def test_assigned_value_is_in_the_model_and_in_what_the_program_is_given(alone, program, bearing_file):
    alone["bearings.main.radial_clearance"] = "40 um"
    alone["load"] = "1 kN"
    assert alone["bearings.main.radial_clearance"] == "40 um"
    options = [part for change in alone.changes for part in ("--set", change)]
    run = subprocess.run([program, "bearing", bearing_file, "--json", *options], capture_output=True, text=True, check=True)
    figures = json.loads(run.stdout)["solutions"][0]["figures"]
    solution = alone.bearing()
    for key, figure in figures.items():
        if figure["value"] is not None:
            assert solution[key] == figure["value"], key  # the same arithmetic: the same bits
            assert solution[key].unit == (figure["unit"] or "1")


def test_assigning_twice_keeps_one_change(alone):
    for clearance in ("40 um", "50 um"):
        alone["bearings.main.radial_clearance"] = clearance
    assert alone.changes == ["bearings.main.radial_clearance=50 um"]


def test_wrong_value_tells_file_line_and_key_and_changes_nothing(alone, bearing_file):
    with pytest.raises(hersey.InputError) as caught:
        alone["bearings.main.radial_clearance"] = "40 kPa"
    error = caught.value
    line = 1 + [*map(str.strip, alone.text.split("\n"))].index("radial_clearance: 34 um")
    assert (error.file, error.line, error.key) == (str(bearing_file), line, "bearings.main.radial_clearance")
    assert "a pressure (kPa)" in str(error) and "a length > 0" in str(error)
    assert alone["bearings.main.radial_clearance"] == "34 um"


def test_every_fault_of_a_file_is_reported(tmp_path, alone):
    file = tmp_path / "model.yaml"
    file.write_text(alone.text.replace("diameter: 45 mm", "diamter: 45 mm").replace("width: 15.6 mm", "width: 15.6"))
    with pytest.raises(hersey.InputError) as caught:
        hersey.Model.load(file)
    assert len(caught.value.faults) >= 2
    assert any("did you mean 'diameter'?" in fault.text and fault.line > 0 for fault in caught.value.faults)


def test_missing_file_is_reported_as_by_the_program(tmp_path):
    with pytest.raises(hersey.InputError, match="nothing.yaml"):
        hersey.Model.load(tmp_path / "nothing.yaml")


def test_missing_key_names_the_nearest(alone):
    with pytest.raises(hersey.InputError, match="did you mean 'radial_clearance'"):
        alone["bearings.main.radial_clearanc"]
    assert "bearings.main.coupling" not in alone and alone.get("bearings.main.coupling", 3) == 3


def test_dictionary_makes_the_same_model_as_its_file(alone):
    again = hersey.Model.from_dict(alone.to_dict())
    assert dict(again.bearing()) == pytest.approx(dict(alone.bearing()), nan_ok=True, rel=0, abs=0)


def test_dictionary_takes_numpy_numbers(machine):
    numpy = pytest.importorskip("numpy")
    machine["bearings"]["main"]["grid"] = {"circumferential": numpy.int64(48), "axial": numpy.int32(9)}
    assert hersey.Model.from_dict(machine)["bearings.main.grid.axial"] == 9


def test_value_without_place_in_a_model_is_refused(alone):
    with pytest.raises(TypeError, match="has no place in a model"):
        alone["load"] = object()


def test_text_cannot_break_out_of_its_place(alone):
    alone["title"] = 'a: "b", {c: [d]} # e'
    assert alone["title"] == alone.title == 'a: "b", {c: [d]} # e'


def test_study_becomes_a_model_for_each_combination():
    from conftest import EXAMPLES

    model = hersey.Model.load(EXAMPLES / "paper_big_end" / "model.yaml")
    models = model.runs()
    count = 1
    for texts in model.study.values():
        count *= len(texts)
    assert len(models) == count > 1
    assert len({tuple(each.changes) for each in models}) == count
    with pytest.raises(hersey.InputError, match="study varies"):
        model.run()


def test_study_that_lists_its_runs_becomes_one_model_for_each():
    study = {"plan": "list", "parameters": {"bearings.main.width": ["15 mm", "16 mm"],
                                            "bearings.main.radial_clearance": ["30 um", "40 um"]}}
    models = hersey.Model.from_dict({"lubricants": {"oil": {"viscosity": "15 mPa.s"}}, "study": study, "bearings": {
        "main": {"diameter": "45 mm", "width": "15 mm", "radial_clearance": "34 um", "lubricant": "oil"}}}).runs()
    assert [(each["bearings.main.width"], each["bearings.main.radial_clearance"]) for each in models] == [
        ("15 mm", "30 um"), ("16 mm", "40 um")]


def test_study_that_draws_its_runs_becomes_no_models():
    study = {"plan": "sobol", "samples": 8, "parameters": {"bearings.main.width": ["15 mm", "16 mm"]}}
    model = hersey.Model.from_dict({"lubricants": {"oil": {"viscosity": "15 mPa.s"}}, "study": study, "bearings": {
        "main": {"diameter": "45 mm", "width": "15 mm", "radial_clearance": "34 um", "lubricant": "oil"}}})
    with pytest.raises(hersey.InputError, match=r"a plan that draws or looks for its runs.*hersey.study\(\) runs this one"):
        model.runs()


def test_equal_models_are_equal_and_others_not(alone, machine, bearing_file):
    assert alone == hersey.Model.load(bearing_file) == alone.copy() == copy.copy(alone) == copy.deepcopy(alone)
    changed = alone.copy().set(load="1 kN")
    assert changed != alone and changed == hersey.Model.load(bearing_file, load="1 kN")
    assert hersey.Model.from_dict(machine) == hersey.Model.from_dict(machine) != alone
    assert alone != "a text"


def test_models_pickle(alone, machine):
    alone["load"] = "1 kN"
    for model in (alone, hersey.Model.from_dict(machine)):
        again = pickle.loads(pickle.dumps(model))
        assert again == model and again.changes == model.changes and again.text == model.text
    assert dict(again.copy().set(load="1 kN").to_dict()) != model.to_dict()
    with_function = hersey.Model.from_dict(machine)
    with_function["forces.push.components.1"] = hersey.Function(math.sin, unit="N")
    assert pickle.loads(pickle.dumps(with_function)) == with_function


def wrong_messages(alone, machine):
    """What is said of wrong things in many places."""
    def message_of(action):
        with pytest.raises(hersey.InputError) as caught:
            action()
        assert all("--" not in part and "hersey run" not in part for fault in caught.value.faults for part in map(str, fault))
        return str(caught.value)

    def dictionary(**bearing):
        content = copy.deepcopy(machine)
        content["bearings"]["main"].update(bearing)
        return hersey.Model.from_dict(content)

    yield message_of(lambda: dictionary(widht="20 mm"))
    yield message_of(lambda: dictionary(width="20 kPa", diameter="${size}"))
    yield message_of(lambda: hersey.Model.from_dict(machine).set({"bearings.main.width": "3 kPa"}))
    yield message_of(lambda: hersey.Model.from_dict(machine).set(load="3 parrots"))
    yield message_of(lambda: hersey.Model.from_dict(machine).set(lod="3 N"))
    yield message_of(lambda: hersey.Model.from_dict(machine)["lod"])
    yield message_of(lambda: hersey.Model.from_dict(machine).bearing())
    yield message_of(lambda: hersey.Model.from_dict(machine).run("out", overwrite=True) if machine["joints"].clear() else dictionary())
    yield message_of(lambda: alone.set(load="3 parrots"))
    yield message_of(lambda: alone.copy().bearing(width="20 kPa"))
    yield message_of(lambda: hersey.Model.load(alone.file, load="3 parrots"))
    yield message_of(lambda: hersey.Model.load(alone.file, lod="3 N"))


def test_messages_are_in_python_s_words(alone, machine):
    messages = list(wrong_messages(alone, machine))
    for message in messages:
        assert "--" not in message and "dictionary" not in message and "hersey " not in message, message
    assert messages[0].startswith("bearings.main: unknown key 'widht'; did you mean 'width'?")
    assert "unknown parameter 'size'" in messages[1] and "bearings.main.width: a pressure (kPa)" in messages[1]
    assert messages[2].startswith("bearings.main.width: a pressure (kPa)")
    assert "(from parameter load that was assigned)" in messages[3]
    assert "did you mean 'load'" in messages[4] and "did you mean 'load'" in messages[5]
    assert "speed with load or eccentricity_ratio" in messages[6]
    assert messages[9].startswith(f"{alone.file}:")  # of a file its line
