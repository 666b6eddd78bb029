#!/usr/bin/python3
"""scripts/tidy sees into sources that are compiled as one, the analyzer too. scripts/lint runs it: `make test` has no
clang-tidy yet.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
FAULTY = "int dereferenced(int k) { int* p = nullptr; if (k > 3) p = &k; return *p; }\n"
SOUND = "int dereferenced(int k) { int* p = &k; return *p; }\n"


def tidy(folder, source):
    """Exit code and output of scripts/tidy on a source that is compiled as one with another."""
    path = os.path.join(folder, "apps", "first.cpp")
    with open(path, "w", encoding="utf-8") as file:
        file.write(source)
    run = subprocess.run([os.path.join(SOURCE, "scripts/tidy"), ".", "1", "apps/first.cpp"], cwd=folder, text=True, check=False,
                         capture_output=True, env={**os.environ, "XDG_CACHE_HOME": os.path.join(folder, "cache")})
    return run.returncode, run.stdout + run.stderr


def main():
    with tempfile.TemporaryDirectory(prefix="hersey-tidy-") as folder:
        folder = os.path.realpath(folder)
        shutil.copy(os.path.join(SOURCE, ".clang-tidy"), folder)
        os.mkdir(os.path.join(folder, "apps"))  # findings in others' folders do not count
        with open(os.path.join(folder, "apps", "second.cpp"), "w", encoding="utf-8") as file:
            file.write("int second() { return 2; }\n")
        os.mkdir(os.path.join(folder, "Unity"))
        whole = os.path.join(folder, "Unity", "unity_0_cxx.cxx")
        with open(whole, "w", encoding="utf-8") as file:
            file.write(f'#include "{folder}/apps/first.cpp"\n#include "{folder}/apps/second.cpp"\n')
        with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as file:
            json.dump([{"directory": folder, "file": whole, "command": f"clang++ -std=c++20 -o whole.o -c {whole}"}], file)

        status, said = tidy(folder, FAULTY)
        if status != 1 or "clang-analyzer-core.NullDereference" not in said:
            return f"a null pointer's use was not found; exit code {status}:\n{said}"
        status, said = tidy(folder, SOUND)
        if status != 0 or "error" in said:
            return f"a sound source was not found clean; exit code {status}:\n{said}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
