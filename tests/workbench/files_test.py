"""Files edited by `hersey open`: nothing is lost, whoever else writes and whatever fails.

    files_test.py HERSEY [Class.test_name]
"""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from workbench_client import Events, Workbench, write  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1))
MODEL = "# my bearing\nhersey: 1\ntitle: a model\n"
NOBODY = 65534


def content(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


class Files(unittest.TestCase):
    def setUp(self):
        self.top = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(self.top.cleanup)
        self.folder = os.path.join(self.top.name, "models")
        write(self.folder, "model.yaml", MODEL)

    def open(self, path=None, **more):
        log = os.path.join(self.top.name, f"log{len(os.listdir(self.top.name))}")
        server = Workbench(PROGRAM, path or self.folder, log, **more)
        self.addCleanup(server.stop)
        return server

    def test_a_file_comes_back_as_it_was_written(self):
        server = self.open()
        for name, text in (("new.yaml", "a: 1\r\n\tb: ü €\n"), ("sub/deep/er.csv", "x,y\n1,2"), ("empty.yaml", ""), ("ümlaut und Raum.yaml", MODEL),
                           ("large.csv", "1.5,2.5\n" * 1_000_000)):
            with self.subTest(name=name):
                made = server.put(name, text)
                self.assertEqual((made.status, made.body), (204, b""))
                read = server.file(name)
                self.assertEqual((read.text, read.headers["etag"]), (text, made.headers["etag"]))
                self.assertEqual(content(self.folder, name).encode(), text.replace("\r\n", "\n").encode())
                changed = server.put(name, text + "# more\n", etag=read.headers["etag"])
                self.assertEqual(changed.status, 204)
                self.assertNotEqual(changed.headers["etag"], read.headers["etag"])
                self.assertEqual(server.file(name).text, text + "# more\n")
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(".")], [])

    def test_rights_and_links_of_a_file_stay(self):
        server = self.open()
        os.chmod(os.path.join(self.folder, "model.yaml"), 0o640)
        os.symlink("model.yaml", os.path.join(self.folder, "other.yaml"))
        etag = server.file("other.yaml").headers["etag"]
        self.assertEqual(server.put("other.yaml", MODEL * 2, etag=etag).status, 204)
        self.assertTrue(os.path.islink(os.path.join(self.folder, "other.yaml")))
        self.assertEqual(content(self.folder, "model.yaml"), MODEL * 2)
        self.assertEqual(os.stat(os.path.join(self.folder, "model.yaml")).st_mode & 0o777, 0o640)

    def test_kinds_of_files(self):
        for name, text in (("bearing.yaml", "bearings:\n"), ("notes.yaml", "some: notes\n"), ("load.csv", "1\n"), ("rod.msh", ""), ("rod.inp", ""),
                           ("results/a/results.h5", ""), ("results/a/report.html", ""), ("README.md", ""), ("x.bin", ""),
                           (".git/config", ""), ("a/b/c/d/in.yaml", MODEL), ("a/b/c/d/e/out.yaml", MODEL)):
            write(self.folder, name, text)
        files = {file["path"]: file["kind"] for file in self.open().get("/api/files").json["files"]}
        self.assertEqual(files, {"bearing.yaml": "model", "model.yaml": "model", "notes.yaml": "text", "load.csv": "table", "rod.msh": "mesh",
                                 "rod.inp": "mesh", "results/a/results.h5": "results", "results/a/report.html": "report", "README.md": "text",
                                 "x.bin": "other", "a/b/c/d/in.yaml": "model"})

    def test_a_list_of_many_files_has_an_end(self):
        for number in range(2100):
            write(self.folder, f"many/{number:04d}.csv", "")
        server = self.open()
        begin = time.time()
        self.assertEqual(len(server.get("/api/files").json["files"]), 2000)
        self.assertLess(time.time() - begin, 2)

    def test_a_file_that_another_editor_has_changed_is_not_overwritten(self):
        server = self.open()
        etag = server.file("model.yaml").headers["etag"]
        theirs = MODEL + "# theirs\n"
        write(self.folder, "model.yaml", theirs)
        answer = server.put("model.yaml", MODEL + "# mine\n", etag=etag)
        self.assertEqual(answer.status, 412)
        self.assertEqual(answer.json["text"], theirs)
        self.assertEqual(content(self.folder, "model.yaml"), theirs)
        self.assertEqual(server.put("model.yaml", MODEL + "# both\n", etag=answer.json["etag"]).status, 204)
        self.assertEqual(content(self.folder, "model.yaml"), MODEL + "# both\n")

    def test_a_new_file_overwrites_none(self):
        server = self.open()
        answer = server.put("model.yaml", "mine")
        self.assertEqual((answer.status, answer.json["text"]), (412, MODEL))
        self.assertEqual(content(self.folder, "model.yaml"), MODEL)
        self.assertEqual(server.post("/api/new", {"template": "bearing", "path": "model.yaml"}).status, 409)
        self.assertEqual(content(self.folder, "model.yaml"), MODEL)
        self.assertEqual(server.request("PUT", "/api/file?path=model.yaml", "mine").status, 428)
        self.assertEqual(content(self.folder, "model.yaml"), MODEL)

    def test_a_file_that_is_gone_is_not_made_again_by_chance(self):
        server = self.open()
        etag = server.file("model.yaml").headers["etag"]
        os.remove(os.path.join(self.folder, "model.yaml"))
        self.assertEqual(server.put("model.yaml", "mine", etag=etag).status, 404)
        self.assertEqual(os.listdir(self.folder), [])

    def test_of_two_tabs_one_wins_and_the_other_knows(self):
        servers = [self.open(), self.open()]  # two servers on one folder are as good as two tabs
        etag = servers[0].file("model.yaml").headers["etag"]
        statuses = {}

        def save(number):
            statuses[number] = servers[number % 2].put("model.yaml", f"text of {number}\n", etag=etag).status

        threads = [threading.Thread(target=save, args=(number,)) for number in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        winners = [number for number, status in statuses.items() if status == 204]
        self.assertEqual(sorted(set(statuses.values())), [204, 412])
        self.assertIn(content(self.folder, "model.yaml"), [f"text of {number}\n" for number in winners])
        # In one server saves come one at a time.
        for parity in (0, 1):
            self.assertLessEqual(len([number for number in winners if number % 2 == parity]), 1)

    def test_readers_find_whole_files_only(self):
        server = self.open()
        texts = ["a" * 300_000, "b" * 200_000]
        etag = server.put("model2.yaml", texts[0]).headers["etag"]
        stop = threading.Event()
        torn = []

        def read():
            while not stop.is_set():
                text = content(self.folder, "model2.yaml")
                if text not in texts:
                    torn.append(len(text))

        reader = threading.Thread(target=read)
        reader.start()
        for number in range(1, 20):
            etag = server.put("model2.yaml", texts[number % 2], etag=etag).headers["etag"]
        stop.set()
        reader.join()
        self.assertEqual(torn, [])

    def test_a_full_disk_leaves_the_old_file_whole(self):
        limit = 100_000

        def full():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        server = self.open(preexec=full)
        etag = server.file("model.yaml").headers["etag"]
        answer = server.put("model.yaml", "x" * 2 * limit, etag=etag)
        self.assertEqual(answer.status, 507)
        self.assertIn("the old file is whole", answer.json["error"])
        self.assertIn("make room", answer.json["advice"])
        self.assertEqual(content(self.folder, "model.yaml"), MODEL)
        self.assertEqual(server.put("new.yaml", "x" * 2 * limit).status, 507)
        self.assertEqual(os.listdir(self.folder), ["model.yaml"])
        # With room again, the same text is saved.
        self.assertEqual(server.put("model.yaml", "x" * (limit // 2), etag=etag).status, 204)

    def test_a_read_only_folder_is_shown_and_not_written(self):
        def nobody():
            if os.getuid() == 0:  # root writes everywhere
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)

        os.chmod(self.top.name, 0o755)
        os.chmod(self.folder, 0o555)
        self.addCleanup(os.chmod, self.folder, 0o755)
        server = self.open(preexec=nobody)
        read = server.file("model.yaml")
        self.assertEqual(read.text, MODEL)
        for answer in (server.put("model.yaml", "mine", etag=read.headers["etag"]), server.put("new.yaml", "mine"),
                       server.post("/api/runs", {"path": "model.yaml"})):
            self.assertEqual(answer.status, 403, answer.body)
            self.assertTrue(answer.json["advice"])
        self.assertEqual(os.listdir(self.folder), ["model.yaml"])
        self.assertEqual(content(self.folder, "model.yaml"), MODEL)
        # A file without the right to write in a folder with it is protected as well.
        os.chmod(self.folder, 0o777)
        os.chmod(os.path.join(self.folder, "model.yaml"), 0o444)
        self.assertEqual(server.put("model.yaml", "mine", etag=read.headers["etag"]).status, 403)
        self.assertEqual(server.put("new.yaml", "mine").status, 204)

    def test_what_is_no_file_is_neither_read_nor_waited_for(self):
        os.mkfifo(os.path.join(self.folder, "pipe.yaml"))
        os.mkdir(os.path.join(self.folder, "folder.yaml"))
        write(self.folder, "huge.csv", "")
        os.truncate(os.path.join(self.folder, "huge.csv"), 40_000_000)
        with open(os.path.join(self.folder, "binary.yaml"), "wb") as file:
            file.write(bytes(range(256)))
        server = self.open()
        self.assertEqual(server.file("pipe.yaml").status, 403)
        self.assertEqual(server.file("folder.yaml").status, 403)
        self.assertEqual(server.file("huge.csv").status, 413)
        # What is no text would be damaged when it is saved.
        etag = server.file("model.yaml").headers["etag"]
        for answer in (server.file("binary.yaml"), server.put("binary.yaml", "mine", etag=etag), server.put("binary.yaml", "mine")):
            self.assertEqual(answer.status, 415, answer.body)
            self.assertIn("binary.yaml is not UTF-8", answer.json["error"])
        with open(os.path.join(self.folder, "binary.yaml"), "rb") as file:
            self.assertEqual(file.read(), bytes(range(256)))
        self.assertEqual(server.file("missing.yaml").status, 404)
        self.assertNotIn("pipe.yaml", [file["path"] for file in server.get("/api/files").json["files"]])

    def test_changes_by_others_are_told(self):
        server = self.open()
        events = Events(server)
        self.addCleanup(events.close)
        time.sleep(0.6)
        write(self.folder, "model.yaml", MODEL + "# theirs\n")
        number, name, data = events.next()
        self.assertEqual((name, data), ("files", {"paths": ["model.yaml"]}))
        write(self.folder, "b.csv", "1\n")
        self.assertEqual(events.next()[2], {"paths": ["b.csv"]})
        os.remove(os.path.join(self.folder, "b.csv"))
        last = events.next()
        self.assertEqual(last[2], {"paths": ["b.csv"]})
        # A page that was away gets what it has missed, and nothing twice.
        again = Events(server, after=number)
        self.addCleanup(again.close)
        self.assertEqual([again.next()[0], again.next()[0]], [number + 1, last[0]])
        ahead = Events(server, after=10_000)
        self.addCleanup(ahead.close)
        self.assertEqual(ahead.next()[:2], (last[0], "reload"))

    def test_the_command_line_works_beside_it(self):
        shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cli/bearing.yaml"), self.folder)
        server = self.open()
        ran = subprocess.run([PROGRAM, "run", "bearing.yaml"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        runs = server.get("/api/runs").json["runs"]
        self.assertEqual([(run["results"], run["state"]) for run in runs], [(["results/bearing/results.h5"], "completed")])
        report = server.post(f"/api/runs/{runs[0]['id']}/report")
        self.assertEqual(server.get(report.json["url"]).body, content(self.folder, "results/bearing/report.html").encode())

    def test_a_model_is_opened_with_its_folder(self):
        server = self.open(os.path.join(self.folder, "model.yaml"))
        hello = server.get("/api/hello").json
        self.assertEqual((hello["folder"], hello["open"]), (self.folder, "model.yaml"))
        for path in ("missing.yaml", "missing/"):
            ended = subprocess.run([PROGRAM, "open", "--no-browser", os.path.join(self.folder, path)], capture_output=True, text=True, check=False)
            self.assertEqual(ended.returncode, 2)
            self.assertIn("no such file or folder", ended.stderr)

    def test_a_port_that_is_taken_is_named(self):
        server = self.open()
        ended = subprocess.run([PROGRAM, "open", "--no-browser", "--port", str(server.port), self.folder], capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 1)
        self.assertIn(f"port {server.port}", ended.stderr)
        self.assertTrue(server.is_alive())
        self.assertEqual(server.stop(), 0)
        # A port is free again at once.
        again = Workbench(PROGRAM, self.folder, os.path.join(self.top.name, "log"), "--port", str(server.port))
        self.addCleanup(again.stop)
        self.assertEqual(again.port, server.port)


if __name__ == "__main__":
    unittest.main()
