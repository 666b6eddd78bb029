"""Results as xarray and pandas, lazily, with everything named."""

import copy
import json
import pickle
import shutil
import subprocess

import h5py
import numpy as np
import pytest
import xarray

import hersey


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    from conftest import MACHINE

    return hersey.Model.from_dict(MACHINE).run(tmp_path_factory.mktemp("results"))


def test_series_have_time_units_and_names(results):
    film = results.bearing()
    assert film["h_min"].dims == ("time",) and film["h_min"].attrs["units"] == "m"
    assert film["h_min"].attrs["long_name"] and film["time"].attrs["units"] == "s"
    assert float(film["h_min"].sel(time=5e-3, method="nearest")) > 0


def test_fields_are_read_where_they_are_used(results):
    film = results.film()
    assert film["pressure"].dims == ("time", "phi", "z")
    assert {"phi", "z", "time"} <= set(film.coords)
    assert len(film["time"]) == 6  # every 2 ms of 10 ms


def test_long_fields_are_read_where_they_are_used(results, monkeypatch):
    everything = results.film().load()
    monkeypatch.setattr("hersey.reading._AT_ONCE", 0)
    film = results.film()
    assert not film["pressure"].variable._in_memory
    late = film["pressure"].isel(time=-1, phi=slice(3, 20), z=[1, 5])
    assert not late.variable._in_memory
    assert np.array_equal(late.values, everything["pressure"].values[-1, 3:20][:, [1, 5]])


@pytest.fixture(scope="module")
def with_crank(tmp_path_factory):
    from conftest import MACHINE

    machine = copy.deepcopy(MACHINE)  # and beside it a wheel that turns
    machine["bodies"]["wheel"] = machine["bodies"]["shaft"]
    machine["joints"]["crank"] = {"type": "revolute", "between": ["ground", "wheel"], "axis": "z"}
    machine["drives"]["crank"] = {"joint": "crank", "coordinate": "rotation", "speed": "3000 rpm"}
    machine["simulation"]["crank"] = "crank"
    return hersey.Model.from_dict(machine).run(tmp_path_factory.mktemp("with_crank"))


def killed(results, path, lengths):
    """The results as a kill in the middle of a flush leaves them: some series longer or shorter by so many rows."""
    shutil.copy(results.path, path)
    with h5py.File(path, "r+") as file:
        file.attrs.modify("status", "running")
        for name, more in lengths.items():
            file[name].resize(len(file[name]) + more, axis=0)
    return hersey.open_results(path)


@pytest.mark.parametrize("rows_read_late", [False, True])
def test_rows_that_a_kill_left_in_some_series_do_not_count(with_crank, tmp_path, monkeypatch, rows_read_late):
    found = killed(with_crank, tmp_path / "killed.h5",
                   {"time": 2, "bearings/main/h_min": 2, "bearings/main/fields/pressure": 1, "crank_angle": -1})
    if rows_read_late:
        monkeypatch.setattr("hersey.reading._AT_ONCE", 0)
    # A bearing has no angle of the crank in a row that the crank has none of.
    xarray.testing.assert_identical(found.bearing().load(), with_crank.bearing().load().isel(time=slice(-1)))
    xarray.testing.assert_identical(found.film().load()["pressure"].drop_vars("crank_angle"),
                                    with_crank.film().load()["pressure"].drop_vars("crank_angle"))


def test_results_of_a_run_killed_in_its_first_flush_are_empty(with_crank, tmp_path):
    rows = len(with_crank["bearings/main"]["time"])
    found = killed(with_crank, tmp_path / "killed.h5", {"crank_angle": -rows})
    assert len(found.bearing()["time"]) == 0
    assert np.isnan(found.film()["crank_angle"]).all()


def test_groups_are_those_that_xarray_opens_itself(results):
    for group in ["", *results.groups]:
        with xarray.open_dataset(results.path, group=group or "/", engine="h5netcdf") as expected:
            found = results[group]
            assert set(found.variables) == set(expected.variables), group
            for name, variable in expected.variables.items():
                assert found[name].dims == variable.dims, f"{group}/{name}"
                assert found[name].variable.equals(variable), f"{group}/{name}"
                assert found[name].attrs.get("units") == variable.attrs.get("units")


def test_every_group_opens_by_itself_with_names_and_units(results):
    assert "bearings/main" in results.groups
    for group in ["", *results.groups]:
        with xarray.open_dataset(results.path, group=group or "/", engine="h5netcdf") as data:
            assert not [name for name in data.dims if str(name).startswith("phony")], group
            for name, variable in data.variables.items():
                if variable.dtype.kind == "f":
                    assert "units" in variable.attrs and "long_name" in variable.attrs, f"{group}/{name}"


