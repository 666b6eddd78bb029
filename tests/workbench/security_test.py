"""Who asks `hersey open` for what it should not give is refused, and the server goes on.

    security_test.py HERSEY [Class.test_name]
"""

import http.client
import json
import os
import resource
import shutil
import socket
import stat
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.parse

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from workbench_client import Events, Workbench, start_of, write  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1))
MODEL = "hersey: 1\ntitle: a model\n"
SECRET = "the content of a file outside"


def raw(port, data, seconds=15):
    """What the server answers to bytes that no library would send; empty if it closes without a word."""
    with socket.create_connection(("127.0.0.1", port), timeout=seconds) as connection:
        answer = b""
        try:
            connection.sendall(data)
            connection.shutdown(socket.SHUT_WR)
            while part := connection.recv(65536):
                answer += part
        except OSError:
            pass  # it has closed the connection
        return answer


def reset(connection):
    """Closes a connection as a machine that has lost its network does."""
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    os.close(connection.detach())


class Security(unittest.TestCase):
    def setUp(self):
        self.top = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(self.top.cleanup)
        self.folder = os.path.join(self.top.name, "models")
        write(self.folder, "model.yaml", MODEL)
        write(self.top.name, "secret.yaml", SECRET)
        self.server = Workbench(PROGRAM, self.folder, os.path.join(self.top.name, "log"))
        self.addCleanup(self.server.stop)

    def refused(self, answer, status, word):
        """The reply says what is wrong and what to do, in JSON that no browser takes for a page."""
        self.assertEqual(answer.status, status, answer.body[:300])
        self.assertIn(word, answer.json["error"])
        self.assertIn("advice", answer.json)
        self.assertEqual(answer.headers["content-type"], "application/json")
        self.assertEqual(answer.headers["x-content-type-options"], "nosniff")
        self.assertTrue(self.server.is_alive())

    def logged(self, *words):
        log = self.server.log()
        for word in words:
            self.assertIn(word, log)
        self.assertNotIn(self.server.token, log)

    def test_without_its_token_the_interface_says_nothing(self):
        calls = [("GET", call) for call in ("hello", "files", "file?path=model.yaml", "schema", "templates", "examples", "runs", "runs/x/log", "cad/1",
                                            "events", "no_such_call", "")]
        calls += [("POST", call) for call in ("check", "explain", "template", "new", "name_surfaces", "cad", "cad/1/stop", "runs", "runs/x/stop", "compare")]
        calls += [("PUT", "file?path=model.yaml")]
        other = self.server.token[:-1] + ("0" if self.server.token[-1] != "0" else "1")
        for token in (None, "", "Bearer", "Bearer ", "Bearer " + other, "Bearer " + self.server.token[:-1],
                      "Bearer " + self.server.token + "0", "Basic " + self.server.token, self.server.token):
            for method, call in calls:
                with self.subTest(token=token, call=call):
                    answer = self.server.request(method, "/api/" + call, headers={"Authorization": token, "If-Match": "*"})
                    self.refused(answer, 401, "token")
        # A token in the query is none: addresses are written into logs.
        self.refused(self.server.get("/api/hello?token=" + self.server.token, token=False), 401, "token")
        self.assertEqual(self.server.file("model.yaml").text, MODEL)
        self.logged("401 GET /api/hello")

    def test_tokens_are_random_and_new_at_each_start(self):
        self.assertRegex(self.server.token, "^[0-9a-f]{32}$")
        other = Workbench(PROGRAM, self.folder, os.path.join(self.top.name, "log2"))
        self.addCleanup(other.stop)
        self.assertNotEqual(other.token, self.server.token)
        self.assertNotEqual(other.port, self.server.port)
        self.refused(self.server.get("/api/hello", headers={"Authorization": "Bearer " + other.token}), 401, "token")

    def test_the_token_comes_before_the_body(self):
        # A body that never comes is not waited for.
        begin = time.time()
        answer = self.server.request("POST", "/api/check", b"", token=False, headers={"Content-Length": "1000"})
        self.refused(answer, 401, "token")
        self.assertLess(time.time() - begin, 4)  # 10 s would be the deadline of the body

    def test_only_the_loopback_address_is_bound(self):
        with open(f"/proc/{self.server.process.pid}/net/tcp", encoding="ascii") as table:
            bound = [line.split()[1] for line in table.readlines()[1:] if line.split()[3] == "0A"]
        own = [address for address in bound if address.endswith(f":{self.server.port:04X}")]
        self.assertEqual(own, [f"0100007F:{self.server.port:04X}"])
        with open(f"/proc/{self.server.process.pid}/net/tcp6", encoding="ascii") as table:
            self.assertNotIn(f":{self.server.port:04X} ", table.read())

    def test_pages_of_other_origins_are_refused(self):
        port = self.server.port
        for origin in ("http://evil.example", "https://127.0.0.1", f"https://127.0.0.1:{port}", f"http://127.0.0.1:{port + 1}",
                       f"http://localhost:{port}", "null", f"http://127.0.0.1:{port}.evil.example", "file://"):
            with self.subTest(origin=origin):
                self.refused(self.server.get("/api/hello", headers={"Origin": origin}), 403, "origin")
                self.refused(self.server.get("/", headers={"Origin": origin}), 403, "origin")
        for site in ("cross-site", "same-site"):
            self.refused(self.server.get("/api/hello", headers={"Sec-Fetch-Site": site}), 403, "site")
        good = self.server.get("/api/hello", headers={"Origin": f"http://127.0.0.1:{port}", "Sec-Fetch-Site": "same-origin"})
        self.assertEqual(good.status, 200)
        # No page of another origin is allowed to read an answer.
        self.assertNotIn("access-control-allow-origin", good.headers)
        self.logged("another origin")

    def test_other_names_of_this_machine_are_refused(self):
        port = self.server.port
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1.evil.example:80", "127.0.0.1", "localhost", "0.0.0.0:80",
                     "[::1]:80", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:123456", "", None, "localhost:80@evil.example:80",
                     "2130706433:80", "LOCALHOST.:80"):
            with self.subTest(host=host):
                for path in ("/api/hello", "/"):
                    answer = self.server.get(path, headers={"Host": host})
                    self.assertIn(answer.status, (400, 403))
                    self.assertNotIn(b"folder", answer.body)
        # Tunnels change the port.
        for host in ("127.0.0.1:9", "localhost:8080"):
            self.assertEqual(self.server.get("/api/hello", headers={"Host": host}).status, 200)
        two = raw(port, (f"GET /api/hello HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nHost: evil.example\r\n"
                         f"Authorization: Bearer {self.server.token}\r\nConnection: close\r\n\r\n").encode())
        self.assertIn(b" 403 ", two.splitlines()[0])

    def test_paths_out_of_the_folder_are_refused(self):
        os.symlink(os.path.join(self.top.name, "secret.yaml"), os.path.join(self.folder, "link.yaml"))
        os.symlink(self.top.name, os.path.join(self.folder, "linked"))
        os.symlink("nowhere.yaml", os.path.join(self.folder, "dangling.yaml"))
        os.symlink("/proc/self", os.path.join(self.folder, "self"))
        write(self.folder, ".hidden/key", SECRET)
        before = sorted(os.listdir(self.top.name))
        names = ["../secret.yaml", "sub/../../secret.yaml", "..", ".", "./model.yaml", "sub/..", "/etc/passwd",
                 os.path.join(self.top.name, "secret.yaml"), self.folder + "/model.yaml", "//etc/passwd", "link.yaml",
                 "linked/secret.yaml", "linked/new.yaml", "dangling.yaml", "self/environ", "self/root/etc/passwd", "", "a//b", "a/", ".hidden/key",
                 "model.yaml\0", "a\nb.yaml", "a\x1b[2J", "x/\u202e/../../secret.yaml"]
        encoded = [urllib.parse.quote(name, safe="") for name in names]
        encoded += ["%2e%2e/secret.yaml", "..%2fsecret.yaml", "%ff%fe.yaml", "%c0%ae%c0%ae/secret.yaml"]
        for name in encoded:
            with self.subTest(name=name):
                got = self.server.get("/api/file?path=" + name)
                self.assertIn(got.status, (403, 404))
                self.assertNotIn(SECRET.encode(), got.body)
                put = self.server.request("PUT", "/api/file?path=" + name, "changed", headers={"If-None-Match": "*"})
                self.assertEqual(put.status, 403, name)
                again = self.server.request("PUT", "/api/file?path=" + name, "changed", headers={"If-Match": '"0-0"'})
                self.assertEqual(again.status, 403, name)
        self.assertEqual(sorted(os.listdir(self.top.name)), before)
        with open(os.path.join(self.top.name, "secret.yaml"), encoding="utf-8") as file:
            self.assertEqual(file.read(), SECRET)
        self.assertEqual([file["path"] for file in self.server.get("/api/files").json["files"]], ["model.yaml"])
        for path in ("/../secret.yaml", "/%2e%2e/secret.yaml", "/assets/../../secret.yaml", "/etc/passwd", "/report/../secret.yaml",
                     "/report//", "/report/x/../../secret.yaml"):
            self.assertEqual(self.server.get(path).status, 404)
        self.logged("403 GET /api/file")

    def test_answers_and_runs_stay_in_the_folder_too(self):
        write(self.top.name, "other.yaml", MODEL)
        for call, more in (("check", {"text": MODEL}), ("new", {"template": "bearing"}), ("runs", {"set": []})):
            for path in ("../other.yaml", os.path.join(self.top.name, "other.yaml"), "../made.yaml"):
                with self.subTest(call=call, path=path):
                    answer = self.server.post("/api/" + call, {"path": path, **more})
                    self.assertGreaterEqual(answer.status, 400)
                    self.assertLess(answer.status, 500)
        for name in ("../models", "..", "x/../..", "%2e%2e", "model.yaml"):
            self.assertEqual(self.server.get(f"/api/runs/{name}/log").status, 404)
        self.assertEqual(sorted(os.listdir(self.top.name)), ["log", "models", "other.yaml", "secret.yaml"])

    def test_links_among_runs_lead_nowhere(self):
        run = os.path.join(self.folder, "runs", "evil-001")
        write(run, "run.json", '{"model": "model.yaml", "set": []}')
        secret = os.path.join(self.top.name, "secret.yaml")
        for name in ("log.txt", "events.ndjson", "model.txt", "report.html", "results.h5"):
            os.symlink(secret, os.path.join(run, name))
        self.assertEqual([entry["id"] for entry in self.server.get("/api/runs").json["runs"]], ["evil-001"])
        for call in ("GET log", "GET events", "GET model", "POST report", "POST resume"):
            method, what = call.split()
            answer = self.server.request(method, "/api/runs/evil-001/" + what)
            self.assertNotIn(SECRET.encode(), answer.body, call)
            self.assertEqual(answer.status, 200 if what in ("log", "events") else answer.status)
        os.rename(os.path.join(self.folder, "runs"), os.path.join(self.top.name, "elsewhere"))
        os.symlink("../elsewhere", os.path.join(self.folder, "runs"))
        self.assertEqual(self.server.get("/api/runs").json["runs"], [])
        self.refused(self.server.post("/api/runs", {"path": "model.yaml", "set": []}), 403, "link")
        self.assertEqual(os.listdir(os.path.join(self.top.name, "elsewhere")), ["evil-001"])
        with open(secret, encoding="utf-8") as file:
            self.assertEqual(file.read(), SECRET)

    def test_unfinished_files_are_no_way_out(self):
        secret = os.path.join(self.top.name, "secret.yaml")
        shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/meshes/conrod.msh"), self.folder)
        for number, target in enumerate((secret, os.path.join(self.top.name, "none"))):
            with self.subTest(target=target):
                named = f"named{number}.msh"
                os.symlink(target, os.path.join(self.folder, named + ".new"))
                answer = self.server.post("/api/name_surfaces", {"path": "conrod.msh", "length_unit": "mm", "output": named})
                self.assertEqual(answer.status, 200, answer.body)
                self.assertTrue(stat.S_ISREG(os.lstat(os.path.join(self.folder, named)).st_mode))
        self.assertEqual(sorted(os.listdir(self.top.name)), ["log", "models", "secret.yaml"])
        with open(secret, encoding="utf-8") as file:
            self.assertEqual(file.read(), SECRET)

    def test_elements_of_another_order_are_refused(self):
        write(self.folder, "part.step", "solid")
        for key, value in (("order", 3), ("order", 1.5), ("order", "2"), ("order", 1e300), ("around", True), ("around", 2.5)):
            with self.subTest(key=key, value=value):
                self.refused(self.server.post("/api/cad", {"path": "part.step", "size": "4 mm", key: value}), 422, key)

    def test_a_run_with_any_link_is_not_resumed(self):
        run = os.path.join(self.folder, "runs", "evil-001")
        secret = os.path.join(self.top.name, "secret.yaml")
        write(run, "results.checkpoint", "")
        write(run, "run.json", '{"model": "model.yaml", "set": []}')
        os.mkdir(os.path.join(run, "report_fields"))
        for name in ("run.json.new", "report.html.new", "report_fields/film.js"):
            with self.subTest(name=name):
                os.symlink(secret, os.path.join(run, name))
                self.refused(self.server.post("/api/runs/evil-001/resume"), 403, "link")
                self.assertTrue(os.path.islink(os.path.join(run, name)))
                os.remove(os.path.join(run, name))
        with open(secret, encoding="utf-8") as file:
            self.assertEqual(file.read(), SECRET)

    def test_nothing_is_removed_but_runs(self):
        write(self.top.name, "outside/run.json", '{"model": "model.yaml", "set": []}')
        write(self.folder, "runs/good-001/run.json", '{"model": "model.yaml", "set": []}')
        write(self.folder, "runs/bare-001/log.txt", "no record: no run")
        os.symlink("../../outside", os.path.join(self.folder, "runs", "evil-001"))
        os.symlink("../runs", os.path.join(self.folder, "results"))
        names = ("evil-001", "bare-001", "..", "../models", "%2e%2e", "../../outside", "good-001/..", "", ".", "good-001%00", "model.yaml", "results:good-001")
        for name in names:
            with self.subTest(name=name):
                self.assertIn(self.server.post(f"/api/runs/{name}/remove").status, (400, 404))
        # Links within a run, to a file and to a folder, of names that runs have: none is followed, none is removed.
        run = os.path.join(self.folder, "runs", "good-001")
        secret = os.path.join(self.top.name, "secret.yaml")
        for name, target in (("results.h5", secret), ("log.txt", secret), ("report_fields", os.path.join(self.top.name, "outside")), ("tasks", self.folder)):
            with self.subTest(name=name):
                os.symlink(target, os.path.join(run, name))
                self.refused(self.server.post("/api/runs/good-001/remove"), 409, name)
                self.assertTrue(os.path.islink(os.path.join(run, name)))
                os.remove(os.path.join(run, name))
        # Folders that no run makes, and files in those that it makes.
        for path in ("mine/a.h5", "report_fields/page.html", "report_fields/more/a.js", "runs/more/a.h5", "tasks/a/deep/task.sh", "shards/a.h5"):
            with self.subTest(path=path):
                write(run, path, "")
                self.refused(self.server.post("/api/runs/good-001/remove"), 409, "not of the run")
                self.assertTrue(os.path.exists(os.path.join(run, path)))
                shutil.rmtree(os.path.join(run, path.split("/")[0]))
        self.assertEqual(os.listdir(run), ["run.json"])
        for method in ("GET", "DELETE", "PUT"):
            self.assertIn(self.server.request(method, "/api/runs/good-001/remove").status, (400, 404, 405), method)
        self.assertEqual(self.server.request("POST", "/api/runs/good-001/remove", token=False).status, 401)
        self.assertEqual(os.listdir(run), ["run.json"])
        self.assertEqual(self.server.post("/api/runs/good-001/remove").status, 200)
        self.assertEqual(sorted(os.listdir(os.path.join(self.folder, "runs"))), ["bare-001", "evil-001"])
        # The folder of all runs is a link.
        os.rename(os.path.join(self.folder, "runs"), os.path.join(self.top.name, "elsewhere"))
        write(self.top.name, "elsewhere/good-001/run.json", '{"model": "model.yaml", "set": []}')
        os.symlink("../elsewhere", os.path.join(self.folder, "runs"))
        self.assertEqual(self.server.post("/api/runs/good-001/remove").status, 404)
        self.assertEqual(os.listdir(os.path.join(self.top.name, "elsewhere", "good-001")), ["run.json"])
        self.assertEqual(os.listdir(os.path.join(self.top.name, "outside")), ["run.json"])
        with open(secret, encoding="utf-8") as file:
            self.assertEqual(file.read(), SECRET)

    def test_a_link_that_is_made_while_a_mesh_is_read_is_not_followed(self):
        shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/meshes/conrod.msh"), self.folder)
        secret, link = os.path.join(self.top.name, "secret.yaml"), os.path.join(self.folder, "named.msh")
        answers = []

        def ask():
            answers.append(self.server.post("/api/name_surfaces", {"path": "conrod.msh", "length_unit": "mm", "output": "named.msh"}))

        begun = time.monotonic()
        ask()
        took = time.monotonic() - begun
        self.assertEqual(answers.pop().status, 200)
        os.remove(link)
        # Some of these moments lie between the look whether there is such a file and its being written.
        in_time = 0
        for part in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6):
            asking = threading.Thread(target=ask)
            asking.start()
            time.sleep(part * took)
            try:
                os.symlink(secret, link)
            except FileExistsError:  # it has been written already
                asking.join()
                self.assertEqual(answers.pop().status, 200)
            else:
                asking.join()
                self.assertIn(answers.pop().status, (403, 409))
                self.assertEqual(os.readlink(link), secret)
                in_time += 1
            os.remove(link)
            with open(secret, encoding="utf-8") as file:
                self.assertEqual(file.read(), SECRET)
        self.assertGreater(in_time, 1)

    def test_files_of_reports_are_no_links(self):
        folder = os.path.join(self.folder, "results", "a")
        secret = os.path.join(self.top.name, "secret.yaml")
        write(folder, "results.h5", "")
        write(folder, "report.html", "a report")
        write(folder, "report_fields/film.js", "fields")
        url = self.server.post("/api/runs/results:a:results.h5/report").json["url"]
        self.assertEqual([self.server.get(url + name, token=False).text for name in ("", "report_fields/film.js")], ["a report", "fields"])
        os.symlink(secret, os.path.join(folder, "report_fields", "link.js"))
        os.rename(os.path.join(folder, "report.html"), os.path.join(folder, "old.html"))
        os.symlink(secret, os.path.join(folder, "report.html"))
        for name in ("report_fields/link.js", ""):
            answer = self.server.get(url + name, token=False)
            self.assertNotIn(SECRET.encode(), answer.body)
            self.refused(answer, 404, "not known")
        os.rename(os.path.join(folder, "report_fields"), os.path.join(self.top.name, "elsewhere"))
        os.symlink(os.path.join(self.top.name, "elsewhere"), os.path.join(folder, "report_fields"))
        self.refused(self.server.get(url + "report_fields/film.js", token=False), 404, "not known")

    def test_names_that_are_no_text_are_left_out(self):
        for name in (b"\xed\xa0\x80.yaml", b"\xe0\x80\xaf.yaml", b"\xf4\x90\x80\x80.yaml", b"\xff.yaml"):
            with open(os.path.join(os.fsencode(self.folder), name), "wb") as file:
                file.write(MODEL.encode())
        time.sleep(1.2)  # two looks at the folder
        self.assertEqual([file["path"] for file in self.server.get("/api/files").json["files"]], ["model.yaml"])
        events = Events(self.server)
        self.addCleanup(events.close)
        write(self.folder, "\U0001f600.yaml", MODEL)
        self.assertEqual(events.next()[1:], ("files", {"paths": ["\U0001f600.yaml"]}))

    def test_hostile_files_of_runs_are_left_out(self):
        with subprocess.Popen(["sleep", "60"]) as victim:
            self.addCleanup(victim.kill)
            run = os.path.join(self.folder, "runs", "evil-001")
            write(run, "results.checkpoint", "")
            write(run, "run.json", json.dumps({"model": "model.yaml", "set": [], "process": {"pid": victim.pid, "start": start_of(victim.pid)}}))
            time.sleep(0.6)  # until the run is followed
            events = Events(self.server)
            self.addCleanup(events.close)
            deep = "[" * 300_000 + "]" * 300_000
            good = '{"kind":"stepped","t":1}\n'
            for line in (f'{{"kind":"stepped","x":{deep}}}\n', '{"kind":"stepped","x":"' + "x" * 3_000_000 + '"}\n', "x" * 3_000_000 + "\n"):
                with open(os.path.join(run, "events.ndjson"), "a", encoding="utf-8") as file:
                    file.write(line + good)
                while (event := events.next())[1] != "run":
                    pass
                self.assertEqual(event[2], {"kind": "stepped", "t": 1, "id": "evil-001"})
            victim.kill()
        write(run, "run.json", f'{{"model": "model.yaml", "set": [], "x": {deep}}}')
        for method, call in (("GET", "/api/runs"), ("POST", "/api/runs/evil-001/resume"), ("POST", "/api/runs/evil-001/stop")):
            self.assertEqual(self.server.request(method, call).status, 200 if method == "GET" else 409)
        self.assertTrue(self.server.is_alive())

    def test_large_bodies_are_refused(self):
        body = b"x" * 100_000_000
        begin = time.time()
        self.refused(self.server.request("POST", "/api/check", body), 413, "bytes")
        self.refused(self.server.request("PUT", "/api/file?path=model.yaml", b"", headers={"Content-Length": "9" * 18, "If-Match": "*"}),
                     413, "bytes")
        self.assertLess(time.time() - begin, 15)
        with open(f"/proc/{self.server.process.pid}/status", encoding="ascii") as status:
            peak = next(int(line.split()[1]) for line in status if line.startswith("VmHWM:"))
        self.assertLess(peak, 90_000)  # [kB]: the body was not stored
        for name, value, status in (("Content-Length", "-1", 411), ("Content-Length", "1e9", 411), ("Content-Length", "0x10", 411),
                                    ("Transfer-Encoding", "chunked", 411), ("Content-Encoding", "gzip", 415)):
            with self.subTest(header=name, value=value):
                answer = self.server.request("POST", "/api/check", b"{}", headers={name: value})
                self.assertEqual(answer.status, status)
                self.assertTrue(self.server.is_alive())
        self.assertEqual(self.server.file("model.yaml").text, MODEL)
        self.logged("413 POST /api/check")

    def test_requests_behind_a_refused_one_are_not_read(self):
        # Its unread body would be taken for the next request.
        head = f"Host: 127.0.0.1:{self.server.port}\r\n"
        inner = f"GET /api/hello HTTP/1.1\r\n{head}Authorization: Bearer {self.server.token}\r\n\r\n"
        answer = raw(self.server.port, (f"POST /api/check HTTP/1.1\r\n{head}Content-Length: {len(inner)}\r\n\r\n{inner}").encode())
        self.assertEqual(answer.count(b"HTTP/1.1 "), 1)
        self.assertIn(b"connection: close", answer.lower())

    def test_malformed_requests_end_their_connection_only(self):
        port = self.server.port
        for data in (b"\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"\0" * 5000,
                     b"G" * 200_000, b"GET /" + b"a" * 100_000 + b" HTTP/1.1\r\n\r\n", b"GET /?" + b"a=b&" * 4000 + b" HTTP/1.1\r\n\r\n",
                     b"GET / HTTP/1.1\r\n" + b"X: " + b"y" * 500_000 + b"\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 50_000 + b"\r\n",
                     b"GET / HTTP/1.1\r\nHost: 127.0.0.1:1\r\nRange: bytes=" + b"0-,"*1000 + b"\r\n\r\n",
                     b"GET /%00%ff%zz HTTP/1.1\r\nHost: 127.0.0.1:1\r\n\r\n", b"DELETE / HTTP/1.1\r\nHost: 127.0.0.1:1\r\n\r\n",
                     b"OPTIONS * HTTP/1.1\r\nHost: 127.0.0.1:1\r\n\r\n", b"TRACE / HTTP/1.1\r\nHost: 127.0.0.1:1\r\n\r\n",
                     b"GET http://evil.example/ HTTP/1.1\r\nHost: evil.example\r\n\r\n"):
            with self.subTest(data=data[:40]):
                answer = raw(port, data)
                self.assertNotIn(b" 200 ", answer[:20]) if b"Range" not in data else None
                self.assertTrue(self.server.is_alive())
        for path in ("/", "/api/hello"):
            with self.subTest(path=path):
                long = self.server.get(path + "?" + "x" * 8000)
                self.assertIn(long.status, (200, 414))
        self.assertNotIn("\0", self.server.log())

    def test_slow_clients_are_cut_off_and_others_served(self):
        port = self.server.port
        head = f"POST /api/check HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nAuthorization: Bearer {self.server.token}\r\n"
        slow = {"head": head.encode(), "body": (head + "Content-Length: 1000\r\n\r\n").encode(), "line": b"GET /"}
        begin = time.time()
        connections = {}
        self.addCleanup(lambda: [connection.close() for connection in connections.values()])
        for name, first in slow.items():
            connection = socket.create_connection(("127.0.0.1", port), timeout=0.01)
            connection.sendall(first)
            connections[name] = connection
        ended = {}
        longest = 0
        while connections and time.time() - begin < 15:
            for name, connection in list(connections.items()):
                try:
                    connection.sendall(b"a")  # a byte now and then would keep deadlines of single bytes from ever passing
                    if connection.recv(4096) == b"":
                        raise ConnectionResetError
                except socket.timeout:
                    continue
                except OSError:
                    ended[name] = time.time() - begin
                    connection.close()
                    del connections[name]
            asked = time.time()
            self.assertEqual(self.server.get("/api/hello").status, 200)
            longest = max(longest, time.time() - asked)
            time.sleep(0.2)
        self.assertEqual(sorted(ended), ["body", "head", "line"])
        for name, seconds in ended.items():
            self.assertGreater(seconds, 8, name)   # [s]: a slow line of honest users is not cut off at once
            self.assertLess(seconds, 12.5, name)  # 10 s, and how long the client takes to see it
        self.assertLess(longest, 1)

    def test_a_thousand_connections(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, 4096), hard))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        connections = []
        self.addCleanup(lambda: [connection.close() for connection in connections])
        for number in range(1000):
            connection = socket.create_connection(("127.0.0.1", self.server.port), timeout=5)
            connections.append(connection)
            if number % 3 == 0:
                connection.sendall(b"GET / HTTP/1.1\r\n")
        for _ in range(5):
            begin = time.time()
            self.assertTrue(self.server.is_alive())
            self.assertLess(time.time() - begin, 1)
        with open(f"/proc/{self.server.process.pid}/status", encoding="ascii") as status:
            threads = next(int(line.split()[1]) for line in status if line.startswith("Threads:"))
        self.assertLess(threads, 250)
        for connection in connections:
            connection.close()
        self.assertTrue(self.server.is_alive())

    def test_who_takes_a_report_slowly_keeps_nobody_out(self):
        write(self.folder, "results/a/results.h5", "")
        write(self.folder, "results/a/report.html", "x" * 500_000)
        url = self.server.post("/api/runs/results:a:results.h5/report").json["url"]
        connections = []
        self.addCleanup(lambda: [connection.close() for connection in connections])
        ask = f"GET {url} HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\n\r\n".encode()
        for _ in range(220):  # more than it has threads
            connection = socket.socket()
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            connection.connect(("127.0.0.1", self.server.port))
            connection.sendall(ask * 10)  # more than the system takes off the server
            connections.append(connection)
            connection.recv(1)  # it is being served
        for _ in range(5):
            begin = time.time()
            self.assertEqual(self.server.get("/api/hello").status, 200)
            self.assertLess(time.time() - begin, 1)

    def test_broken_event_streams_are_forgotten(self):
        for _ in range(3):
            streams = []
            refused = 0
            for _ in range(60):
                stream = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=5)
                stream.request("GET", "/api/events", headers={"Authorization": "Bearer " + self.server.token})
                reply = stream.getresponse()
                refused += reply.status == 503
                streams.append((stream, reply))
            self.assertGreater(refused, 0)
            self.assertLess(refused, 60)
            self.assertTrue(self.server.is_alive())
            for stream, reply in streams:
                reset(stream.sock)
            time.sleep(0.6)  # three times what a stream needs to notice
        events = Events(self.server)
        self.addCleanup(events.close)
        self.assertEqual(events.reply.status, 200)
        self.assertTrue(self.server.is_alive())

    def test_names_with_scripts_stay_names(self):
        name = "<img src=x onerror=alert(1)>.yaml"
        text = "hersey: 1\ntitle: \"</script><script>alert(1)</script>\"\n"
        write(self.folder, name, text)
        files = self.server.get("/api/files")
        self.assertEqual(files.headers["content-type"], "application/json")
        self.assertEqual([file["path"] for file in files.json["files"]], [name, "model.yaml"])
        read = self.server.file(name)
        self.assertEqual(read.text, text)
        self.assertTrue(read.headers["content-type"].startswith("text/plain"))
        for answer in (files, read, self.server.get("/"), self.server.get("/<script>alert(1)</script>")):
            self.assertEqual(answer.headers["x-content-type-options"], "nosniff")
            policy = answer.headers["content-security-policy"]
            self.assertIn("default-src 'none'", policy)
            self.assertIn("script-src 'self';", policy)
            self.assertIn("frame-ancestors 'none'", policy)
            self.assertEqual(answer.headers["referrer-policy"], "no-referrer")
            self.assertEqual(answer.headers["cache-control"], "no-store")
        checked = self.server.post("/api/check", {"path": name, "text": "hersey: 1\n<script>: 1\n"})
        self.assertEqual(checked.headers["content-type"], "application/json")

    def test_the_page_has_no_inline_scripts(self):
        page = self.server.get("/", token=False)
        self.assertEqual(page.status, 200)
        self.assertNotRegex(page.text, r"<script(?![^>]*\bsrc=)[^>]*>")
        self.assertNotRegex(page.text, r"\son[a-z]+=")
        self.assertNotIn(self.server.token, page.text)
        for path in ("/workbench.js", "/workbench.css"):
            self.assertEqual(self.server.get(path, token=False).status, 200)

    def test_nothing_is_written_by_looking(self):
        before = sorted(os.walk(self.folder))
        self.server.get("/")
        for call in ("hello", "files", "file?path=model.yaml", "schema", "templates", "examples", "runs"):
            self.assertEqual(self.server.get("/api/" + call).status, 200, call)
        self.assertEqual(self.server.post("/api/check", {"path": "model.yaml", "text": "hersey: 1\n"}).status, 200)
        events = Events(self.server)
        time.sleep(0.8)
        events.close()
        self.assertEqual(sorted(os.walk(self.folder)), before)

    def test_arguments_of_programs_do_not_have_the_token(self):
        fake = os.path.join(self.top.name, "bin")
        write(fake, "xdg-open", f'#!/bin/sh\necho "$@" > {self.top.name}/opened\ncp "$1" {self.top.name}/page\n')
        os.chmod(os.path.join(fake, "xdg-open"), 0o755)
        # The server's own environment: a display and this browser.
        saved = dict(os.environ)
        os.environ.update(PATH=fake + ":" + os.environ["PATH"], DISPLAY=":99", XDG_RUNTIME_DIR=self.top.name)
        try:
            from subprocess import PIPE, Popen  # pylint: disable=import-outside-toplevel
            process = Popen([PROGRAM, "open", self.folder], stdout=PIPE, stderr=PIPE, text=True)
        finally:
            os.environ.clear()
            os.environ.update(saved)
        address = process.stdout.readline().strip()
        end = time.time() + 5
        while not os.path.exists(os.path.join(self.top.name, "page")) and time.time() < end:
            time.sleep(0.05)
        time.sleep(0.1)
        process.terminate()
        process.communicate(timeout=10)
        with open(os.path.join(self.top.name, "opened"), encoding="utf-8") as file:
            opened = file.read().strip()
        self.assertNotIn(address.split("token=")[1], opened)
        self.assertFalse(os.path.exists(opened), "the page that leads to the address is removed at the end")
        with open(os.path.join(self.top.name, "page"), encoding="utf-8") as file:
            self.assertIn(address, file.read())


if __name__ == "__main__":
    unittest.main()
