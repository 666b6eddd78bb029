"""Bearings in OpenMDAO and Dakota. Neither is packaged for Debian: a stand-in takes OpenMDAO's place, with those of its calls
that a component makes, and Dakota's files are written here as its manual prints them."""

import subprocess
import sys
import types

import numpy as np
import pytest

import hersey
import hersey.dakota
import hersey.openmdao

INPUTS, OUTPUTS = ["load", "clearance", "bearings.main.width"], ["h_min", "friction_journal", "torque_journal"]
BY_DIFFERENCE = 2e-4  # of central differences with a step of a thousandth, of a figure that is smooth


class Options(dict):
    def declare(self, name, default=None, types=None, allow_none=False):
        self.setdefault(name, default)


class ExplicitComponent:
    """What OpenMDAO gives a component: options by keyword, variables that it declares, arrays of one number."""

    def __init__(self, **options):
        self.options, self.inputs, self.outputs, self.units, self.declared = Options(), {}, {}, {}, []
        self.initialize()
        unknown = set(options) - set(self.options)
        assert not unknown, unknown
        self.options.update(options)

    def __setattr__(self, name, value):
        assert name not in ("_inputs", "_outputs", "_residuals", "_jacobian", "_var_rel2meta"), f"{name} is OpenMDAO's own"
        super().__setattr__(name, value)

    def add_input(self, name, val, units=None):
        assert "." not in name
        self.inputs[name], self.units[name] = np.array([float(val)]), units

    def add_output(self, name, val, units=None):
        assert "." not in name
        self.outputs[name], self.units[name] = np.array([float(val)]), units

    def declare_partials(self, of, wrt):
        self.declared.append((of, wrt))


class AnalysisError(Exception):
    pass


@pytest.fixture
def openmdao(monkeypatch):
    """OpenMDAO's place taken."""
    package, api = types.ModuleType("openmdao"), types.ModuleType("openmdao.api")
    api.ExplicitComponent, api.AnalysisError, package.api = ExplicitComponent, AnalysisError, api
    monkeypatch.setitem(sys.modules, "openmdao", package)
    monkeypatch.setitem(sys.modules, "openmdao.api", api)
    hersey.openmdao._component_class.cache_clear()
    yield api
    hersey.openmdao._component_class.cache_clear()


@pytest.fixture
def film(openmdao, bearing_file):
    component = hersey.openmdao.BearingComponent(model=str(bearing_file), inputs=INPUTS, outputs=OUTPUTS)
    component.setup()
    return component


def outputs_at(component, **values):
    inputs = {name: value.copy() for name, value in component.inputs.items()}
    for name, value in values.items():
        inputs[name][:] = value
    outputs = {}
    component.compute(inputs, outputs)
    return outputs


def test_component_begins_at_the_model_and_has_its_units(film, bearing_file):
    expected = hersey.Model.load(str(bearing_file)).bearing(grid_error=False)
    assert list(film.inputs) == ["load", "clearance", "bearings:main:width"]
    assert [film.units[name] for name in film.inputs] == ["N", "m", "m"]
    assert film.units["h_min"] == "m" and film.units["friction_journal"] is None and film.units["torque_journal"] == "N*m"
    assert film.declared == [("*", "*")]
    found = outputs_at(film)
    for name in OUTPUTS:
        assert film.outputs[name][0] == found[name] == pytest.approx(float(expected[name]), rel=1e-9)  # the same solution


def test_partials_are_slopes_of_what_it_computes(film):
    partials = {}
    film.compute_partials(film.inputs, partials)
    assert set(partials) == {(figure, name) for figure in OUTPUTS for name in film.inputs}
    for name, value in film.inputs.items():
        step = 1e-3 * value[0]
        above, below = (outputs_at(film, **{name: value[0] + sign * step}) for sign in (1, -1))
        for figure in OUTPUTS:
            assert partials[figure, name] == pytest.approx((above[figure] - below[figure]) / (2 * step), rel=BY_DIFFERENCE), (figure, name)


def test_film_that_is_not_found_is_an_analysis_error(film, openmdao):
    with pytest.raises(openmdao.AnalysisError):
        outputs_at(film, load=1e8)


def test_wrong_names_are_told(openmdao, bearing_file):
    def component(**options):
        made = hersey.openmdao.BearingComponent(**{"model": str(bearing_file), "inputs": ["load"], "outputs": ["h_min"], **options})
        made.setup()

    with pytest.raises(hersey.InputError, match="h_min"):
        component(outputs=["hmin"])
    with pytest.raises(hersey.InputError, match="load"):
        component(inputs=["laod"])


def test_without_openmdao_the_module_says_what_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "openmdao", None)
    hersey.openmdao._component_class.cache_clear()
    with pytest.raises(ImportError, match="pip install openmdao"):
        hersey.openmdao.BearingComponent


def parameters(load, clearance, active, by=(1, 2)):
    """A parameters file of the standard format, with all blocks of Dakota 6."""
    functions = "".join(f"{bits:>22} ASV_{k}:{name}\n" for k, (name, bits) in enumerate(active.items(), 1))
    derivatives = "".join(f"{number:>22} DVV_{k}:{('load', 'clearance')[number - 1]}\n" for k, number in enumerate(by, 1))
    return (f"{2:>22} variables\n{load:>22.15e} load\n{clearance:>22.15e} clearance\n"
            f"{len(active):>22} functions\n{functions}{len(by):>22} derivative_variables\n{derivatives}"
            f"{0:>22} analysis_components\n{1:>22} eval_id\n{0:>22} metadata\n")


def drive(bearing_file, folder, text):
    (folder / "params.in").write_text(text)
    return subprocess.run([sys.executable, "-m", "hersey.dakota", str(bearing_file), "params.in", "results.out"], cwd=folder,
                          capture_output=True, text=True, check=False)


def test_dakota_gets_values_and_gradients_in_its_order(bearing_file, tmp_path):
    done = drive(bearing_file, tmp_path, parameters(600, 40e-6, {"friction_journal": 3, "h_min": 2, "power_film": 1}, by=(2, 1)))
    assert done.returncode == 0, done.stderr
    film = hersey.Model.load(str(bearing_file)).bearing(load=600, clearance=40e-6, grid_error=False, sensitivity_to=["clearance", "load"])
    lines = (tmp_path / "results.out").read_text().splitlines()
    assert [line.split()[1] for line in lines[:2]] == ["friction_journal", "power_film"]
    assert [float(line.split()[0]) for line in lines[:2]] == pytest.approx([float(film[name]) for name in ("friction_journal", "power_film")])
    for line, name in zip(lines[2:], ("friction_journal", "h_min")):
        assert line.startswith("[") and line.endswith("]")
        assert [float(part) for part in line.strip("[ ]").split()] == pytest.approx(list(film.gradient(name).values()))
    assert len(lines) == 4


def test_dakota_is_told_of_failures_and_faults(bearing_file, tmp_path):
    assert drive(bearing_file, tmp_path, parameters(1e8, 40e-6, {"h_min": 1})).returncode == 0
    assert (tmp_path / "results.out").read_text().lower().startswith("fail")
    for text, said in ((parameters(600, 40e-6, {"h_min": 4}), "quasi_hessians"), (parameters(600, 40e-6, {"hmin": 1}), "h_min"),
                       ("{ DAKOTA_VARS = 2 }\n", "standard"), ("3 variables\n1 load\n", "variables")):
        (tmp_path / "results.out").unlink(missing_ok=True)
        done = drive(bearing_file, tmp_path, text)
        assert done.returncode == 2 and said in done.stderr, done.stderr
        assert not (tmp_path / "results.out").exists()
