#!/usr/bin/python3
"""A run is the same however it is driven: by threads, as an FMU, in parts, as a point of a study, in the mirror.

ways_test.py HERSEY WORK [Class.test]

Each machine has features that meet in few other tests: wear with running-in by place, tilting pads that wear, a circuit that lacks warm oil
behind a restrictor, a skirt on layers of oil with rings. `hersey` and FMUs are of one build.
"""

import ctypes as c
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../fmu"))

import importer  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))
WORK = os.path.abspath(sys.argv.pop(1))
CAN_STUDY = importlib.util.find_spec("scipy") is not None and importlib.util.find_spec("openturns") is not None
SOLVED = 1e-5  # of each series' largest value: steps are solved to 1e-8 of their largest term, forces of stiff films amplify it


def run(*words):
    done = subprocess.run([HERSEY, *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def series(path):
    """Series of numbers of a results file by name."""
    found = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not name.startswith("solver/") and "fields/" not in name:
            found[name] = item[:]

    with h5py.File(path) as file:
        file.visititems(take)
    return found


class Machine:
    """What holds for each machine."""

    name = ""
    end = 20          # steps of a run
    step = 5e-4       # [s]
    must_grow = ()    # series that are above 0 at some time, so that something is compared
    study = None      # of one parameter with its values, and outputs

    @classmethod
    def setUpClass(cls):
        os.makedirs(WORK, exist_ok=True)
        cls.folder = tempfile.mkdtemp(prefix=cls.name, dir=WORK)
        cls.model = os.path.join(HERE, cls.name + ".yaml")
        cls.whole = cls.ran("whole")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def ran(cls, label, *words, sets=()):
        out = os.path.join(cls.folder, label)
        run("run", cls.model, "--output", out, "--force", *words, *[word for change in sets for word in ("--set", change)])
        return os.path.join(out, "results.h5")

    def assert_same_bits(self, one, other):
        self.assertEqual(one.keys(), other.keys())
        self.assertEqual([name for name, row in one.items() if not np.array_equal(row, other[name], equal_nan=True)], [])

    def test_something_happens(self):
        found = series(self.whole)
        for name in self.must_grow:
            self.assertGreater(found[name].max(), 0, name)

    def test_threads_change_no_bit(self):
        self.assert_same_bits(series(self.whole), series(self.ran("threads", "--threads", "3")))

    def exported(self):
        path = os.path.join(self.folder, "machine.fmu")
        if not os.path.exists(path):
            run("export", self.model, "--fmu", path)
        return importer.Fmu(path, tempfile.mkdtemp(dir=self.folder))

    def outputs_of(self, fmu, instance):
        outputs = [name for name, variable in fmu.variables.items() if variable.get("causality") == "output"]
        status, values = instance.access("Get", outputs, [0] * len(outputs))
        self.assertEqual(status, importer.OK, instance.log)
        return dict(zip(outputs, values))

    def test_fmu_has_what_the_run_has_and_goes_on_from_a_kept_state(self):
        fmu = self.exported()
        one = importer.Instance(fmu).initialise(stop=self.end * self.step)
        half = self.end // 2
        for k in range(half):
            self.assertEqual(one.step(k * self.step, self.step), importer.OK, one.log)
        state, size, again = one.state(), c.c_size_t(), c.c_void_p()
        capital = "FMUstate" if fmu.version == 2 else "FMUState"
        one.must(f"Serialized{capital}Size", state, c.byref(size))
        room = (c.c_char * size.value)()
        one.must("Serialize" + capital, state, room, size)
        other = importer.Instance(fmu, "other").initialise(stop=self.end * self.step)
        other.must(("DeSerialize" if fmu.version == 2 else "Deserialize") + capital, room, size, c.byref(again))
        other.must("Set" + capital, again)
        for instance in (one, other):
            for k in range(half, self.end):
                self.assertEqual(instance.step(k * self.step, self.step), importer.OK, instance.log)
            found = self.outputs_of(fmu, instance)
            self.assertGreater(len(found), 50)
            with h5py.File(self.whole) as file:
                rows = {name: importer.column_of(file, name)[-1] for name in found}
            apart = {name: (value, rows[name]) for name, value in found.items()
                     if not np.array_equal(rows[name].dtype.type(value), rows[name], equal_nan=True)}
            self.assertEqual(apart, {}, "FMU, results file")
            instance.free()

    @unittest.skipIf(not CAN_STUDY, "Python lacks what studies use")
    def test_points_of_a_study_are_runs(self):
        parameter, values, outputs = self.study
        model, out = os.path.join(self.folder, "study.yaml"), os.path.join(self.folder, "study")
        with open(self.model, encoding="utf-8") as file:
            text = file.read()
        with open(model, "w", encoding="utf-8") as file:
            file.write(text + f"study:\n  parameters: {{{parameter}: [{', '.join(values)}]}}\n  outputs: [{', '.join(outputs)}]\n  keep: results\n")
        run("study", model, "--out", out)
        runs = os.path.join(out, "runs")
        kept = [series(os.path.join(runs, name)) for name in os.listdir(runs) if name.endswith(".h5")]
        self.assertEqual(len(kept), len(values))
        end = outputs[0].replace(".", "/").rpartition("/")[0]
        for value in values:
            alone = series(self.ran("alone", sets=[f"{parameter}={value}"]))
            alike = [one for one in kept if np.array_equal(one[end], alone[end])]
            self.assertEqual(len(alike), 1, value)
            self.assert_same_bits(alone, alike[0])


class Mirrored:
    """What holds for machines that are their own mirror image in x = 0."""

    mirror = ("sense=-1",)  # the settings that make it
    images = {}             # names that change places

    def test_mirrored_machine_has_the_same_numbers(self):
        one, other = series(self.whole), series(self.ran("mirrored", sets=self.mirror))
        for name, row in one.items():
            figure = name.rpartition("/")[2]
            if not name.startswith(("bearings/", "groups/", "circuit/", "thermal/")) or not figure.startswith(
                    ("h_min", "p_max", "power_", "wear", "worn", "roughness", "flow_", "fill", "drawn", "temperature", "oil_volume")):
                continue
            if figure.endswith(("_phi", "_z", "_around", "_error")):
                continue
            image = "/".join(self.images.get(part, part) for part in name.split("/"))
            scale = np.nanmax(np.abs(row), initial=0)
            # Flows may be counted along x: their size is what is the same.
            self.assertLessEqual(np.nanmax(np.abs(np.abs(row) - np.abs(other[image])), initial=0), SOLVED * scale, name)


class Bush(Machine, Mirrored, unittest.TestCase):
    name = "bush"
    must_grow = ("bearings/bush/worn_volume_fixed", "bearings/bush/worn_volume_moving", "bearings/bush/wear_error")
    study = ("doublings", ["-1", "1"], ["bearings.bush.worn_volume_fixed.end"])


    @unittest.skipIf(not CAN_STUDY, "Python lacks what studies use")
    def test_drawn_coefficients_give_bands_of_the_closed_form(self):
        """Where wear is too little to change the film, the worn volume is in proportion to the coefficient."""
        model, out = os.path.join(self.folder, "drawn.yaml"), os.path.join(self.folder, "drawn")
        slow = "bearings.bush.wear.acceleration=1e-3"
        with open(self.model, encoding="utf-8") as file:
            text = file.read().replace("acceleration: 5000", "acceleration: 1e-3")
        with open(model, "w", encoding="utf-8") as file:
            file.write(text + "study: {plan: sobol, samples: 8, keep: results, outputs: [bearings.bush.worn_volume_fixed.end], "
                       "parameters: {doublings: {distribution: normal, mean: 0, standard_deviation: 1}}}\n")
        run("study", model, "--out", out)
        with open(os.path.join(out, "results.json"), encoding="utf-8") as file:
            data = json.load(file)
        (band,) = data["bands"]
        factors = np.sort([2 ** record["inputs"][0] for record in data["runs"]])
        self.assertGreater(factors[-1] / factors[0], 4)
        alone = series(self.ran("slow", sets=[slow]))
        volume = np.interp(band["time"], alone["bearings/bush/time"], alone["bearings/bush/worn_volume_fixed"]) * 1e9  # [mm^3]
        linear = 1e-5  # of the volume: depths of a thousandth of a nanometre change a film of half a micrometre by as little
        for percentile, course in band["percentiles"].items():
            exact = volume * np.percentile(factors, float(percentile))
            self.assertLess(np.abs(np.array(course) - exact).max(), linear * volume[-1], percentile)


class Pads(Machine, Mirrored, unittest.TestCase):
    name = "pads"
    end = 50
    step = 1e-4
    must_grow = ("groups/front/worn_volume_fixed", "groups/front/worn_volume_moving", "bearings/front_pad_3/wear_moving")
    images = {"front_pad_2": "front_pad_4", "front_pad_4": "front_pad_2", "flow_leading": "flow_trailing", "flow_trailing": "flow_leading"}
    study = ("doublings", ["-1", "1"], ["groups.front.worn_volume_fixed.end"])


class DryElasticPads(Pads):
    name = "dry_elastic_pads"
    end = 20
    step = 5e-5


class Starved(Machine, Mirrored, unittest.TestCase):
    name = "starved"
    step = 2e-4
    must_grow = ("circuit/starved_main_1",)
    study = ("swing", ["0", "6000"], ["bearings.main_1.h_min.min"])


class Dry(Machine, Mirrored, unittest.TestCase):
    name = "dry"
    end = 40
    must_grow = ("bearings/bush/worn_volume_fixed", "bearings/bush/worn_volume_moving", "bearings/bush/heat_to_journal")
    study = ("fill", ["0", "0.7"], ["bearings.bush.worn_volume_fixed.end"])

    def test_oil_and_heat_are_balanced(self):
        found = series(self.whole)
        of_oil = 1e-9  # of what has flowed, as in full films
        self.assertLess(abs(found["bearings/bush/oil_unexplained"][-1]), of_oil * found["bearings/bush/oil_through_flow"][-1])
        self.assertLess(found["bearings/bush/heat_balance_error"].max(), 1e-6)  # the temperatures' tolerance


class Piston(Machine, unittest.TestCase):
    name = "piston"
    end = 50
    step = 1 / 18000  # a degree at 3000 rpm
    must_grow = ("bearings/skirt/worn_volume_fixed", "bearings/skirt/starved_share")
    study = ("oil", ["10 um", "60 um"], ["bearings.skirt.starved_share.max", "forces.oil_ring.friction_power.mean"])

    def test_multigrid_finds_the_same(self):
        one, other = series(self.whole), series(self.ran("multigrid", sets=["solver=multigrid"]))
        for name in ("h_min_thrust", "h_min_antithrust", "side_force", "skirt_friction", "starved_share", "flow_scraped", "worn_volume_fixed"):
            row, again = one["bearings/skirt/" + name], other["bearings/skirt/" + name]
            self.assertLessEqual(np.abs(row - again).max(), SOLVED * np.abs(row).max(), name)


if __name__ == "__main__":
    unittest.main()
