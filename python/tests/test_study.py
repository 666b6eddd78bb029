"""Studies from Python: those of the program."""

import importlib.util
import json
import sys

import pytest

import hersey

pytestmark = pytest.mark.skipif(importlib.util.find_spec("scipy") is None, reason="scripts/setup study")

MODEL = """hersey: 1
parameters: {clearance: 34 um, load: 2500 N}
lubricants: {oil: {viscosity: 15 mPa.s}}
bearings:
  main:
    {diameter: 45 mm, width: 15.6 mm, radial_clearance: "${clearance}", lubricant: oil, grid: {circumferential: 24, axial: 5},
     supply: {line: widest_gap, pressure: 0 bar}, operating_point: {journal_speed: 3570 rpm, load: "${load}"}}
study:
  parameters: {clearance: [30 um, 0.038 mm]}
  outputs: [bearings.main.h_min]
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "clearances.yaml"
    path.write_text(MODEL, encoding="utf-8")
    return path


def test_runs_are_those_of_a_single_bearing(file, tmp_path):
    found = hersey.study(file, tmp_path / "out", load=2000.0, jobs=1)  # SI
    assert list(found.table.columns) == ["clearance [um]", "bearings.main.h_min [um]"]
    assert list(found.table["clearance [um]"]) == pytest.approx([30, 38])  # round-off of a unit
    for clearance, h_min in found.table.itertuples(index=False):
        alone = hersey.Model.load(file, load="2 kN").bearing(clearance=f"{clearance} um")
        # The same solver from the same start; ten digits are written.
        assert 1e-6 * h_min == pytest.approx(float(alone["h_min"]), rel=1e-9)
    assert found.report.exists() and found.failed == {} and found.data["completed"] == 2
    assert found.figures.loc["bearings.main.h_min", "largest"] == pytest.approx(found.table["bearings.main.h_min [um]"].max())


def test_a_model_in_hand_is_studied_with_its_changes(file, tmp_path):
    model = hersey.Model.load(file)
    model["study.parameters.clearance"] = ["33 um"]
    assert list(hersey.study(model, tmp_path / "out").table["clearance [um]"]) == [33]
    with pytest.raises(hersey.InputError, match="no file"):
        hersey.study(hersey.Model.from_text(MODEL, tmp_path / "nowhere.yaml"))


def test_failed_runs_stop_nothing_and_are_reported(file, tmp_path):
    script = tmp_path / "answers.py"
    script.write_text("import json, sys\nfor line in sys.stdin:\n    run = json.loads(line)\n"
                      "    good = '30' in run['set'][0]\n"
                      "    print(json.dumps({'run': run['run'], 'status': 'completed', 'figures': {'bearings.main.h_min': 1e-6}} if good\n"
                      "          else {'run': run['run'], 'status': 'failed', 'error': 'too wide'}), flush=True)\n", encoding="utf-8")
    found = hersey.study(file, tmp_path / "out", runner=f"{sys.executable} {script}")
    assert found.failed == {"too wide": 1} and len(found.table) == 1


def test_wrong_studies_are_reported_with_the_nearest_name(file, tmp_path):
    file.write_text(MODEL.replace("main.h_min", "main.h_mni"), encoding="utf-8")
    with pytest.raises(hersey.InputError, match="did you mean 'bearings.main.h_min'"):
        hersey.study(file, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_program_that_is_not_there_is_reported(monkeypatch, file, tmp_path):
    from hersey import studies

    monkeypatch.delenv("HERSEY_PROGRAM")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(studies, "__file__", str(tmp_path / "a" / "b" / "studies.py"))
    with pytest.raises(FileNotFoundError, match="HERSEY_PROGRAM"):
        hersey.study(file, tmp_path / "out")


def test_results_are_there_after_the_study(file, tmp_path):
    hersey.study(file, tmp_path / "out")
    again = hersey.Study(tmp_path / "out")
    assert again.data == json.loads((tmp_path / "out" / "results.json").read_text(encoding="utf-8"))
    assert "2 of 2 runs" in repr(again)
