"""late_start_test.py PROGRAM: a run that starts later begins with the machine as its drives have brought it there."""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else pathlib.Path("hersey")

# 50 revolutions a second: after whole tenths of a second the machine stands as at the start.
GEARED_SLIDER = """
hersey: 1
bodies:
  crank: {mass: 1 kg, centre_of_mass: [10 mm, 0 mm, 0 mm], inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}, frames: {pin: {origin: [30 mm, 0 mm, 0 mm]}}}
  rod: {mass: 0.5 kg, centre_of_mass: [50 mm, 0 mm, 0 mm], inertia: {xx: 1e-4 kg.m^2, yy: 5e-4 kg.m^2, zz: 5e-4 kg.m^2}, frames: {small: {origin: [100 mm, 0 mm, 0 mm]}}}
  slider: {mass: 0.4 kg, inertia: {xx: 1e-4 kg.m^2, yy: 1e-4 kg.m^2, zz: 1e-4 kg.m^2}}
  wheel: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 2e-3 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, crank]}
  big: {type: revolute, between: [crank.pin, rod]}
  small: {type: revolute, between: [rod.small, slider]}
  guide: {type: prismatic, between: [ground, slider], axis: x, initial: {translation: 130 mm}}
  counter: {type: revolute, between: [ground, wheel]}
couplings:
  pair: {type: gear, input: main.rotation, output: counter.rotation, ratio: -2.5}
drives:
  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}
simulation: {duration: 10 ms, step: 0.1 ms}
"""


def run(folder, *settings):
    model, results = pathlib.Path(folder, "model.yaml"), pathlib.Path(folder, "run")
    model.write_text(GEARED_SLIDER)
    call = [PROGRAM, "run", model, "--output", results, "--force"]
    for setting in settings:
        call += ["--set", setting]
    done = subprocess.run(call, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stderr)
    with h5py.File(results / "results.h5") as file:
        return {name: file[name][()] for name in ("bodies/slider/position", "joints/main/coordinates", "joints/counter/coordinates",
                                                 "drives/motor/force_or_torque")}


class LateStart(unittest.TestCase):
    def test_after_whole_revolutions_the_run_is_that_from_the_start(self):
        with tempfile.TemporaryDirectory() as folder:
            first, late = run(folder), run(folder, "simulation.start=20 s")
        turns = 2 * math.pi * 1000
        # 2000 pi leaves 1e-12 of an angle; torques are its second differences over steps of 1e-4 s.
        np.testing.assert_allclose(late["bodies/slider/position"], first["bodies/slider/position"], atol=1e-10)
        np.testing.assert_allclose(late["joints/main/coordinates"] - turns, first["joints/main/coordinates"], atol=1e-9)
        np.testing.assert_allclose(late["joints/counter/coordinates"] + 2.5 * turns, first["joints/counter/coordinates"], atol=1e-9)
        np.testing.assert_allclose(late["drives/motor/force_or_torque"], first["drives/motor/force_or_torque"], atol=1e-3)


if __name__ == "__main__":
    unittest.main()
