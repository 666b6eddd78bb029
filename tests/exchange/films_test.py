#!/usr/bin/python3
"""Films over time for ParaView, read by the structure that VTK publishes and by VTK itself.

python films_test.py HERSEY [tests]

Steps are read by the chapter "Temporal data" of the VTKHDF file format (docs.vtk.org). The VTK of Debian 12 (9.1) knows files of version 1, one time
each: it reads every step from a copy that has this step alone. Newer ones, which read the file itself, are asked where they are installed.
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
EXACT = 1e-12  # round-off of a few products and sums
RUNS = {
    "rod": ["big_end", "--set", "simulation.duration=120deg"],
    "pads": ["tests/results_file/pads.yaml"],
    "thrust": ["tests/results_file/thrust.yaml"],
    "slider": ["examples/plane_slider/carriage.yaml", "--set", "simulation.duration=2ms"],
    "skirt": ["examples/piston/model.yaml", "--set", "simulation.duration=4deg", "--set", "output.fields_every=1deg"],
}


def hersey(*arguments, expect=0):
    done = subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True, timeout=600, stdin=subprocess.DEVNULL, check=False)
    assert done.returncode == expect, f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


class Step:
    """One time of a temporal unstructured grid of one part."""

    def __init__(self, file, k):
        grid, steps = file["VTKHDF"], file["VTKHDF/Steps"]
        part = int(steps["PartOffsets"][k])
        assert int(steps["NumberOfParts"][k]) == 1
        points, cells, ids = (int(grid[name][part]) for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
        first_point, first_cell = int(steps["PointOffsets"][k]), int(steps["CellOffsets"][k][0])
        first_id = int(steps["ConnectivityIdOffsets"][k][0])
        self.time = float(steps["Values"][k])
        self.points = grid["Points"][first_point:first_point + points]
        self.types = grid["Types"][first_cell:first_cell + cells]
        self.offsets = grid["Offsets"][first_cell:first_cell + cells + 1]
        self.connectivity = grid["Connectivity"][first_id:first_id + ids]
        self.data = {}
        for kind, size in (("PointData", points), ("CellData", cells)):
            for name, values in grid[kind].items():
                begin = int(steps[f"{kind}Offsets/{name}"][k])
                self.data[kind, name] = values[begin:begin + size]
                assert len(self.data[kind, name]) == size
        assert len(self.points) == points and len(self.offsets) == cells + 1 and self.connectivity.max() < points

    def corners(self):
        """Corners of each quadrilateral, and their numbers."""
        assert set(self.types) == {9} and (np.diff(self.offsets) == 4).all()
        numbers = self.connectivity.reshape(-1, 4)
        return self.points[numbers], numbers

    def areas(self):
        """Area as a vector of each quadrilateral: half the product of its diagonals."""
        x, _ = self.corners()
        return np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]) / 2

    def of(self, bearing):
        return self.data["CellData", "bearing"] == bearing


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def pose(results, bearing, row):
    """Axes and origin of a bearing's frame in ground."""
    axes = np.array([bearing["x_axis"][()], np.cross(bearing["axis"][()], bearing["x_axis"][()]), bearing["axis"][()]]).T
    if bearing.attrs["inboard"] == "ground":
        return axes, bearing["inboard_origin"][()]
    body = results["bodies"][bearing.attrs["inboard"]]
    R = rotation(body["orientation"][row])
    return R @ axes, body["position"][row] + R @ bearing["inboard_origin"][()]


def pressure_force(step, number, X, kind):
    """What the pressure of a film does to the surface that carries it: away from a bore's axis, towards that of a skirt, into pad and stator;
    and the same without regard to directions."""
    R, r = X
    x, numbers = step.corners()
    mine = step.of(number)
    pressure = step.data["PointData", "pressure"][numbers[mine]].mean(axis=1)
    areas, from_axis = step.areas()[mine], x[mine].mean(axis=1) - r
    from_axis = from_axis - np.outer(from_axis @ R[:, 2], R[:, 2])
    pushes = {"rod": from_axis, "skirt": -from_axis, "slider": R[:, [0]].T, "thrust": -R[:, [2]].T}[kind]
    return (pressure * np.sign(np.sum(areas * pushes, axis=1))) @ areas, pressure @ np.linalg.norm(areas, axis=1)


