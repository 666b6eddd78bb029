"""Elastic bodies from Python: the program's numbers, and equilibrium."""

import json
import subprocess

import numpy as np
import pytest

import hersey
from hersey import fem

STEEL = {"youngs_modulus": "210 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m^3"}
OPTIONS = ["--length-unit", "mm", "--youngs-modulus", "210GPa", "--poisson-ratio", "0.3", "--density", "7850kg/m^3"]


@pytest.fixture(scope="module")
def mesh():
    from conftest import EXAMPLES

    return EXAMPLES / "meshes" / "conrod.msh"


@pytest.fixture(scope="module")
def rod(mesh):
    return fem.Body(mesh, "mm", **STEEL)


def test_modes_are_the_program_s(rod, mesh, program):
    reported = subprocess.run([program, "modes", mesh, *OPTIONS, "--hold", "big_end", "--count", "4", "--json"],
                          capture_output=True, text=True, check=True)
    found = rod.modes(hold=["big_end"], count=4)
    assert found["frequency"].values.tolist() == json.loads(reported.stdout)["frequencies"]
    assert found["shape"].dims == ("mode", "node", "axis")


def test_supports_carry_the_load(rod, mesh, program):
    found = rod.static(["big_end"], force={"small_end": "0 -500 0 N"}, gravity="0 0 -9.81 m/s^2")
    # Round-off of sums over ten thousands of nodes, of forces of hundreds of newtons.
    assert found["reaction"].sum("node").values == pytest.approx([0, 500, 9.81 * rod.mass], abs=1e-6)
    assert found["von_mises"].attrs["units"] == "Pa" and float(found["energy"]) > 0


def test_reduced_body_keeps_rigid_motion_and_file(rod, tmp_path):
    body = rod.reduce({"big": "big_end", "small": ("small_end", "average")}, modes=4)
    assert body.stiffness.shape == (16, 16) and len(body.frequencies) == 4
    shift = np.zeros(16)
    shift[[3, 9]] = 1  # both frames along x
    # It strains nothing, but for what the factorisation leaves of a stiffness of so much.
    assert np.abs(body.stiffness @ shift).max() < 1e-8 * np.abs(body.stiffness).max()
    assert shift @ body.mass @ shift == pytest.approx(rod.mass, rel=1e-9)
    body.save(tmp_path / "rod.h5")
    assert (tmp_path / "rod.h5").stat().st_size > 0


def test_faults_are_reported(rod, mesh):
    with pytest.raises(hersey.InputError, match="no set 'big_emd'.*did you mean 'big_end'"):
        rod.modes(hold=["big_emd"])
    with pytest.raises(hersey.InputError, match="leave no motion free"):
        rod.static([], force={"small_end": "0 -500 0 N"})
    with pytest.raises(hersey.InputError, match="pressure"):
        rod.static(["big_end"], pressure={"small_end": "20 mm"})
    with pytest.raises(hersey.InputError, match="the mesh file does not say it"):
        fem.Body(mesh, "mm", youngs_modulus="210 GPa")
