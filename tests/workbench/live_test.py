"""What a page sees of a run while it goes on: events of its oil circuit, and the film as it is stored last.

    live_test.py HERSEY [Class.test_name]
"""

import base64
import json
import os
import shutil
import struct
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from workbench_client import Workbench, write  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1))
SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")


def numbers_of(dataset):
    kind, size = {"f4": ("f", 4), "f8": ("d", 8)}[dataset["type"]]
    data = base64.b64decode(dataset["data"])
    return struct.unpack(f"<{len(data) // size}{kind}", data)


class Live(unittest.TestCase):
    def setUp(self):
        self.top = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(self.top.cleanup)
        self.folder = os.path.join(self.top.name, "models")
        os.mkdir(self.folder)
        shutil.copy(os.path.join(SOURCE, "tests/cli/bearing.yaml"), os.path.join(self.folder, "bearing.yaml"))
        shutil.copy(os.path.join(SOURCE, "examples/oil_circuit/model.yaml"), os.path.join(self.folder, "circuit.yaml"))
        shutil.copy(os.path.join(SOURCE, "examples/oil_circuit/warm.yaml"), os.path.join(self.folder, "warm.yaml"))
        self.server = Workbench(PROGRAM, self.folder, os.path.join(self.top.name, "log"))
        self.addCleanup(self.server.stop)

    def start(self, path, *overrides):
        answer = self.server.post("/api/runs", {"path": path, "set": list(overrides)})
        self.assertEqual(answer.status, 200, answer.text)
        return answer.json["id"]

    def results(self, name):
        import h5py  # pylint: disable=import-outside-toplevel
        file = h5py.File(os.path.join(self.folder, "runs", name, "results.h5"), "r")
        self.addCleanup(file.close)
        return file

    def film(self, name, bearing="main"):
        return self.server.get(f"/api/runs/{name}/film?bearing={bearing}").json

    def test_events_of_a_circuit_are_its_results(self):
        for model, has_heat in (("circuit.yaml", False), ("warm.yaml", True)):
            name = self.start(model, "simulation.duration=2 ms")
            self.server.wait_for(name, "completed", seconds=120)
            lines = self.server.get(f"/api/runs/{name}/events").text.splitlines()
            last = [event for event in map(json.loads, lines) if event["kind"] == "stepped"][-1]
            circuit, stored = last["circuit"], self.results(name)["circuit"]
            self.assertEqual({f"pressure_{node}" for node in circuit["nodes"]}, {key for key in stored if key.startswith("pressure_")})
            self.assertEqual({f"flow_{element}" for element in circuit["flows"]}, {key for key in stored if key.startswith("flow_")})
            for node, figures in circuit["nodes"].items():
                self.assertEqual(figures["pressure"], stored[f"pressure_{node}"][-1])
                self.assertEqual("temperature" in figures, has_heat)
                if has_heat:
                    celsius = stored[f"temperature_{node}"][-1]
                    self.assertAlmostEqual(figures["temperature"] - 273.15, celsius, delta=1e-9)  # round-off of 300 K
            for element, flow in circuit["flows"].items():
                self.assertEqual(flow, stored[f"flow_{element}"][-1])

    def test_events_of_the_powers_are_the_results(self):
        for model in ("bearing.yaml", "warm.yaml"):
            name = self.start(model, "simulation.duration=2 ms") if model == "warm.yaml" else self.start(model)
            self.server.wait_for(name, "completed", seconds=120)
            lines = self.server.get(f"/api/runs/{name}/events").text.splitlines()
            last = [event for event in map(json.loads, lines) if event["kind"] == "stepped"][-1]
            results = self.results(name)
            stored = results["power"]
            for key, value in last["powers"].items():
                if key != "heat":
                    self.assertEqual(value, stored[key][-1], key)
            for bearing, figures in last["bearings"].items():
                own = results["bearings"][bearing]
                self.assertEqual(figures["power_asperity"], own["power_asperity"][-1])
                self.assertEqual("heat" in figures, "heat_to_oil" in own)
                for key, value in figures.get("heat", {}).items():
                    self.assertEqual(value, own["heat_stored" if key == "stored" else f"heat_{key}"][-1], key)
            put_in = sum(last["powers"][key] for key in ("drives", "loads", "gravity", "springs", "contacts", "bearings", "elastic"))
            largest = max(abs(value) for key, value in last["powers"].items() if key != "heat")
            # Round-off of seven sums.
            self.assertAlmostEqual(put_in - last["powers"]["kinetic_rate"], last["powers"]["balance_error"], delta=1e-12 * largest)
            self.assertEqual("heat" in last["powers"], "thermal" in results)

    def test_machines_without_a_circuit_have_none(self):
        name = self.start("bearing.yaml")
        self.server.wait_for(name, "completed")
        self.assertNotIn("circuit", self.server.get(f"/api/runs/{name}/events").text)

    def test_the_film_is_the_one_that_is_stored_last(self):
        name = self.start("bearing.yaml", "duration=1000 s", "output.fields_every=1 ms")
        first = second = None
        deadline = time.monotonic() + 60
        while second is None:
            self.assertLess(time.monotonic(), deadline)
            self.assertEqual(self.server.run_of(name)["state"], "running", self.server.get(f"/api/runs/{name}/log").text)
            film = self.film(name)
            if film["t"] is not None and first is None:
                first = film
            elif first is not None and film["t"] != first["t"]:
                second = film
            time.sleep(0.05)
        self.assertGreater(second["t"], first["t"], "it does not go on")
        self.server.post(f"/api/runs/{name}/stop")
        self.server.wait_for(name, "stopped")
        fields = self.results(name)["bearings/main/fields"]
        film = self.film(name)
        self.assertEqual(film["t"], fields["time"][-1])
        for told in (second, film):
            row = list(fields["time"]).index(told["t"])
            pressure = told["datasets"]["/bearings/main/fields/pressure"]
            self.assertEqual(pressure["shape"], [1, *fields["pressure"].shape[1:]])
            self.assertEqual(list(numbers_of(pressure)), list(fields["pressure"][row].astype("f4").ravel()))
        self.assertEqual(self.film(name, "another")["t"], None)
        self.assertEqual(self.server.get("/api/runs/nothing/film?bearing=main").status, 404)

    def test_a_damaged_file_costs_its_film_only(self):
        name = self.start("bearing.yaml")
        self.server.wait_for(name, "completed")
        path = os.path.join(self.folder, "runs", name, "results.h5")
        with open(path, "r+b") as file:
            file.seek(os.path.getsize(path) // 2)
            file.write(b"damaged" * 100)
        self.assertIsNone(self.film(name)["t"])
        write(self.folder, f"runs/{name}/results.h5", "no results")
        self.assertIsNone(self.film(name)["t"])
        self.assertTrue(self.server.is_alive())


if __name__ == "__main__":
    unittest.main()
