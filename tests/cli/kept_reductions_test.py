#!/usr/bin/python3
"""Reduced meshes kept from one program to the next: HERSEY_CACHE, and that no answer depends on it."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
EXAMPLES = pathlib.Path(os.path.abspath(__file__)).parent.parent.parent / "examples"
ROD = str(EXAMPLES / "slider_crank" / "flexible_rod.yaml")


class KeptReductions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-kept-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def hersey(self, *arguments, **variables):
        environment = {name: value for name, value in os.environ.items() if name not in ("HERSEY_CACHE", "XDG_CACHE_HOME")}
        done = subprocess.run([HERSEY, *arguments], capture_output=True, text=True, timeout=300, check=False,
                              env=environment | {"HOME": str(self.folder / "home")} | variables)
        self.assertEqual(done.returncode, 0, done.stderr)

    def kept(self, folder):
        return sorted(pathlib.Path(folder).glob("*.reduction"))

    def numbers(self, name, **variables):
        """All numbers of the bearings and bodies of a short run."""
        import h5py
        out = self.folder / name
        self.hersey("run", ROD, "--set", "simulation.duration=2deg", "--output", str(out), "--force", **variables)
        numbers = {}
        with h5py.File(next(out.rglob("*.h5"))) as file:
            for group in ("bearings", "bodies"):
                file[group].visititems(lambda path, item, group=group: numbers.update({f"{group}/{path}": item[()].tobytes()})
                                       if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" else None)
        self.assertTrue(numbers)
        return numbers

    def test_a_kept_reduction_changes_no_bit_and_a_damaged_one_is_replaced(self):
        cache = self.folder / "cache"
        without = self.numbers("without", HERSEY_CACHE="off")
        self.assertFalse(cache.exists())
        self.assertFalse((self.folder / "home").exists())
        self.hersey("check", ROD, HERSEY_CACHE=str(cache))
        [file] = self.kept(cache)
        whole = file.read_bytes()
        self.assertEqual(self.numbers("with", HERSEY_CACHE=str(cache)), without)
        self.assertEqual([one.read_bytes() for one in self.kept(cache)], [whole])  # the run needed no other
        file.write_bytes(whole[: len(whole) // 2] + b"x" + whole[len(whole) // 2 + 1:])
        self.assertEqual(self.numbers("damaged", HERSEY_CACHE=str(cache)), without)
        self.assertEqual(file.read_bytes(), whole)

    def test_the_folder_is_that_of_the_user_s_caches(self):
        self.hersey("check", ROD, XDG_CACHE_HOME=str(self.folder / "caches"))
        self.assertEqual(len(self.kept(self.folder / "caches" / "hersey")), 1)
        self.assertFalse((self.folder / "home").exists())
        self.hersey("check", ROD, XDG_CACHE_HOME="relative")
        self.assertEqual(len(self.kept(self.folder / "home" / ".cache" / "hersey")), 1)


if __name__ == "__main__":
    unittest.main()