class Films(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory(prefix="hersey-films-"))
        cls.results = {}

    def run_of(self, name):
        if name not in self.results:
            model, *arguments = RUNS[name]
            if not model.endswith(".yaml"):
                path = os.path.join(self.folder, model)
                hersey("init", model, path)
                model = path + ".yaml"
            out = os.path.join(self.folder, name)
            hersey("run", os.path.join(ROOT, model), "--output", out, *arguments)
            self.results[name] = next(os.path.join(out, file) for file in os.listdir(out) if file.endswith(".h5"))
        return self.results[name]

    def films(self, name, *arguments):
        target = os.path.join(self.folder, "-".join([name, *(a.strip("-") for a in arguments)]) + ".vtkhdf")
        return target, json.loads(hersey("export", self.run_of(name), "--films", target, "--force", "--json", *arguments))

    def test_structure_is_the_published_one(self):
        target, printed = self.films("rod")
        with h5py.File(target) as file:
            grid = file["VTKHDF"]
            self.assertEqual(list(grid.attrs["Version"]), [2, 0])
            self.assertEqual(grid.attrs["Type"], b"UnstructuredGrid")
            self.assertEqual(grid["Types"].dtype, np.uint8)
            steps = grid["Steps"]
            count = int(steps.attrs["NSteps"])
            self.assertEqual(count, len(printed["instants"]))
            self.assertEqual(steps["CellOffsets"].shape, (count, 1))
            self.assertEqual(steps["ConnectivityIdOffsets"].shape, (count, 1))
            for name in ("Values", "PartOffsets", "NumberOfParts", "PointOffsets"):
                self.assertEqual(steps[name].shape, (count,))
            self.assertEqual(grid["Points"].shape, (count * printed["points"], 3))
            for name in printed["fields"]:
                self.assertNotRegex(name, "[./]")  # what the format cannot hold
                self.assertEqual(grid["PointData"][name].shape, (count * printed["points"],))
            self.assertEqual(list(file["hersey/bearings"].asstr()), printed["bearings"])
            for k in range(count):
                Step(file, k)

    def test_fields_and_times_are_those_of_the_results(self):
        target, printed = self.films("rod")
        with h5py.File(target) as file, h5py.File(self.run_of("rod")) as results:
            fields = results["bearings"][printed["bearings"][0]]["fields"]
            self.assertEqual(list(fields["time"]), printed["instants"])
            for k, time in enumerate(fields["time"]):
                step = Step(file, k)
                self.assertEqual(step.time, time)
                for name in ("pressure", "thickness"):
                    self.assertEqual(list(step.data["PointData", name]), list(fields[name][k].ravel()))

    def test_pressure_on_the_surface_is_the_force_of_the_film(self):
        """In ground's axes, while the rod swings: position, orientation, angles and order of the nodes are all in it."""
        for name in ("rod", "slider", "thrust", "skirt"):
            target, printed = self.films(name)
            with h5py.File(target) as file, h5py.File(self.run_of(name)) as results:
                for b, bearing_name in enumerate(printed["bearings"]):
                    bearing, swing = results["bearings"][bearing_name], []
                    # The trapezoidal rule misses 1/m^2 of a parabola over m intervals, across and along each pad; flat faces miss (pi/n)^2/6.
                    m, n = int(bearing.attrs["n_z"]) - 1, int(bearing.attrs["n_phi"])
                    along = np.bincount(bearing["fields/arc"][()].astype(int)).min() - 1 if "arc" in bearing["fields"] else n
                    share = 1.5 * (1 / m ** 2 + 1 / along ** 2 + (np.pi / n) ** 2 / 6)
                    for k in range(1, len(printed["instants"])):
                        step = Step(file, k)
                        row = int(np.abs(results["time"][()] - step.time).argmin())
                        X = pose(results, bearing, row)
                        force, all_of_it = pressure_force(step, b, X, name)
                        with self.subTest(run=name, bearing=bearing_name, instant=k):
                            self.assertLess(np.linalg.norm(force - X[0] @ bearing["force_pressure"][row]), share * all_of_it)
                        swing.append(np.arctan2(X[0][1, 0], X[0][0, 0]))
                    self.assertGreater(len(swing), 1)
                    if name == "rod":
                        self.assertGreater(np.ptp(swing), 0.1)

    def test_surface_is_a_closed_bore_that_moves_with_its_body(self):
        target, printed = self.films("rod")
        with h5py.File(target) as file, h5py.File(self.run_of("rod")) as results:
            bearing = results["bearings"][printed["bearings"][0]]
            R, L, n = float(bearing.attrs["radius"]), float(bearing.attrs["width"]), int(bearing.attrs["n_phi"])
            around = n * 2 * R * np.sin(np.pi / n)
            first = Step(file, 0).points
            for k in range(len(printed["instants"])):
                step = Step(file, k)
                self.assertAlmostEqual(np.linalg.norm(step.areas(), axis=1).sum() / (around * L), 1, delta=EXACT * n)
                self.assertLess(np.abs(step.areas().sum(axis=0)).max(), EXACT * around * L * n)  # closed around
                # A rigid motion keeps distances.
                np.testing.assert_allclose(np.linalg.norm(step.points - step.points[0], axis=1), np.linalg.norm(first - first[0], axis=1),
                                           atol=EXACT * n * R)
            self.assertGreater(np.abs(Step(file, len(printed["instants"]) - 1).points - first).max(), R / 10)

    def test_rolled_out_and_at_rest(self):
        for surface in ("unwrapped", "bearing"):
            target, printed = self.films("rod", "--surface", surface)
            with h5py.File(target) as file, h5py.File(self.run_of("rod")) as results:
                bearing = results["bearings"][printed["bearings"][0]]
                R, L, n = float(bearing.attrs["radius"]), float(bearing.attrs["width"]), int(bearing.attrs["n_phi"])
                self.assertEqual(file["VTKHDF/Points"].shape, (printed["points"], 3))  # once for all times
                step = Step(file, 2)
                pressure = step.data["PointData", "pressure"].reshape(-1, int(bearing.attrs["n_z"]))
                self.assertEqual(pressure[:n].tolist(), bearing["fields/pressure"][2].tolist())
                if surface == "bearing":
                    np.testing.assert_allclose(np.hypot(step.points[:, 0], step.points[:, 1]), R, rtol=EXACT)
                    continue
                self.assertEqual(pressure[-1].tolist(), pressure[0].tolist())  # the seam is drawn twice
                self.assertFalse(step.points[:, 2].any())
                np.testing.assert_allclose(np.ptp(step.points, axis=0)[:2], [2 * np.pi * R, L], rtol=EXACT)
                self.assertAlmostEqual(np.linalg.norm(step.areas(), axis=1).sum() / (2 * np.pi * R * L), 1, delta=EXACT * n)

    def test_pads_are_apart_and_sliders_are_planes(self):
        for name in ("pads", "thrust", "slider", "skirt"):
            with h5py.File(self.run_of(name)) as results:
                target, printed = self.films(name)
                with h5py.File(target) as file:
                    step = Step(file, 0)
                    for b, bearing_name in enumerate(printed["bearings"]):
                        bearing = results["bearings"][bearing_name]
                        fields = bearing["fields"]
                        along = fields["y" if "y" in fields else "phi"][()]
                        across = fields["r" if "r" in fields else "z"][()]
                        arc = fields["arc"][()] if "arc" in fields else np.zeros(len(along))
                        joined = np.diff(along)[np.diff(arc) == 0]
                        if "y" in fields:
                            expected = joined.sum() * np.ptp(across)
                        elif "r" in fields:
                            expected = np.sin(joined).sum() * (across[-1] ** 2 - across[0] ** 2) / 2
                        else:
                            expected = 2 * float(bearing.attrs["radius"]) * np.sin(joined / 2).sum() * np.ptp(across)
                        if "y" not in fields and "arc" not in fields:
                            gap = 2 * np.pi - np.ptp(along)
                            expected += (np.sin(gap) * (across[-1] ** 2 - across[0] ** 2) / 2 if "r" in fields else
                                         2 * float(bearing.attrs["radius"]) * np.sin(gap / 2) * np.ptp(across))
                        found = np.linalg.norm(step.areas()[step.of(b)], axis=1).sum()
                        with self.subTest(run=name, bearing=bearing_name):
                            self.assertAlmostEqual(found / expected, 1, delta=EXACT * len(along))
                    rolled, _ = self.films(name, "--surface", "unwrapped")
                    with h5py.File(rolled) as flat:
                        films = Step(flat, 0)
                        boxes = [films.points[np.unique(films.corners()[1][films.of(b)])][:, 1] for b in range(len(printed["bearings"]))]
                        for lower, upper in zip(boxes, boxes[1:]):
                            self.assertLess(lower.max(), upper.min())  # one above the other

    def test_bearings_and_instants_are_chosen(self):
        _, printed = self.films("pads")
        one = printed["bearings"][1]
        target, chosen = self.films("pads", "--bearing", one, "--instant", f"{1e3 * printed['instants'][-1]}ms")
        self.assertEqual((chosen["bearings"], chosen["instants"]), ([one], printed["instants"][-1:]))
        with h5py.File(target) as file, h5py.File(self.run_of("pads")) as results:
            self.assertEqual(list(Step(file, 0).data["PointData", "pressure"]), list(results[f"bearings/{one}/fields/pressure"][-1].ravel()))

    def test_vtk_reads_every_step(self):
        try:
            from vtkmodules.util.numpy_support import vtk_to_numpy
            from vtkmodules.vtkIOHDF import vtkHDFReader
        except ImportError:
            self.skipTest("python3-vtk9 is not installed")
        target, printed = self.films("rod")
        with h5py.File(target) as file:
            for k in (0, len(printed["instants"]) - 1):
                step = Step(file, k)
                one = os.path.join(self.folder, f"step{k}.vtkhdf")
                self.write_single(one, step)
                reader = vtkHDFReader()
                reader.SetFileName(one)
                reader.Update()
                grid = reader.GetOutput()
                self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (printed["points"], printed["cells"]))
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), step.points)
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetArray("pressure")), step.data["PointData", "pressure"])
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetCellData().GetArray("bearing")), step.data["CellData", "bearing"])
                self.assertEqual(grid.GetCell(3).GetClassName(), "vtkQuad")

    @staticmethod
    def write_single(path, step):
        """A file of version 1 with one time, which every reader of the format knows."""
        with h5py.File(path, "w") as file:
            grid = file.create_group("VTKHDF")
            grid.attrs["Version"] = [1, 0]
            grid.attrs.create("Type", b"UnstructuredGrid", dtype=h5py.string_dtype("ascii", 16))
            grid["NumberOfPoints"], grid["NumberOfCells"] = [len(step.points)], [len(step.types)]
            grid["NumberOfConnectivityIds"] = [len(step.connectivity)]
            grid["Points"], grid["Connectivity"], grid["Offsets"], grid["Types"] = step.points, step.connectivity, step.offsets, step.types
            for (kind, name), values in step.data.items():
                grid[f"{kind}/{name}"] = values

    def test_newer_vtk_reads_the_times(self):
        try:
            import vtkmodules.vtkCommonCore as core
            from vtkmodules.util.numpy_support import vtk_to_numpy
            from vtkmodules.vtkIOHDF import vtkHDFReader
        except ImportError:
            self.skipTest("python3-vtk9 is not installed")
        version = core.vtkVersion
        if (version.GetVTKMajorVersion(), version.GetVTKMinorVersion()) < (9, 3):
            self.skipTest(f"VTK {version.GetVTKVersion()} reads no times of VTKHDF files: 9.3 and later do")
        target, printed = self.films("rod")
        reader = vtkHDFReader()
        reader.SetFileName(target)
        reader.UpdateInformation()
        self.assertEqual(reader.GetNumberOfSteps(), len(printed["instants"]))
        with h5py.File(target) as file:
            for k in (0, 3, len(printed["instants"]) - 1):
                reader.UpdateTimeStep(printed["instants"][k])
                grid = reader.GetOutput()
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), Step(file, k).points)
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetArray("pressure")),
                                              Step(file, k).data["PointData", "pressure"])

    def test_faults_say_what_is_allowed(self):
        results = self.run_of("pads")
        target, printed = self.films("pads")
        self.assertIn("--force", hersey("export", results, "--films", target, expect=2))
        self.assertIn(printed["bearings"][0], hersey("export", results, "--films", target, "--force", "--bearing", "none", expect=2))
        self.assertIn("unwrapped", hersey("export", results, "--films", target, "--force", "--surface", "flat", expect=2))
        self.assertIn("--films", hersey("export", results, "--netcdf", "a.nc", "--surface", "unwrapped", expect=2))
        self.assertIn("--loads", hersey("export", results, "--films", target, "--loads", "vtkhdf", expect=2))
        self.assertIn(".vtkhdf", hersey("export", results, "--films", "films.vtu", expect=2))
        self.assertIn("--hold", hersey("export", results, "--films", target, "--force", "--hold", "feet", expect=2))
        self.assertIn("--bearing", hersey("export", results, "--netcdf", "a.nc", "--bearing", printed["bearings"][0], expect=2))
        self.assertIn("--set", hersey("export", results, "--films", target, "--force", "--set", "a=1", expect=2))
        self.assertIn(".h5", hersey("export", os.path.join(ROOT, RUNS["pads"][0]), "--films", "a.vtkhdf", expect=2))
        model = os.path.join(ROOT, "examples/ball_drop/model.yaml")
        out = os.path.join(self.folder, "ball")
        hersey("run", model, "--output", out, "--set", "simulation.duration=1ms")
        self.assertIn("fields_every", hersey("export", os.path.join(out, "results.h5"), "--films", target, "--force", expect=2))


if __name__ == "__main__":
    unittest.main()
