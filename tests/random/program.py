"""Runs hersey with a limit on its computing time and tells how it ended."""

import json
import os
import resource
import signal
import subprocess
from dataclasses import dataclass, field

# A small model that takes longer than this has no way to an end [s of computing time].
CPU_LIMIT = 60

# Text that only the program's own checks of itself print: a contract that does not hold is no message to a user.
_ASSERTIONS = ("does not hold", "is not finite", "HERSEY_", "Assertion", "terminate called", ".cpp:", ".h:",
               "vector::", "std::", "AddressSanitizer", "runtime error")


@dataclass
class Ending:
    """How one run ended: `answer`, `message` (it says why it has none), `refused` (the model is wrong), `hangs`,
    `assertion` or `crash`."""

    kind: str
    text: str = ""
    document: dict = field(default_factory=dict)
    warnings: str = ""


def _kind(code, text):
    if code in (-signal.SIGXCPU, -signal.SIGKILL):
        return "hangs"
    if any(word in text for word in _ASSERTIONS):
        return "assertion"
    if code == 0:
        return "answer"
    if code == 1 and text.strip():
        return "message"
    if code == 2 and text.strip():
        return "refused"
    return "crash"


def run(program, *arguments, cpu_limit=CPU_LIMIT):
    """The program's ending with these arguments, its standard output read as JSON where it is."""

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit, cpu_limit + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    done = subprocess.run([program, *arguments], capture_output=True, text=True, errors="replace",
                          stdin=subprocess.DEVNULL, preexec_fn=limit, check=False)
    text = done.stderr.strip()
    kind = _kind(done.returncode, done.stdout + text if done.returncode else text)
    document = {}
    if kind == "answer":
        try:
            document = json.loads(done.stdout)
        except ValueError:
            document = {}
    elif not text:
        text = done.stdout.strip()
    return Ending(kind, text if kind != "hangs" else f"more than {cpu_limit} s of computing time", document, text)


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
