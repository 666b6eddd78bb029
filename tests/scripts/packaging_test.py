#!/usr/bin/python3
"""packaging_test.py PROGRAM SOURCE   man pages and completion follow the program's own help: every command, every option."""

import gzip
import os
import re
import subprocess
import sys
import tempfile
import unittest

import yaml

PROGRAM, SOURCE = os.path.abspath(sys.argv.pop(1)), os.path.abspath(sys.argv.pop(1))


def made_by(script, folder):
    subprocess.run([sys.executable, os.path.join(SOURCE, "packaging", script), PROGRAM, folder], check=True)


def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help"], text=True, capture_output=True, check=True).stdout


def commands():
    section = help_of().split("Subcommands:\n")[1].split("\n\n")[0]
    return re.findall(r"^  (\w+)", section, re.MULTILINE)


def options_of(command):
    section = help_of(command).split("\nOptions:\n")[1].split("\n\n")[0]
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", section, re.MULTILINE)


class Packaging(unittest.TestCase):
    def test_man_pages_hold_every_command_and_option(self):
        with tempfile.TemporaryDirectory() as folder:
            made_by("man_pages.py", folder)
            for command in commands():
                with gzip.open(os.path.join(folder, f"hersey-{command}.1.gz"), "rt", encoding="utf-8") as file:
                    text = file.read().replace("\\-", "-")
                self.assertTrue(text.startswith(f'.TH HERSEY-{command.upper()} 1 '), text[:60])
                for option in options_of(command):
                    self.assertIn(option, text, f"the man page of {command}")

    def test_completion_offers_every_command_and_option(self):
        with tempfile.TemporaryDirectory() as folder:
            made_by("completions.py", folder)
            for command in commands():
                self.assertIn(command, self.completed(folder, "hersey", command[:2]))
                self.assertLessEqual(set(options_of(command)), set(self.completed(folder, "hersey", command, "--")), command)
            for name in ("_hersey", "hersey.fish"):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    text = file.read()
                for option in options_of("run"):
                    self.assertIn(option.removeprefix("--"), text, name)

    def completed(self, folder, *words):
        script = f'source {folder}/hersey; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _hersey 2>/dev/null; printf "%s\\n" "${{COMPREPLY[@]}}"'
        return subprocess.run(["bash", "-c", script, "bash", *words], text=True, capture_output=True, check=True).stdout.split()

    def test_recipes_name_what_there_is(self):
        def text(*path):
            with open(os.path.join(SOURCE, *path), encoding="utf-8") as file:
                return file.read()

        recipe, script = yaml.safe_load(text("packaging/conda/recipe.yaml")), text("packaging/conda/build.sh")
        self.assertTrue(os.access(os.path.join(SOURCE, recipe["build"]["script"]), os.X_OK))
        subprocess.run(["bash", "-n", os.path.join(SOURCE, recipe["build"]["script"])], check=True)
        for path in recipe["about"]["license_file"]:
            self.assertTrue(os.path.exists(os.path.join(SOURCE, path)), path)
        sources = "".join(text(path) for path in ("CMakeLists.txt", "python/CMakeLists.txt", "apps/cli/CMakeLists.txt", "cmake/HerseyInstall.cmake"))
        for option in re.findall(r"-D(HERSEY_\w+|BUILD_TESTING)=", script):
            self.assertRegex(sources, rf"option\({option} ")
        for target in re.search(r"--target ([\w ]+) -j", script)[1].split():
            self.assertRegex(sources, rf"add_(executable|module)\({target} ")
        self.assertIn(f"COMPONENT {re.search(r'--component ([a-z]+)', script)[1]}", sources)
        # What conda packages are built with are what the sources ask for, by the names of conda-forge.
        names = {"Eigen3": "eigen", "nlohmann_json": "nlohmann_json", "CLI11": "cli11", "LibLZMA": "liblzma-devel", "HDF5C": "hdf5", "KLU": "suitesparse",
                 "MUMPS": "mumps-seq", "CppHttplib": "cpp-httplib"}
        host = {package.split()[0] for package in recipe["requirements"]["host"]}
        for asked in re.findall(r"^find_package\(([\w-]+)", text("cmake/HerseyDependencies.cmake"), re.MULTILINE):
            if asked != "Threads":
                self.assertIn(names.get(asked, asked.lower()), host)
        container = text("packaging/container/Containerfile")
        for target in re.findall(r"make (\w+)$", container, re.MULTILINE):
            self.assertRegex(text("Makefile"), rf"(?m)^{target}:")
        for path in re.findall(r"--from=build /hersey/build/release/(\w+)", container):
            self.assertIn(f"$build/{path}", text("scripts/package"))

    def test_the_release_has_a_place_in_the_changelog(self):
        with open(os.path.join(SOURCE, "CHANGELOG.md"), encoding="utf-8") as file:
            headings = re.findall(r"^## (.+)$", file.read(), re.MULTILINE)
        self.assertTrue(headings)
        for heading in headings:
            self.assertRegex(heading, r"^(Unreleased|\d+\.\d+\.\d+ \(\d{4}-\d\d-\d\d\))$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
