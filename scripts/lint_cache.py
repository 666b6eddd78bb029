"""What scripts/tidy and scripts/headers share: how a source is compiled, what it includes, and what was found clean before, by
content, below ${XDG_CACHE_HOME:-~/.cache}/hersey-lint: any clone may use it.
"""

import os
import re
import shlex
import subprocess
import time

CACHE = os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "hersey-lint")
FORGOTTEN_AFTER = 30 * 86400  # s without use


def compiler_of(entry):
    """The compiler's arguments in an entry of compile_commands.json, itself first; what stands before is ccache."""
    arguments = shlex.split(entry["command"])
    return arguments[next(i for i, a in enumerate(arguments) if re.search(r"(\+\+|cc|clang)[-.\d]*$", a)):]


def included_by(arguments, folder=".", text=None):
    """Every file that a source includes, itself first; `text` where the source is "-"."""
    rule = subprocess.run([*arguments, "-M"], cwd=folder, input=text, capture_output=True, text=True, check=True).stdout
    names = shlex.split(rule.replace("\\\n", " "))[1:]
    return [name if name == "-" else os.path.normpath(os.path.join(folder, name)) for name in names]


def is_known(key):
    path = os.path.join(CACHE, key)
    if os.path.exists(path):
        os.utime(path)
        return True
    return False


def remember(key):
    open(os.path.join(CACHE, key), "w", encoding="utf-8").close()


def open_cache():
    """Makes it where there is none, and forgets what nobody has asked for lately."""
    os.makedirs(CACHE, exist_ok=True)
    for name in os.listdir(CACHE):
        path = os.path.join(CACHE, name)
        if os.path.getmtime(path) < time.time() - FORGOTTEN_AFTER:
            os.remove(path)
