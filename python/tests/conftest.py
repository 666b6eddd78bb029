import copy
import os
import signal
from pathlib import Path

import pytest

import hersey

# Shells start what runs in the background with Ctrl-C ignored, and processes of its own would be, too.
signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"

# A journal that falls into its film: a machine that runs in a moment.
MACHINE = {
    "title": "A shaft in a film",
    "parameters": {"load": "500 N"},
    "lubricants": {"oil": {"viscosity": "15 mPa.s"}},
    "bodies": {"shaft": {"mass": "2 kg", "inertia": {key: "1e-3 kg.m^2" for key in ("xx", "yy", "zz")}}},
    "joints": {"free": {"type": "planar", "between": ["ground", "shaft"], "axis": "z"}},
    "drives": {"turning": {"joint": "free", "coordinate": "rotation", "speed": "3000 rpm"}},
    "forces": {"push": {"type": "force", "body": "shaft", "axes": "ground", "components": ["0 N", "-${load}", "0 N"]}},
    "bearings": {"main": {"shell": "ground", "journal": "shaft", "diameter": "45 mm", "width": "15.6 mm",
                          "radial_clearance": "34 um", "lubricant": "oil",
                          "grid": {"circumferential": 40, "axial": 7}}},
    "simulation": {"duration": "10 ms", "step": "0.2 ms"},
    "output": {"fields_every": "2 ms"},
}


@pytest.fixture
def machine():
    """The machine as a dictionary to be changed."""
    return copy.deepcopy(MACHINE)


@pytest.fixture
def bearing_file():
    return EXAMPLES / "bearing_alone" / "model.yaml"


@pytest.fixture
def program():
    """The command-line program of the same build."""
    return os.environ["HERSEY_PROGRAM"]


@pytest.fixture
def alone(bearing_file):
    return hersey.Model.load(bearing_file)