def test_table_is_the_closing_one(results):
    table = results.table()
    moft = table.loc[("main", "minimum film thickness (MOFT)")]
    assert moft["value"] == pytest.approx(float(results.bearing()["h_min"].min()), rel=1e-12)


def test_report_is_one_page(results, tmp_path):
    page = results.report(tmp_path / "x.html", title="Mine")
    assert '"Mine"' in page.read_text(encoding="utf-8")
    with pytest.raises(OSError):
        results.report(tmp_path / "nowhere" / "x.html")


def test_missing_things_are_reported(results, tmp_path):
    with pytest.raises(KeyError, match="expected one of main"):
        results.bearing("big_end")
    with pytest.raises(KeyError, match="no group 'bearing/main'"):
        results["bearing/main"]
    with pytest.raises(FileNotFoundError):
        hersey.open_results(tmp_path / "results.h5")


def test_runs_are_laid_over_each_other_by_their_names(machine, tmp_path):
    model = hersey.Model.from_dict(machine)
    runs = [model.run(tmp_path / "light"), model.set(load="600 N").run(tmp_path / "heavy")]
    page = hersey.report(runs, tmp_path / "both.html", names=["as it is", "heavier"])
    assert '"heavier"' in page.read_text(encoding="utf-8")
    assert len(runs[0].table()) > 5


def test_files_that_are_no_results_are_reported_with_path_and_reason(results, tmp_path):
    text, short, foreign = tmp_path / "text.h5", tmp_path / "short.h5", tmp_path / "foreign.h5"
    text.write_text("no HDF5", encoding="utf-8")
    short.write_bytes(results.path.read_bytes()[:5000])
    with h5py.File(foreign, "w") as file:
        file["x"] = 1
    for path, reason in ((text, "no HDF5 file"), (short, "cut off"), (foreign, "no results file of hersey")):
        for use in (lambda r: r.status, lambda r: r.groups, lambda r: r["bearings/main"]):
            with pytest.raises(OSError) as caught:
                use(hersey.open_results(path))
            assert str(caught.value).startswith(f"{path}: ") and reason in str(caught.value)
        with pytest.raises(OSError) as caught:
            hersey.open_results(path).table()  # which the solver reads
        assert str(caught.value).startswith(f"{path}: ")
    found = hersey.open_results(short)
    short.unlink()
    with pytest.raises(FileNotFoundError, match="short.h5: no such results file"):
        found.status


def test_nearest_names_of_groups(results):
    with pytest.raises(KeyError, match="did you mean 'bearings/main'"):
        results["bearing/main"]
    with pytest.raises(KeyError, match="did you mean 'main'"):
        results.bearing("mian")


def test_results_pickle(results):
    again = pickle.loads(pickle.dumps(results))
    assert again.path == results.path and dict(again.summary) == dict(results.summary)


def test_every_number_of_a_run_from_python_is_the_program_s(machine, program, tmp_path):
    file = tmp_path / "model.yaml"
    file.write_text(json.dumps({"hersey": 1, **machine}), encoding="utf-8")  # JSON is YAML
    results = hersey.Model.load(file).run(tmp_path / "by_python")
    run = subprocess.run([program, "run", file, "--output", tmp_path / "by_program", "--json"], capture_output=True, text=True, check=True)
    reported = json.loads(run.stdout)
    compared = set()
    with h5py.File(tmp_path / "by_program" / "results.h5") as written:
        for group in ["/", *results.groups]:
            data = results[group].load()
            for name, variable in {**data.data_vars, **data.coords}.items():
                stored = written[group].get(name)
                if isinstance(stored, h5py.Dataset) and stored.dtype.kind in "fi":
                    compared.add(stored.name)
                    assert np.array_equal(variable.values, stored[()], equal_nan=True), stored.name
        every = set()

        def visit(path, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
                every.add("/" + path)

        written.visititems(visit)
        assert len(every) > 100 and every <= compared, sorted(every - compared)
    for key, value in reported["runs"][0].items():
        if key in results.summary and key not in ("wall_time", "work", "results"):  # times and places
            assert value == results.summary[key], key
    table = results.table()
    shown = [(*row.Index, row.value) for row in table.itertuples()]
    for figure in reported["summary"]:
        if figure["group"] != "computing" and isinstance(figure["value"], float):  # computing: times of this machine
            assert (figure["group"], figure["name"], figure["value"]) in shown
