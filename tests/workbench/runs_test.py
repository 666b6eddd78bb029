"""Runs started by `hersey open` go on without it, and are found again.

    runs_test.py HERSEY [Class.test_name]
"""

import http.client
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from workbench_client import Events, Workbench, start_of, write  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1))
MODEL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cli/bearing.yaml")
LONG = ["duration=1000 s"]


def is_running(pid):
    try:
        with open(f"/proc/{pid}/stat", encoding="ascii") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def children_of(pid):
    found = []
    for task in os.listdir(f"/proc/{pid}/task"):
        try:
            with open(f"/proc/{pid}/task/{task}/children", encoding="ascii") as file:
                found += [int(child) for child in file.read().split()]
        except FileNotFoundError:
            pass  # the thread has ended
    return found


def post_and_forget(server, path):
    try:
        server.post(path)
    except (OSError, http.client.HTTPException):
        pass  # the server has ended


class Runs(unittest.TestCase):
    def setUp(self):
        self.top = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(self.top.cleanup)
        self.folder = os.path.join(self.top.name, "models")
        os.mkdir(self.folder)
        shutil.copy(MODEL, os.path.join(self.folder, "bearing.yaml"))
        self.pids = []
        self.addCleanup(self.end_runs)
        self.server = self.open()

    def open(self):
        server = Workbench(PROGRAM, self.folder, os.path.join(self.top.name, "log"))
        self.addCleanup(server.stop)
        return server

    def end_runs(self):
        for pid in self.pids:
            if is_running(pid):
                os.kill(pid, signal.SIGKILL)
        while any(is_running(pid) for pid in self.pids):
            time.sleep(0.01)

    def record(self, name):
        with open(os.path.join(self.folder, "runs", name, "run.json"), encoding="utf-8") as file:
            return json.load(file)

    def start(self, *overrides, path="bearing.yaml"):
        answer = self.server.post("/api/runs", {"path": path, "set": list(overrides)})
        self.assertEqual(answer.status, 200, answer.body)
        name = answer.json["id"]
        self.pids.append(self.record(name)["process"]["pid"])
        return name

    def wait_for_steps(self, name, least=2):
        end = time.time() + 20
        while time.time() < end:
            lines = self.server.get(f"/api/runs/{name}/events").text.splitlines()
            if sum(json.loads(line)["kind"] == "stepped" for line in lines) >= least:
                return
            time.sleep(0.05)
        self.fail("no steps came")

    def test_a_run_reports_itself_from_start_to_end(self):
        events = Events(self.server)
        self.addCleanup(events.close)
        name = self.start("duration=1 ms")
        seen = []
        while not seen or seen[-1].get("kind") != "finished":
            _, kind, data = events.next()
            if kind == "run":
                seen.append(data)
        self.assertEqual({event["id"] for event in seen}, {name})
        self.assertEqual([event["kind"] for event in seen], ["started", "stepped", "stepped", "finished"])
        self.assertEqual(list(seen[0]["bearings"]), ["main"])
        self.assertEqual([event["t"] for event in seen[1:3]], [0, 0.001])
        self.assertEqual(seen[2]["share"], 1)
        figures = seen[2]["bearings"]["main"]
        self.assertEqual(set(figures), {"h_min", "p_max", "e_x", "e_y", "power", "power_asperity", "flow", "T_max"})
        self.assertEqual(seen[3]["status"], "completed")
        run = self.server.wait_for(name, "completed")
        self.assertEqual((run["share"], run["model"], run["set"], run["can_resume"]), (1, "bearing.yaml", ["duration=1 ms"], False))
        self.assertEqual(run["results"], [f"runs/{name}/results.h5"])
        self.assertIn("10 steps", self.server.get(f"/api/runs/{name}/log").text)
        # What the results say of the last step is what the event said.
        import h5py  # pylint: disable=import-outside-toplevel
        with h5py.File(os.path.join(self.folder, run["results"][0]), "r") as file:
            bearing = file["bearings/main"]
            for key in ("h_min", "p_max"):
                self.assertEqual(bearing[key][-1], figures[key])
            self.assertEqual(list(bearing["eccentricity"][-1]), [figures["e_x"], figures["e_y"]])
            self.assertEqual(bearing.attrs["radial_clearance"], seen[0]["bearings"]["main"]["clearance"])

    def test_reports_open_in_a_sandbox(self):
        first, second = self.start("duration=1 ms"), self.start("duration=1.5 ms")
        for name in (first, second):
            self.server.wait_for(name, "completed")
        url = self.server.post(f"/api/runs/{first}/report").json["url"]
        self.assertRegex(url, "^/report/[0-9a-f]{32}/$")
        page = self.server.get(url, token=False)
        self.assertEqual(page.status, 200)
        policy = page.headers["content-security-policy"]
        self.assertIn("sandbox allow-scripts", policy)
        self.assertNotIn("allow-same-origin", policy)
        self.assertNotIn("connect-src", policy)  # default-src 'none'
        self.assertTrue(page.headers["content-type"].startswith("text/html"))
        # The fields of all instants lie beside a report, which loads them when asked, as a stranger to every origin.
        write(self.folder, f"runs/{first}/report_fields/film.js", "fields")
        fields = self.server.get(url + "report_fields/film.js", token=False, headers={"Origin": "null", "Sec-Fetch-Site": "cross-site"})
        self.assertEqual((fields.status, fields.text), (200, "fields"))
        self.assertIn(f"http://127.0.0.1:{self.server.port}{url};", policy)
        both = self.server.post("/api/compare", {"ids": [first, second]})
        compared = self.server.get(both.json["url"], token=False)
        self.assertIn(f'"{first}"', compared.text)
        self.assertIn(f'"{second}"', compared.text)
        for path in (url[:-2] + "/", url + "run.json", url + "../run.json", url + "report_fields/../run.json", url + "report.html"):
            self.assertEqual(self.server.get(path, token=False).status, 404, path)
        self.assertEqual(self.server.get(url, token=False, headers={"Host": "evil.example:80"}).status, 403)
        self.assertEqual(self.server.post("/api/compare", {"ids": []}).status, 400)
        self.assertEqual(self.server.post("/api/compare", {"ids": [first, "none"]}).status, 404)

    def test_compared_runs_have_the_names_that_are_given(self):
        runs = [self.start(f"duration={time} ms") for time in (1, 2)]
        for name in runs:
            self.server.wait_for(name, "completed")
        answer = self.server.post("/api/compare", {"ids": runs, "names": ["load = 1, 2 N", "load\n= <3> N"]})
        page = self.server.get(answer.json["url"], token=False).text
        self.assertIn('"load = 1; 2 N"', page)
        self.assertIn("load = ", page)
        self.assertNotIn(f'"{runs[0]}"', page)
        # Names that nothing can be called by are the runs' own.
        page = self.server.get(self.server.post("/api/compare", {"ids": runs, "names": [" ", "x" * 300]}).json["url"], token=False).text
        for name in runs:
            self.assertIn(f'"{name}"', page)
        self.assertEqual(self.server.post("/api/compare", {"ids": runs, "names": ["one"]}).status, 400)

    def test_a_failed_run_says_which_part_of_its_text_it_is_about(self):
        name = self.start("load=1e9 N", "duration=100 ms")
        run = self.server.wait_for(name, "failed")
        with open(os.path.join(self.folder, "bearing.yaml"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        self.assertIn("bearing main", run["message"])
        self.assertEqual((run["at"]["path"], run["at"]["file"]), ("bearings.main", "bearing.yaml"))
        self.assertEqual(lines[run["at"]["line"] - 1].strip(), "main:")
        # A fault that the start finds, of an override: the first fault's own place.
        with open(os.path.join(self.folder, "bearing.yaml"), encoding="utf-8") as file:
            text = file.read()
        write(self.folder, "wrong.yaml", text.replace("duration", "duratoin"))
        run = self.server.wait_for(self.start(path="wrong.yaml"), "failed")
        self.assertEqual(run["at"]["path"], "simulation")
        self.assertIn("duratoin", text.replace("duration", "duratoin").splitlines()[run["at"]["line"] - 1])
        self.assertEqual(run["at"]["file"], "wrong.yaml")
        run = self.server.wait_for(self.start("duration=1 ms"), "completed")
        self.assertIsNone(run["at"])

    def test_a_run_is_removed_with_its_folder_and_nothing_else(self):
        first, second = self.start("duration=1 ms"), self.start("duration=1 ms")
        for name in (first, second):
            self.server.wait_for(name, "completed")
        write(self.folder, f"runs/{first}/report_fields/0_1.js", "fields")
        write(self.folder, f"runs/{first}/notes.md", "mine")
        answer = self.server.post(f"/api/runs/{first}/remove")
        self.assertEqual(answer.status, 409, answer.body)
        self.assertIn("notes.md", answer.json["error"])
        self.assertTrue(os.path.exists(os.path.join(self.folder, "runs", first, "results.h5")))
        os.remove(os.path.join(self.folder, "runs", first, "notes.md"))
        events = Events(self.server)
        self.addCleanup(events.close)
        self.assertEqual(self.server.post(f"/api/runs/{first}/remove").status, 200)
        self.assertEqual(os.listdir(os.path.join(self.folder, "runs")), [second])
        while events.next()[1] != "runs":
            pass
        self.assertEqual(self.server.post(f"/api/runs/{first}/remove").status, 404)
        self.assertEqual(sorted(os.listdir(self.folder)), ["bearing.yaml", "runs"])
        self.assertEqual([run["id"] for run in self.server.get("/api/runs").json["runs"]], [second])

    def test_a_run_that_goes_on_is_not_removed(self):
        name = self.start(*LONG)
        self.wait_for_steps(name)
        self.assertEqual(self.server.post(f"/api/runs/{name}/remove").status, 409)
        self.assertTrue(is_running(self.pids[-1]))
        self.server.post(f"/api/runs/{name}/stop")
        self.server.wait_for(name, "stopped")
        self.assertEqual(self.server.post(f"/api/runs/{name}/remove").status, 200)
        self.assertEqual(os.listdir(os.path.join(self.folder, "runs")), [])

    def test_results_of_the_command_line_are_removed_alone(self):
        results = os.path.join(self.folder, "results")
        subprocess.run([PROGRAM, "run", os.path.join(self.folder, "bearing.yaml"), "--set", "duration=1 ms", "--output", os.path.join(results, "a")],
                       check=True, capture_output=True)
        write(self.folder, "results/a/notes.md", "mine")
        write(self.folder, "results/foreign.h5", "no results")
        for call, status in (("results:foreign.h5", 409), ("results:a:results.h5", 200), ("results:a:results.h5", 404)):
            self.assertEqual(self.server.post(f"/api/runs/{call}/remove").status, status, call)
        self.assertEqual(os.listdir(os.path.join(results, "a")), ["notes.md"])
        self.assertEqual(sorted(os.listdir(results)), ["a", "foreign.h5"])

    def test_a_run_is_stopped_and_goes_on(self):
        name = self.start("duration=0.2 s")
        self.wait_for_steps(name)
        self.assertEqual(self.server.run_of(name)["state"], "running")
        self.assertEqual(self.server.post(f"/api/runs/{name}/stop").status, 200)
        run = self.server.wait_for(name, "stopped")
        self.assertIn("stopped on request", run["message"])
        self.assertTrue(run["can_resume"])
        self.assertLess(run["share"], 1)
        self.assertEqual(self.server.post(f"/api/runs/{name}/stop").status, 409)
        self.assertEqual(self.server.post(f"/api/runs/{name}/resume").status, 200)
        self.pids.append(self.record(name)["process"]["pid"])
        self.assertEqual(self.server.wait_for(name, "completed")["share"], 1)
        self.assertEqual(self.server.post(f"/api/runs/{name}/resume").status, 409)

    def test_a_killed_server_leaves_runs_that_are_found_again(self):
        name = self.start(*LONG)
        self.wait_for_steps(name)
        pid = self.pids[-1]
        self.server.kill()
        self.assertTrue(is_running(pid))
        self.server = self.open()
        run = self.server.run_of(name)
        self.assertEqual((run["state"], run["set"]), ("running", LONG))
        events = Events(self.server)
        self.addCleanup(events.close)
        times = []
        while len(times) < 3:
            _, kind, data = events.next()
            if kind == "run":
                times.append(data["t"])
        self.assertEqual(times, sorted(set(times)))
        self.assertEqual(self.server.post(f"/api/runs/{name}/stop").status, 200)
        self.assertEqual(self.server.wait_for(name, "stopped")["share"] > 0, True)

    def test_a_mesh_that_is_being_made_ends_with_the_server(self):
        # A stand-in for gmsh that never ends.
        tools, noted = os.path.join(self.top.name, "tools"), os.path.join(self.top.name, "pid")
        os.chmod(write(tools, "gmsh", f"#!/bin/sh\necho $$ > {noted}.new; mv {noted}.new {noted}\nexec sleep 60\n"), 0o755)
        write(self.folder, "part.step", "solid")
        for end in (Workbench.kill, Workbench.stop):
            scratch = tempfile.mkdtemp(dir=self.top.name)
            with unittest.mock.patch.dict(os.environ, PATH=tools + ":" + os.environ["PATH"], TMPDIR=scratch):
                server = self.open()
            answer = server.post("/api/cad", {"path": "part.step", "size": "4 mm"})
            self.assertEqual(answer.status, 200, answer.body)
            deadline = time.monotonic() + 20
            while not os.path.exists(noted):
                self.assertLess(time.monotonic(), deadline, server.get("/api/cad/1").text)
                time.sleep(0.02)
            with open(noted, encoding="ascii") as file:
                gmsh = int(file.read())
            os.remove(noted)
            with open(f"/proc/{gmsh}/stat", encoding="ascii") as file:
                mesh = int(file.read().rsplit(")", 1)[1].split()[1])
            self.pids += [gmsh, mesh]
            # The connection that has asked for it has ended long since, as its thread has: the mesh goes on.
            time.sleep(0.5)
            self.assertEqual(server.get("/api/cad/1").json["state"], "running")
            self.assertTrue(is_running(gmsh) and is_running(mesh))
            end(server)
            deadline = time.monotonic() + 10
            while is_running(gmsh) or is_running(mesh):
                self.assertLess(time.monotonic(), deadline, "the mesh goes on without the server")
                time.sleep(0.02)
        self.assertEqual(os.listdir(scratch), [], "a server that is stopped leaves nothing")

    def test_a_run_is_followed_whenever_its_process_becomes_known(self):
        with subprocess.Popen(["sleep", "60"]) as process:
            self.addCleanup(process.kill)
            folder = os.path.join(self.folder, "runs", "quick-001")
            events = Events(self.server)
            self.addCleanup(events.close)
            process_of = {"pid": process.pid, "start": start_of(process.pid)}
            # The record is written twice, at times which the system's clock of files need not tell apart.
            record = write(folder, "run.json", json.dumps({"model": "bearing.yaml", "started": time.time()}))
            os.utime(record, ns=(10**18, 10**18))
            while events.next()[1] != "runs":
                pass
            new = write(folder, "run.json.new", json.dumps({"model": "bearing.yaml", "started": time.time(), "process": process_of}))
            os.utime(new, ns=(10**18, 10**18))
            os.replace(new, record)
            time.sleep(0.6)  # two looks at the folder
            write(folder, "events.ndjson", '{"kind":"stepped","t":1}\n')
            while (event := events.next())[1] != "run":
                pass
            self.assertEqual(event[2], {"kind": "stepped", "t": 1, "id": "quick-001"})
            process.kill()

    def test_a_run_that_is_stopped_before_it_can_report_it_is_stopped(self):
        folder = os.path.join(self.folder, "runs", "quick-001")
        # As a run is before it catches signals.
        with subprocess.Popen([sys.executable, "-c", "import signal; signal.signal(signal.SIGINT, signal.SIG_DFL); print(1, flush=True); signal.pause()",
                               folder], start_new_session=True, stdout=subprocess.PIPE) as process:
            self.addCleanup(process.kill)
            process.stdout.readline()
            write(folder, "run.json", json.dumps({"model": "bearing.yaml", "started": time.time(),
                                                  "process": {"pid": process.pid, "start": start_of(process.pid)}}))
            self.assertEqual(self.server.run_of("quick-001")["state"], "running")
            self.assertEqual(self.server.post("/api/runs/quick-001/stop").status, 200)
            self.assertEqual(process.wait(), -signal.SIGINT)
        run = self.server.wait_for("quick-001", "stopped", seconds=2)
        self.assertIn("on request", run["message"])
        self.assertIsNotNone(run["ended"])

    def test_a_killed_run_of_the_command_line_is_lost(self):
        with subprocess.Popen([PROGRAM, "run", "bearing.yaml", "--set", LONG[0]], cwd=self.folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as process:
            self.addCleanup(process.kill)
            results = os.path.join(self.folder, "results", "bearing", "results.h5")
            end = time.time() + 20
            while not os.path.exists(results) and time.time() < end:
                time.sleep(0.05)
            self.assertEqual(self.server.run_of("results:bearing:results.h5")["state"], "running")
            process.kill()
        self.assertTrue(os.path.exists(results + ".lock"))
        run = self.server.run_of("results:bearing:results.h5")
        self.assertEqual(run["state"], "lost")
        self.assertIn("killed", run["message"])

    def test_a_run_with_its_report_is_completed_though_its_events_ended(self):
        folder = os.path.join(self.folder, "runs", "full-001")
        write(folder, "run.json", json.dumps({"model": "bearing.yaml", "started": time.time() - 60, "process": {"pid": 99999999, "start": 1}}))
        write(folder, "events.ndjson", '{"kind":"started"}\n{"kind":"stepped","share":0.5}\n')
        write(folder, "results.h5", "")
        self.assertEqual(self.server.run_of("full-001")["state"], "lost")
        report = write(folder, "report.html", "a report")
        run = self.server.run_of("full-001")
        self.assertEqual((run["state"], run["share"]), ("completed", 1))
        write(folder, "results.checkpoint", "")
        self.assertEqual(self.server.run_of("full-001")["state"], "lost")
        os.remove(os.path.join(folder, "results.checkpoint"))
        before = time.time() - 120
        os.utime(report, (before, before))  # that of the run which this one goes on with
        self.assertEqual(self.server.run_of("full-001")["state"], "lost")

    def test_ctrl_c_of_the_server_ends_no_run(self):
        name = self.start(*LONG)
        self.wait_for_steps(name)
        self.assertEqual(self.server.stop(), 0)
        self.assertTrue(is_running(self.pids[-1]))
        self.server = self.open()
        self.server.post(f"/api/runs/{name}/stop")
        self.server.wait_for(name, "stopped")

    def test_a_second_ctrl_c_of_the_server_ends_it_at_once(self):
        name = self.start("duration=1 ms")
        self.server.wait_for(name, "completed")
        os.remove(os.path.join(self.folder, "runs", name, "report.html"))
        with unittest.mock.patch.dict(os.environ, TMPDIR=self.top.name):
            server = self.open()
        # A request that takes long: its report is made by a process that is suspended.
        suspended = None
        for _ in range(20):
            asking = threading.Thread(target=post_and_forget, args=(server, f"/api/runs/{name}/report"))
            asking.start()
            while asking.is_alive() and not suspended:
                suspended = next(iter(children_of(server.process.pid)), None)
            if suspended:
                self.pids.append(suspended)
                os.kill(suspended, signal.SIGSTOP)
                break
        time.sleep(0.2)
        self.assertTrue(asking.is_alive())
        server.process.send_signal(signal.SIGINT)
        time.sleep(1)
        self.assertIsNone(server.process.poll(), "it waits for the request in progress")
        server.process.send_signal(signal.SIGINT)
        self.assertEqual(server.process.wait(timeout=2), -signal.SIGINT)
        asking.join()

    def test_a_killed_run_is_lost_and_can_go_on(self):
        name = self.start("duration=0.2 s")
        self.wait_for_steps(name)
        os.kill(self.pids[-1], signal.SIGKILL)
        run = self.server.wait_for(name, "lost")
        self.assertIn("killed", run["message"])
        self.assertTrue(run["can_resume"])
        self.assertEqual(self.server.post(f"/api/runs/{name}/resume").status, 200)
        self.pids.append(self.record(name)["process"]["pid"])
        self.assertEqual(self.server.wait_for(name, "completed")["share"], 1)

    def test_a_failing_run_says_why(self):
        write(self.folder, "wrong.yaml", "hersey: 1\nbodies:\n  rod: {mass: -1 kg}\n")
        run = self.server.wait_for(self.start(path="wrong.yaml"), "failed")
        self.assertIn("wrong.yaml:3", run["message"])
        self.assertIn("mass", self.server.get(f"/api/runs/{run['id']}/log").text)
        self.assertEqual(self.server.post(f"/api/runs/{run['id']}/report").status, 409)
        thin = self.server.wait_for(self.start("load=1e9 N", "duration=0.1 s"), "failed")
        self.assertIn("t = ", thin["message"])
        self.assertIsNotNone(thin["report"])
        self.assertTrue(self.server.is_alive())

    def test_what_is_run_is_what_was_saved(self):
        etag = self.server.file("bearing.yaml").headers["etag"]
        write(self.folder, "bearing.yaml", self.server.file("bearing.yaml").text + "# theirs\n")
        answer = self.server.post("/api/runs", {"path": "bearing.yaml", "set": [], "etag": etag})
        self.assertEqual(answer.status, 409)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "runs")))
        name = self.start("duration=1 ms")
        self.assertTrue(self.server.get(f"/api/runs/{name}/model").text.endswith("# theirs\n"))
        self.server.wait_for(name, "completed")

    def test_overrides_are_no_options(self):
        for change in ("--force", "no equals sign", "a=\n--output=/tmp", "a=\0"):
            with self.subTest(change=change):
                self.assertEqual(self.server.post("/api/runs", {"path": "bearing.yaml", "set": [change]}).status, 422)
        other = os.path.join(self.top.name, "other")
        name = self.start(f"--output={other}")
        run = self.server.wait_for(name, "failed")
        self.assertFalse(os.path.exists(other))
        self.assertIn("output", run["message"])

    def test_a_record_of_someone_elses_process_ends_no_process(self):
        with subprocess.Popen(["sleep", "60"]) as victim:
            start = start_of(victim.pid)
            for process in ({"pid": victim.pid, "start": start}, {"pid": victim.pid, "start": 1}, {"pid": -1, "start": start}, {"pid": 1, "start": 0},
                            {"pid": "x"}, [], 7):
                write(self.folder, "runs/evil-001/run.json", json.dumps({"model": "bearing.yaml", "process": process, "set": 5, "study": "no",
                                                                        "command": ["touch", os.path.join(self.folder, "made")]}))
                self.assertEqual(self.server.post("/api/runs/evil-001/stop").status, 409, process)
                self.assertIsNone(victim.poll())
            victim.kill()
        self.assertFalse(os.path.exists(os.path.join(self.folder, "made")))
        for text in ("", "[]", "{", "null", "\0", '{"model": "../../x.yaml", "process": null}'):
            write(self.folder, "runs/evil-001/run.json", text)
            write(self.folder, "runs/evil-001/events.ndjson", text + '\n{"kind": 5}\n{"kind":"finished","status":7}\n')
            self.assertEqual(self.server.get("/api/runs").status, 200)
            self.assertGreaterEqual(self.server.post("/api/runs/evil-001/resume").status, 400)
        self.assertTrue(self.server.is_alive())

    def test_events_are_few_and_their_file_is_the_users(self):
        model = os.path.join(self.folder, "bearing.yaml")
        before = open(model, "rb").read()  # pylint: disable=consider-using-with
        refused = subprocess.run([PROGRAM, "run", model, "--events", model], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("no file of events", refused.stderr)
        self.assertEqual(open(model, "rb").read(), before)  # pylint: disable=consider-using-with
        events = os.path.join(self.folder, "events.ndjson")
        begin = time.time()
        subprocess.run([PROGRAM, "run", model, "--events", events, "--set", "duration=0.2 s"], cwd=self.folder,
                       capture_output=True, check=True)
        seconds = time.time() - begin
        with open(events, encoding="utf-8") as file:
            kinds = [json.loads(line)["kind"] for line in file]
        self.assertLess(kinds.count("stepped"), 10 * seconds + 2)
        self.assertEqual((kinds[0], kinds[-1]), ("started", "finished"))
        # A full disk ends the events and not the run.
        full = subprocess.run([PROGRAM, "run", model, "--events", "/dev/full", "--output", "full"], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        self.assertEqual(full.returncode, 0, full.stderr)

    def test_events_of_a_run_of_any_length_are_few(self):
        write(self.folder, "runs/long-001/run.json", json.dumps({"model": "bearing.yaml", "started": time.time()}))
        bearings = {f"bearing_{i}": {"h_min": 1.234567e-6, "p_max": 1.234567e8, "e_x": 1.2345e-5, "e_y": -1.2345e-5} for i in range(9)}
        steps = 100_000
        path = os.path.join(self.folder, "runs", "long-001", "events.ndjson")
        with open(path, "w", encoding="utf-8") as file:
            file.write('{"kind":"started","t":0}\n')
            for i in range(steps):
                file.write(f'{{"kind":"stepped","t":{i},"bearings":{json.dumps(bearings)}}}\n')
            file.write('{"kind":"finished","t":100000,"status":"completed"}\n')
        self.assertGreater(os.path.getsize(path), 80 << 20)
        answer = self.server.get("/api/runs/long-001/events")
        self.assertLess(len(answer.body), 9 << 20)
        events = [json.loads(line) for line in answer.text.splitlines()]
        self.assertEqual((events[0]["kind"], events[-1]["kind"]), ("started", "finished"))
        times = [event["t"] for event in events if event["kind"] == "stepped"]
        self.assertLessEqual(len(times), 4000)
        self.assertEqual(times[-1], steps - 1)
        self.assertLess(max(b - a for a, b in zip(times, times[1:])), 3 * steps / 4000)

    def test_runs_of_a_study(self):
        text = self.server.file("bearing.yaml").text + "study:\n  parameters:\n    load: [100 N, 200 N]\n"
        write(self.folder, "study.yaml", text)
        name = self.start("duration=1 ms", path="study.yaml")
        run = self.server.wait_for(name, "completed")
        self.assertEqual(len(run["results"]), 2)
        kinds = [json.loads(line)["kind"] for line in self.server.get(f"/api/runs/{name}/events").text.splitlines()]
        self.assertEqual(kinds.count("run_finished"), 2)
        started = json.loads(self.server.get(f"/api/runs/{name}/events").text.splitlines()[0])
        self.assertEqual(started["bearings"], {"main": {"clearance": None}})  # its runs may differ in it

    def test_a_study_by_its_own_program_says_how_it_ended(self):
        # The model has none; where the study's Python packages are missing, that is what it says.
        answer = self.server.post("/api/runs", {"path": "bearing.yaml", "set": ["load=5 N"], "study": True})
        name = answer.json["id"]
        self.pids.append(self.record(name)["process"]["pid"])
        self.assertIn("study", self.record(name)["command"])
        run = self.server.wait_for(name, "failed")
        self.assertTrue(run["study"])
        self.assertRegex(run["message"], "study")
        self.assertIn(run["message"], self.server.get(f"/api/runs/{name}/log").text)
        self.assertTrue(run["can_resume"])


if __name__ == "__main__":
    unittest.main()
