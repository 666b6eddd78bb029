#!/usr/bin/python3
"""Pairs of models whose answers are tied to each other, whatever they are: options at their neutral value, similar bearings, other units,
keys that must act, absurd numbers.

    metamorphic_test.py HERSEY [Class.test_name]
"""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import models  # noqa: E402
import numbers_of_models as numbers  # noqa: E402
import relations  # noqa: E402
import tree as trees  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))

ROUND_OFF = 1e-10  # of a figure, after some Newton steps that end at the same residual
CONVERTED = 1e-8  # of a figure, where every quantity was rounded once more as it was converted

# Slips below 1 mm/s or so are smoothed by a speed that does not scale; a threshold speed is one under gravity, which does not either.
SCALES = {"power_asperity": 1e-5, "asperity_share": 1e-5}
NOT_SIMILAR = ("threshold_speed",)

# Numbers that nothing asks for: an expansion where no heat is carried. Density acts on the Reynolds number.
INERT = {"GLOBAL": ["lubricants.oil.thermal_expansion"]}


class Pairs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-pairs-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def model(self, name):
        return trees.load(getattr(models, name))

    def figures(self, tree):
        ending, figures = trees.bearing(HERSEY, tree, self.folder)
        self.assertEqual(ending.kind, "answer", ending.text)
        return figures

    def test_an_option_at_its_neutral_value_is_the_option_left_out(self):
        without = {name: self.figures(self.model(name)) for name in ("PLAIN", "HOT")}
        for name, path, value in relations.NEUTRAL:
            with self.subTest(path, value=value):
                tree = trees.changed(self.model(name), tuple(path.split(".")), value)
                self.assertEqual(relations.close(without[name], self.figures(tree), ROUND_OFF), [])

    def test_other_units_change_nothing(self):
        for name in ("PLAIN", "FULL", "HOT", "GLOBAL"):
            with self.subTest(name):
                tree = self.model(name)
                self.assertEqual(relations.close(self.figures(tree), self.figures(relations.in_other_units(tree)), CONVERTED), [])

    def test_similar_bearings_have_similar_figures(self):
        for name in ("PLAIN", "FULL", "HOT", "GLOBAL"):
            tree = self.model(name)
            if "density" not in tree["lubricants"]["oil"]:  # the default would not scale, and Reynolds numbers with it
                tree = trees.changed(tree, ("lubricants", "oil", "density"), "850 kg/m^3")
            one = self.figures(tree)
            # a cavity below the atmosphere cannot be scaled up beyond a vacuum
            for scales in ((4, 1, 1), (0.25, 8, 4)) if name == "FULL" else ((4, 1, 1), (1, 64, 1), (1, 1, 0.25), (0.25, 8, 4)):
                with self.subTest(name, length=scales[0], mass=scales[1], time=scales[2]):
                    other = {key: (value / relations.size(unit, *scales) if isinstance(value, (int, float)) else value, unit)
                             for key, (value, unit) in self.figures(relations.scaled(tree, *scales)).items()}
                    self.assertEqual(relations.close(one, other, CONVERTED, (*relations.LEFT_OUT, *NOT_SIMILAR, *SCALES)), [])
                    for key, rtol in SCALES.items():
                        if key in one:
                            self.assertLessEqual(abs(one[key][0] - other[key][0]), rtol * abs(one[key][0]), key)


class Numbers(Pairs):
    def test_every_number_of_a_bearing_acts(self):
        for name in ("PLAIN", "FULL"):
            self.assertEqual(numbers.dead_keys(HERSEY, self.model(name), self.folder), INERT.get(name, []))

    def test_absurd_numbers_are_answered_or_refused(self):
        self.assertEqual(numbers.bad_endings(HERSEY, self.model("PLAIN"), self.folder), [])


if __name__ == "__main__":
    unittest.main()
