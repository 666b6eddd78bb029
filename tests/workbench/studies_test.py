"""Studies in `hersey open`: the plan of a text, and what the runs of one that was started have given so far.

    studies_test.py HERSEY [Class.test_name]
"""

import csv
import importlib.util
import json
import os
import resource
import shutil
import sys
import tempfile
import time
import unittest
import unittest.mock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from workbench_client import Workbench, write  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1))
MODEL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/bearing_tolerances/model.yaml")
LACKING = [name for name in ("scipy", "openturns") if importlib.util.find_spec(name) is None]
LIST = """study:
  plan: list
  parameters: {load: [500 N, 1 kN, 2000 N], clearance: [30 um, 30 um, 30 um]}
  outputs: [bearings.main.h_min]
"""


class Studies(unittest.TestCase):
    def setUp(self):
        self.top = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(self.top.cleanup)
        self.folder = os.path.join(self.top.name, "models")
        os.mkdir(self.folder)
        shutil.copy(MODEL, os.path.join(self.folder, "drawn.yaml"))
        with open(MODEL, encoding="utf-8") as file:
            self.drawn = file.read()
        self.text = self.drawn.split("study:")[0] + LIST
        write(self.folder, "list.yaml", self.text)
        self.server = self.serve()

    def serve(self, **environment):
        with unittest.mock.patch.dict(os.environ, environment):
            server = Workbench(PROGRAM, self.folder, os.path.join(self.top.name, "log"))
        self.addCleanup(server.stop)
        return server

    def plan(self, text, overrides=(), path="list.yaml"):
        return self.server.post("/api/plan", {"path": path, "text": text, "set": list(overrides)}, timeout=90)

    def start(self, **more):
        answer = self.server.post("/api/runs", {"path": "list.yaml", "set": [], "study": True} | more)
        self.assertEqual(answer.status, 200, answer.text)
        return answer.json["id"]

    def finished(self, name):
        deadline = time.monotonic() + 90
        while (run := self.server.run_of(name))["state"] == "running":
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        return run

    def course(self, name, after=""):
        return self.server.get(f"/api/runs/{name}/study" + (f"?after={after.replace(' ', '%20')}" if after else ""))

    def test_a_text_is_planned_as_it_stands_and_nothing_is_written(self):
        before = sorted(os.listdir(self.folder))
        plan = self.plan(self.text.replace("2000 N", "3000 N")).json
        self.assertEqual([run["values"] for run in plan["runs"]], [["500 N", "30 um"], ["1 kN", "30 um"], ["3000 N", "30 um"]])
        self.assertEqual([p["name"] for p in plan["parameters"]], ["load", "clearance"])
        self.assertEqual((plan["plan"], plan["total"], plan["wanted"]), ("list", 3, ["bearings.main.h_min"]))
        every = self.plan(self.text.replace("plan: list", "plan: full_factorial").replace("30 um, 30 um]", "40 um]").replace("[30 um, 30 um", "[30 um")).json
        self.assertEqual(every["total"], 6)
        fixed = self.plan(self.text, ["clearance=20 um"]).json
        self.assertEqual([run["values"] for run in fixed["runs"]], [["500 N"], ["1 kN"], ["2000 N"]])
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_wrong_studies_and_foreign_paths_are_refused(self):
        answer = self.plan(self.text.replace("h_min", "h_mn"))
        self.assertEqual(answer.status, 422)
        self.assertIn("bearings.main.h_min", answer.json["error"])
        self.assertIn("list.yaml", answer.json["error"])
        self.assertEqual(self.plan(self.text, ["nothing=1"]).status, 422)
        self.assertEqual(self.plan(self.text.split("study:", maxsplit=1)[0]).status, 422)
        self.assertEqual(self.plan(self.text, path="../list.yaml").status, 403)
        self.assertEqual(self.server.post("/api/plan", {"path": "list.yaml"}).status, 400)

    @unittest.skipIf(LACKING, f"Python lacks {', '.join(LACKING)}")
    def test_more_points_of_the_same_seed_keep_the_first_ones(self):
        few = self.plan(self.drawn.replace("samples: 128", "samples: 16"), path="drawn.yaml").json
        many = self.plan(self.drawn, path="drawn.yaml").json
        self.assertEqual((few["total"], many["total"]), (16, 128))
        self.assertEqual(many["runs"][:16], few["runs"])

    @unittest.skipIf(LACKING, f"Python lacks {', '.join(LACKING)}")
    def test_records_come_once_each_and_are_those_of_the_table(self):
        name = self.start(jobs=1)
        self.assertIn("--jobs=1", self.record(name)["command"])
        seen, at, plan = [], "", None
        deadline = time.monotonic() + 90
        while True:
            is_over = self.server.run_of(name)["state"] != "running"
            course = self.course(name, at).json
            plan = plan or course["plan"]
            seen += course["records"]
            at = course["at"] if plan else ""  # planned before anything is on record
            if is_over and plan and not course["records"]:
                break
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)
        self.assertEqual(self.server.run_of(name)["state"], "completed", self.server.get(f"/api/runs/{name}/log").text)
        self.assertEqual(seen, self.course(name).json["records"])
        self.assertEqual(sorted(record["run"] for record in seen), sorted(run["run"] for run in plan["runs"]))
        units = self.course(name).json["units"]["bearings.main.h_min"]
        with open(os.path.join(self.folder, "runs", name, "runs.csv"), encoding="utf-8") as file:
            table = list(csv.reader(file))
        column = next(i for i, head in enumerate(table[0]) if "h_min" in head)
        written = {row[-1]: float(row[column]) for row in table[1:]}
        by_run = {record["run"]: record["figures"]["bearings.main.h_min"] / units["si"] for record in seen}
        for run, value in by_run.items():
            self.assertAlmostEqual(value, written[run], delta=1e-6 * value)  # runs.csv has seven figures or more
        thin = [by_run[run["run"]] for run in plan["runs"]]
        self.assertEqual(thin, sorted(thin, reverse=True), "more load, but no thinner film")

    @unittest.skipIf(LACKING, f"Python lacks {', '.join(LACKING)}")
    def test_runs_under_way_are_told_with_their_share_and_their_events(self):
        with open(os.path.join(os.path.dirname(MODEL), "../../tests/cli/bearing.yaml"), encoding="utf-8") as file:
            text = file.read().replace("duration: 2 ms", "duration: 150 ms")
        write(self.folder, "moving.yaml", text + "\nstudy:\n  plan: list\n  parameters: {load: [100 N, 200 N]}\n  outputs: [bearings.main.moft]\n")
        name = self.start(path="moving.yaml", jobs=1)
        seen, times = {}, []
        deadline = time.monotonic() + 120
        while (run := self.server.run_of(name))["state"] == "running":
            self.assertLess(time.monotonic(), deadline)
            for part in self.course(name).json["running"]:
                seen.setdefault(part["run"], {"values": part["values"], "shares": []})["shares"].append(part["share"])
                events = [json.loads(line) for line in self.server.get(f"/api/runs/{name}/events?run={part['run']}").text.splitlines()]
                times += [event["t"] for event in events if event["kind"] == "stepped"][-1:]
            time.sleep(0.05)
        self.assertEqual(run["state"], "completed", self.server.get(f"/api/runs/{name}/log").text)
        planned = {entry["run"]: entry["values"] for entry in self.course(name).json["plan"]["runs"]}
        self.assertEqual({run: part["values"] for run, part in seen.items()}, planned)
        for part in seen.values():
            self.assertEqual(part["shares"], sorted(part["shares"]))
            self.assertGreater(part["shares"][-1], part["shares"][0])
        self.assertGreater(max(times), 0)
        # Nothing of it is left, and what asks for other files gets none.
        self.assertEqual(self.course(name).json["running"], [])
        runs = os.path.join(self.folder, "runs", name, "runs")
        self.assertEqual([file for file in os.listdir(runs) if file.endswith(".events")], [])
        write(self.folder, f"runs/{name}/secret.events", '{"kind":"of_study"}')
        for wrong in ("../secret", "..%2fsecret", ".", "a.b"):
            self.assertEqual(self.server.get(f"/api/runs/{name}/events?run={wrong}").status, 404, wrong)
        os.symlink("../secret.events", os.path.join(runs, "linked.events"))
        self.assertEqual(self.server.get(f"/api/runs/{name}/events?run=linked").text, "")

    @unittest.skipIf(LACKING, f"Python lacks {', '.join(LACKING)}")
    def test_records_that_are_none_are_left_out(self):
        name = self.start()
        self.finished(name)
        whole = self.course(name).json["records"]
        folder = os.path.join(self.folder, "runs", name)
        deep = '{"run": "deep", "values": ' + "[" * 100_000 + "]" * 100_000 + "}\n"
        with open(os.path.join(folder, "records.jsonl"), "a", encoding="utf-8") as file:
            file.write('no json\n[]\n{"run": "a"}\n' + deep + '{"run": "torn", "values": []')
        self.assertEqual([r for r in self.course(name).json["records"] if r["run"] != "deep"], whole)
        os.remove(os.path.join(folder, "plan.json"))
        os.symlink("/etc/passwd", os.path.join(folder, "plan.json"))
        self.assertIsNone(self.course(name).json["plan"])

    @unittest.skipIf(LACKING, f"Python lacks {', '.join(LACKING)}")
    def test_hostile_records_neither_hide_the_others_nor_stop_them(self):
        name = self.start()
        self.finished(name)
        whole = self.course(name).json["records"]
        folder = os.path.join(self.folder, "runs", name)
        with open(os.path.join(folder, "records.jsonl"), "r+", encoding="utf-8") as file:
            good = file.read()
            file.seek(0)
            # Of other types than the program writes; and longer than what is read at once, as one line and in its middle.
            file.write('{"run": 7, "values": []}\n{"run": "a", "values": [], "status": {}}\n{"describe": {"f": 1}}\n{"describe": {"f": {"si": ""}}}\n')
            file.write('{"run": "long", "values": [], "x": "' + "x" * 9_000_000 + '"}\n' + good)
        seen, at = [], ""
        for _ in range(10):
            course = self.course(name, at).json
            seen, at = seen + course["records"], course["at"]
            if not course["more"]:
                break
        self.assertEqual(seen, whole)
        self.assertFalse(self.course(name, at).json["more"])
        # What is written while the page looks is read when it is complete.
        for part, new in (('{"run": "la', []), ('te", "values": []}\n', ["late"])):
            with open(os.path.join(folder, "records.jsonl"), "a", encoding="utf-8") as file:
                file.write(part)
            course = self.course(name, at).json
            self.assertEqual([record["run"] for record in course["records"]], new)
            at = course["at"]

    def test_records_of_many_tasks_come_once_each(self):
        # A study that another program has written; 700 records of each task, so that the second one's come in two answers.
        folder = os.path.join(self.folder, "runs", "shared-001")
        write(folder, "run.json", json.dumps({"model": "list.yaml", "set": [], "study": True}))
        write(folder, "records.jsonl", "")
        for shard in ("a-0.jsonl", "a-1.jsonl", "b 2:3.jsonl"):
            lines = (json.dumps({"run": f"{shard} {number}", "values": []}) + "\n" for number in range(700))
            write(folder, "shards/" + shard, "".join(lines))
        seen, at = [], ""
        for expected in (1000, 400, 0):
            course = self.course("shared-001", at).json
            self.assertEqual((len(course["records"]), course["more"]), (expected, expected == 1000))
            seen, at = seen + [record["run"] for record in course["records"]], course["at"]
        self.assertEqual(seen, [f"a-{shard}.jsonl {number}" for shard in (0, 1) for number in range(700)])

    def test_a_text_that_does_not_fit_the_disk_is_not_planned_in_part(self):
        def full():
            resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))

        server = Workbench(PROGRAM, self.folder, os.path.join(self.top.name, "log2"), preexec=full)
        self.addCleanup(server.stop)
        answer = server.post("/api/plan", {"path": "list.yaml", "text": self.text + "#" * 200_000, "set": []}, timeout=90)
        self.assertEqual(answer.status, 507, answer.text)
        self.assertIn("make room", answer.json["advice"])

    def test_only_studies_have_a_course(self):
        answer = self.server.post("/api/runs", {"path": "list.yaml", "set": []})
        self.assertEqual(self.course(answer.json["id"]).status, 404)
        self.assertEqual(self.course("nothing-001").status, 404)
        before = sorted(os.listdir(os.path.join(self.folder, "runs")))
        self.assertEqual(self.server.post("/api/runs", {"path": "list.yaml", "study": True, "jobs": -1}).status, 422)
        self.assertEqual(self.server.post("/api/runs", {"path": "list.yaml", "study": True, "partition": "a b"}).status, 422)
        self.assertEqual(sorted(os.listdir(os.path.join(self.folder, "runs"))), before, "what is refused leaves no folder")

    def test_a_cluster_is_offered_where_there_is_one(self):
        self.assertFalse(self.serve(PATH="/nowhere").get("/api/hello").json["cluster"])
        tools = os.path.join(self.top.name, "tools")
        write(self.top.name, "tools/sbatch", "#!/bin/sh\nexit 1\n")
        self.assertFalse(self.serve(PATH=tools).get("/api/hello").json["cluster"], "a file that is no program")
        os.chmod(os.path.join(tools, "sbatch"), 0o755)
        self.assertTrue(self.serve(PATH=tools).get("/api/hello").json["cluster"])
        name = self.start(on="slurm", partition="long")
        command = self.record(name)["command"]
        self.assertEqual(command[command.index("--on") + 1], "slurm")
        self.assertIn("--partition=long", command)
        self.finished(name)

    def record(self, name):
        with open(os.path.join(self.folder, "runs", name, "run.json"), encoding="utf-8") as file:
            return json.load(file)


if __name__ == "__main__":
    unittest.main()
