#!/usr/bin/python3
"""scripts/setup with stand-ins for dpkg-query, apt-get and sudo: silent when all is there, helpful when it cannot act."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))
NOBODY = 65534


class Setup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-setup-")
        self.addCleanup(folder.cleanup)
        os.chmod(folder.name, 0o755)
        self.root = folder.name
        os.mkdir(self.path("scripts"))
        for name in ("setup", "phase"):
            shutil.copy(os.path.join(SOURCE, "scripts", name), self.path("scripts", name))
        os.mkdir(self.path("bin"))
        self.program("apt-get", f'echo "$*" >> {self.path("apt.log")}')
        self.archive_lacks("clang-tidy-22")
        # Programs that the test machine may have or lack must not decide: no npm, no sudo but those made here.
        for name in ("bash", "sh", "env", "sed", "tr", "dirname", "mkdir", "sleep", "tail", "grep", "cut", "true"):
            os.symlink(shutil.which(name), self.path("bin", name))

    def path(self, *parts):
        return os.path.join(self.root, *parts)

    def program(self, name, text):
        with open(self.path("bin", name), "w", encoding="utf-8") as file:
            file.write(f"#!/bin/sh\n{text}\n")
        os.chmod(self.path("bin", name), 0o755)

    def installed(self, *packages):
        """dpkg-query as it behaves with these packages installed: it fails when one it is asked for is not known."""
        cases = "".join(f"{name}) echo {name}=installed ;; " for name in packages)
        self.program("dpkg-query", 'status=0; for name in "$@"; do case $name in -*) ;; '
                                   f'{cases} *) status=1 ;; esac; done; exit $status')

    def archive_lacks(self, *packages):
        self.program("apt-cache", f'case $2 in {"|".join(packages) or "-"}) exit 100 ;; esac')

    def setup(self, *purposes, as_nobody=False):
        user = {"user": NOBODY} if as_nobody and os.geteuid() == 0 else {}
        return subprocess.run([self.path("scripts/setup"), *purposes], env={"PATH": self.path("bin")}, text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, timeout=60, **user)

    def apt_calls(self):
        if not os.path.exists(self.path("apt.log")):
            return ""
        with open(self.path("apt.log"), encoding="utf-8") as file:
            return file.read()

    def test_all_packages_present_is_silent_and_needs_no_root(self):
        self.installed("clang-format", "clang-tidy", "python3")
        run = self.setup("lint", as_nobody=True)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))

    def test_missing_package_without_root_or_sudo_prints_the_line_to_run(self):
        self.installed("clang-format", "python3")
        run = self.setup("lint", as_nobody=True)
        self.assertEqual(run.returncode, 2)
        self.assertRegex(run.stderr, r"apt-get install .*clang-tidy$")
        self.assertNotRegex(run.stderr, r"apt-get install .*clang-format")
        self.assertEqual(self.apt_calls(), "")

    def test_missing_package_is_installed_through_sudo(self):
        os.chmod(self.root, 0o777)
        self.installed("clang-format", "python3")
        self.program("sudo", 'case $1 in -*) shift ;; esac; exec "$@"')
        run = self.setup("lint", as_nobody=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(self.apt_calls(), r"update\n.*install .*--no-install-recommends clang-tidy\n")

    def test_the_newer_of_two_packages_is_installed_where_the_archive_has_it(self):
        os.chmod(self.root, 0o777)
        self.installed("clang-format", "python3")
        self.archive_lacks()
        self.program("sudo", 'case $1 in -*) shift ;; esac; exec "$@"')
        run = self.setup("lint", as_nobody=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(self.apt_calls(), r"update\n.*install .*--no-install-recommends clang-tidy-22\n")
        self.installed("clang-format", "python3", "clang-tidy-22")
        self.assertEqual(self.setup("lint", as_nobody=True).stdout, "")

    def test_asking_installs_nothing_and_tells_who_cannot(self):
        os.chmod(self.root, 0o777)
        self.installed("clang-format", "python3")
        run = self.setup("--ask", "lint", as_nobody=True)
        self.assertEqual(run.returncode, 2)
        self.assertRegex(run.stderr, r"apt-get install .*clang-tidy$")
        self.program("sudo", 'case $1 in -*) shift ;; esac; exec "$@"')
        run = self.setup("--ask", "lint", as_nobody=True)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.assertEqual(self.apt_calls(), "")

    def test_listing_names_the_packages_and_installs_nothing(self):
        self.installed()
        run = self.setup("--list", "lint", as_nobody=True)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "clang-format clang-tidy python3\n", ""))
        self.assertEqual(self.apt_calls(), "")

    def test_apt_failure_is_shown_and_passed_on(self):
        os.chmod(self.root, 0o777)
        self.installed()
        self.program("sudo", 'case $1 in -*) shift ;; esac; exec "$@"')
        self.program("apt-get", 'echo "E: no network"; exit 100')
        run = self.setup("lint", as_nobody=True)
        self.assertEqual(run.returncode, 100)
        self.assertIn("E: no network", run.stdout)

    def test_unknown_purpose_is_an_error(self):
        run = self.setup("lnit")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("lnit", run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
