"""The folder of a study: what has been done, safe against being killed at any time."""

import errno
import fcntl
import hashlib
import json
import os


class FolderError(Exception):
    """A folder that cannot be used, in words for the user."""


def identity(study, texts):
    """What a run is: model, overrides, values and program. Two runs with the same identity have the same answer."""
    values = sorted(f"{p['name']}={t}" for p, t in zip(study["parameters"], texts))
    # Keys of figures that a run tells beside the usual ones belong to it: a record without them is no answer.
    wanted = sorted(study["wanted"]) if study["analysis"] == "simulation" else sorted(study["bearings_wanted"])
    parts = [study["fingerprint"], study["version"], study["analysis"], study.get("runner", ""), *study["set"], "|",
             *values, "|", *wanted]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:20]


class Folder:
    """`records.jsonl`: a line per finished run, appended in one write; `figures.json`: what figures are."""

    def __init__(self, path, lock=True):
        self.path = os.path.abspath(path)
        try:
            os.makedirs(os.path.join(self.path, "runs"), exist_ok=True)
            self._lock = open(os.path.join(self.path, "lock"), "a", encoding="utf-8")
            if lock:
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise FolderError(f"{self.path}: another study is at work in this folder; wait for it, or name another "
                              "with --out") from None
        except OSError as error:
            raise FolderError(f"{error.filename or self.path}: {error.strerror}; expected a folder to write to") from None
        self.records = os.path.join(self.path, "records.jsonl")
        self._file = None
        self.units = self._read_json("figures.json", {})

    def file(self, *names):
        return os.path.join(self.path, *names)

    def _read_json(self, name, default):
        try:
            with open(self.file(name), encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError):
            return default

    def write_json(self, name, data):
        """Replaces a file as a whole: it is the old one or the new one, whatever happens."""
        path = self.file(name)
        with open(path + ".new", "w", encoding="utf-8") as file:
            file.write(json.dumps(data) + "\n")  # not json.dump, which is ten times slower
            file.flush()
            os.fsync(file.fileno())
        os.replace(path + ".new", path)

    def files_of_records(self):
        """Own records, and those that tasks of a cluster have written."""
        shards = self.file("shards")
        names = sorted(os.listdir(shards)) if os.path.isdir(shards) else []
        return [self.records, *(os.path.join(shards, name) for name in names if name.endswith(".jsonl"))]

    def read(self):
        """Every record, one at a time; lines that a kill or a full disk has torn are no records."""
        for path in self.files_of_records():
            try:
                file = open(path, "rb")
            except FileNotFoundError:
                continue
            with file:
                for line in file:
                    try:
                        record = json.loads(line)
                    except ValueError:
                        continue
                    if not line.endswith(b"\n") or not isinstance(record, dict):
                        continue
                    if "describe" in record:
                        self.units.update(record["describe"])
                    elif "run" in record and "status" in record:
                        yield record

    def done(self, failed_too=True):
        """Identities of finished runs; of a run with several records the last counts."""
        status = {record["run"]: record["status"] for record in self.read()}
        return {run for run, how in status.items() if how == "completed" or (failed_too and how == "failed")}

    def add(self, record):
        """Appends one record. After a full disk a torn line is closed before the next one."""
        if self._file is None:
            self._file = open(self.records, "ab+", buffering=0)
            size = self._file.seek(0, os.SEEK_END)
            if size:
                self._file.seek(size - 1)
                if self._file.read(1) != b"\n":
                    self._file.write(b"\n")
        line = (json.dumps(record) + "\n").encode()
        written = self._file.write(line)
        if written != len(line):
            raise OSError(errno.ENOSPC, "no room for a record: the disk or the quota is full", self.records)

    def describe(self, figures):
        self.units.update(figures)
        self.add({"describe": figures})

    def close(self):
        if self._file is not None:
            self._file.close()
        self._lock.close()
