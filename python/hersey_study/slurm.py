"""A study on a cluster: job arrays of chunks, whose tasks append to files of the study's folder.

The folder is the truth, not the queue: what has no record when no task is left is sent again.
"""

import json
import os
import shlex
import shutil
import subprocess
import time

from .study import StudyError
from .workers import command_of

# Seconds between looks at the queue.
LOOK = 1.0
# Rounds in a row that may end without a single new record: then something is wrong that sending again does not mend.
MOST_IDLE_ROUNDS = 3
# Runs of a task, unless asked for: starting one costs a second, so it should last longer than that.
RUNS_PER_TASK = 50
# Seconds for which a controller that does not answer is waited for.
PATIENCE = 600.0
# Seconds without a task at work after which the reason is reported; the environment's are the tests'.
QUIET = float(os.environ.get("HERSEY_STUDY_PATIENCE", "30"))


def _call(command, *, patience=0.0, tell=None):
    """Standard output of a Slurm command; waits for a controller that is away."""
    began = time.monotonic()
    while True:
        try:
            result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
            text = (result.stderr or result.stdout).strip()
            if result.returncode == 0:
                return result.stdout
        except FileNotFoundError:
            raise StudyError(f"--on slurm: {command[0]} is not installed here; expected a login node of the cluster, or "
                             "--on local") from None
        except subprocess.TimeoutExpired:
            text = f"{command[0]}: Unable to contact slurm controller: no answer for 120 s"
        if "nvalid partition" in text:
            known = " ".join(_call(["sinfo", "-h", "-o", "%R"]).split())
            raise StudyError(f"--partition: the cluster has no such partition; expected one of: {known}")
        if not _is_away(text):
            raise StudyError(f"--on slurm: {text}")
        if time.monotonic() - began > patience:
            raise StudyError(f"--on slurm: the cluster cannot be reached: {text.splitlines()[-1]}; every finished run is "
                             "kept, and the same command goes on when it is back")
        if tell:
            tell("the cluster does not answer, waiting for it")
            tell = None
        time.sleep(LOOK)


def _is_away(text):
    return any(word in text.lower() for word in ("unable to contact", "connection refused", "timed out", "communication",
                                                 "could not resolve", "configuration error", "configuration source", "unable to establish"))


class Array:
    """A job array under way."""

    def __init__(self, study, requests, args, number):
        folder, settings = study.folder, study.settings
        chunk = args.chunk or max(1, min(RUNS_PER_TASK, -(-len(requests) // (4 * (args.jobs or os.cpu_count() or 1)))))
        chunks = [requests[i:i + chunk] for i in range(0, len(requests), chunk)]
        self.name = f"hersey-{os.getpid()}-{number}"
        place = folder.file("tasks", self.name)
        os.makedirs(place, exist_ok=True)
        os.makedirs(folder.file("shards"), exist_ok=True)
        for k, some in enumerate(chunks):
            with open(os.path.join(place, f"{k}.jsonl"), "w", encoding="utf-8") as file:
                file.writelines(json.dumps(request) + "\n" for request in some)
        worker = [word for word in command_of(settings) if word != "--end-with-parent"]
        script = os.path.join(place, "task.sh")
        shard = f'{shlex.quote(folder.file("shards"))}/{self.name}-$SLURM_ARRAY_TASK_ID.jsonl'
        with open(script, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\nexport OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1\n"
                       f"exec {shlex.join(worker)} < {shlex.quote(place)}/$SLURM_ARRAY_TASK_ID.jsonl >> {shard}\n")
        os.chmod(script, 0o755)
        limit = f"%{args.jobs}" if args.jobs else ""
        command = ["sbatch", "--parsable", "--job-name", self.name, "--array", f"0-{len(chunks) - 1}{limit}", "--ntasks", "1",
                   "--cpus-per-task", "1", "--no-requeue", "--output", os.path.join(place, "%a.log"),
                   *(["--partition", args.partition] if args.partition else []), script]
        self.job = _call(command, patience=PATIENCE, tell=study.tell).strip().split(";")[0]
        self.place = place
        self._at_work, self._reported = time.monotonic(), ""

    def is_under_way(self, study):
        """Whether it has tasks left. Tells why where none of them has been at work for a while."""
        out = _call(["squeue", "-h", "-n", self.name, "-o", "%T %r"], patience=PATIENCE, tell=study.tell)
        states = [line.split(" ", 1) for line in out.splitlines() if line.strip()]
        now = time.monotonic()
        if any(state[0] != "PENDING" for state in states) or not states:
            self._at_work, self._reported = now, ""
        elif now - self._at_work > QUIET and states[0][-1] != self._reported:
            self._reported = states[0][-1]
            study.tell(f"no task is at work; the cluster says: {self._reported}")
        return bool(states)

    def cancel(self):
        if shutil.which("scancel"):
            subprocess.run(["scancel", "-n", self.name], capture_output=True, check=False)


class Watch:
    """Records that appear in the files of tasks, each reported once."""

    def __init__(self, folder):
        self.folder, self.read = folder, {}
        for path in folder.files_of_records():
            self.read[path] = os.path.getsize(path) if os.path.exists(path) else 0

    def news(self):
        for path in self.folder.files_of_records():
            if not os.path.exists(path):
                continue
            with open(path, "rb") as file:
                file.seek(self.read.get(path, 0))
                data = file.read()
            whole = data.rfind(b"\n") + 1
            self.read[path] = self.read.get(path, 0) + whole
            for line in data[:whole].splitlines():
                try:
                    yield json.loads(line)
                except ValueError:
                    continue  # torn by a full disk: the run has no record and is sent again


def run(study, texts, args):
    """Has all runs done that are not yet, in rounds until none is missing or nothing gets on any more."""
    study.tell = lambda text: study.table._print(f"hersey: {text}\n")
    _call(["sinfo", "-h", "-o", "%R"])
    idle, number, again = 0, 0, args.again
    while True:
        requests = list(study.missing(texts, again))
        again = False
        if not requests:
            return
        values = {request["run"]: request["values"] for request in requests}
        watch = Watch(study.folder)
        array = Array(study, requests, args, number)
        number += 1
        study.tell(f"{len(requests)} runs sent to the cluster, job {array.job}")
        came = 0
        try:
            under_way = True
            while under_way:
                time.sleep(LOOK)
                under_way = array.is_under_way(study)
                for record in watch.news():
                    if "describe" in record:
                        study.folder.units.update(record["describe"])
                    elif record.get("run") in values:
                        came += 1
                        if record["status"] == "completed":
                            study.check_names(record)
                        study.table.add({**record, "values": values[record["run"]]})
        except BaseException:
            array.cancel()
            raise
        idle = 0 if came else idle + 1
        left = sum(1 for _ in study.missing(texts, False))
        if left:
            study.tell(f"{left} runs have no record: their tasks were cancelled or lost, or had no room to write")
        if left and idle >= MOST_IDLE_ROUNDS:
            raise StudyError(f"the cluster ends tasks without a single answer, {idle} times in a row; what they say is in "
                             f"{array.place}: {_last_words(array.place)}")


def _last_words(place):
    for name in sorted(os.listdir(place)):
        if name.endswith(".log"):
            with open(os.path.join(place, name), encoding="utf-8", errors="replace") as file:
                lines = file.read().strip().splitlines()
            if lines:
                return lines[-1]
    return "nothing"
