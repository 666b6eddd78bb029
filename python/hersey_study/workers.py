"""Programs that answer runs: lines of JSON to and from processes that stay."""

import json
import os
import selectors
import shlex
import subprocess

# Runs that a process has been given at once: it need not wait for the next one to be sent.
AHEAD = 2

# Of a pipe at a time, as much as one holds; more would be memory that is taken and given back with every answer.
READ_BYTES = 1 << 16


class RunnerError(Exception):
    """A runner that cannot be used, in words for the user."""


class Worker:
    """One process and the runs that it has been given."""

    def __init__(self, command, number):
        self.number = number
        self.given = {}
        self._buffer = b""
        try:
            self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            start_new_session=True, bufsize=0)
        except OSError as error:
            raise RunnerError(f"{command[0]}: {error.strerror}; expected a program that answers runs") from None

    def give(self, request):
        self.given[request["run"]] = request
        try:
            self.process.stdin.write((json.dumps(request) + "\n").encode())
        except BrokenPipeError:
            pass  # it has ended: that is noticed where its answers are read

    def answers(self):
        """Lines that have come; None at the end of the process."""
        data = os.read(self.process.stdout.fileno(), READ_BYTES)
        if not data:
            return None
        lines = (self._buffer + data).split(b"\n")
        self._buffer = lines.pop()
        return lines

    def end(self):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


def command_of(study):
    """The process that answers the runs of `study`."""
    if study.get("runner"):
        return shlex.split(study["runner"])
    command = [study["program"], "study-task", study["model"], "--analysis", study["analysis"], "--end-with-parent"]
    for change in study["set"]:
        command += ["--set", change]
    for name in study["wanted"]:
        command += ["--figure", name]
    return command


def answer_all(study, requests, jobs):
    """Answers of `requests` (an iterator of dictionaries), as they come: (request, answer) or (None, description).

    A process that dies with a run in it makes that run a failed one; those that waited behind it are given to another.
    """
    command = command_of(study)
    selector = selectors.DefaultSelector()
    waiting = iter(requests)
    returned, workers, started, answered = [], set(), 0, False

    def next_request():
        return returned.pop() if returned else next(waiting, None)

    def start():
        nonlocal started
        request = next_request()
        if request is None:
            return
        worker = Worker(command, started)
        started += 1
        workers.add(worker)
        selector.register(worker.process.stdout, selectors.EVENT_READ, worker)
        worker.give(request)
        refill(worker)

    def refill(worker):
        while len(worker.given) < AHEAD:
            request = next_request()
            if request is None:
                return
            worker.give(request)

    def drop(worker):
        selector.unregister(worker.process.stdout)
        workers.discard(worker)
        worker.end()

    try:
        for _ in range(jobs):
            start()
        while workers:
            for key, _ in selector.select():
                worker = key.data
                lines = worker.answers()
                if lines is None:
                    lost = list(worker.given.values())
                    drop(worker)
                    code = worker.process.returncode
                    if not answered and not lost:
                        raise RunnerError(f"{command[0]} ended with code {code} before any answer")
                    if lost:
                        returned.extend(lost[1:])
                        ending = f"signal {-code}" if code < 0 else f"exit code {code}"
                        yield lost[0], {"run": lost[0]["run"], "status": "failed",
                                        "error": f"the process that did it ended with {ending}"}
                    if returned or lost:
                        start()
                    continue
                for line in lines:
                    if not line.strip():
                        continue
                    try:
                        answer = json.loads(line)
                    except ValueError:
                        raise RunnerError(f"{command[0]} answered '{line.decode(errors='replace')[:80]}'; expected a "
                                          'line of JSON such as {"run": "...", "status": "completed", "figures": {}}') from None
                    if "describe" in answer:
                        yield None, answer["describe"]
                        continue
                    request = worker.given.pop(answer.get("run"), None)
                    if request is None:
                        continue
                    answered = True
                    yield request, answer
                refill(worker)
                if not worker.given:
                    drop(worker)
    finally:
        for worker in list(workers):
            drop(worker)
