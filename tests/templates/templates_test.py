"""Models with templates: short ones that equal their long form to the last bit, and what is said of wrong ones."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

HERSEY = sys.argv.pop(1)
SOURCE = pathlib.Path(sys.argv.pop(1))


def datasets(path):
    """Every dataset of a results file as bytes, but for the computing time, the model's text and what else differs in name alone."""
    found = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu":
            found[name] = item[()].tobytes()

    with h5py.File(path) as file:
        file.visititems(take)
    return {name: content for name, content in found.items() if "cost" not in name and "time_of" not in name}


class InlineFour(unittest.TestCase):
    def test_nine_films_take_sixty_lines(self):
        lines = (SOURCE / "examples/engine/inline_four.yaml").read_text().splitlines()
        self.assertLessEqual(len(lines), 60)

    def test_short_and_long_form_are_equal_to_the_last_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            results = []
            shutil.copy(SOURCE / "examples/engine/gas_pressure.csv", folder)
            for model in (SOURCE / "examples/engine/inline_four.yaml", SOURCE / "tests/templates/inline_four_long.yaml"):
                copy = pathlib.Path(folder) / model.name
                shutil.copy(model, copy)
                output = pathlib.Path(folder) / model.stem
                run = subprocess.run(
                    [HERSEY, "run", str(copy), "--output", str(output), "--threads", "1",
                     "--set", "simulation={crank: main, duration: 2 deg, step: 0.5 deg, spectral_radius: 0.8}"],
                    capture_output=True, text=True, check=False)
                self.assertEqual(run.returncode, 0, run.stderr)
                results.append(datasets(output / "results.h5"))
            short, long = results
            self.assertEqual(sorted(short), sorted(long))
            self.assertGreater(len(short), 50)  # nine films, each with a score of figures
            for name in short:
                self.assertEqual(short[name], long[name], name)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
