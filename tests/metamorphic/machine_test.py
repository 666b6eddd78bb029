#!/usr/bin/python3
"""Pairs of machines whose results are tied to each other, keys that act, defaults that do not, absurd numbers; in part.

    machine_test.py HERSEY [Class.test_name]

All of it: all_pairs.py, which `make random-models` runs.
"""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import machine_models  # noqa: E402
import machine_numbers  # noqa: E402
import machine_pairs as pairs  # noqa: E402
import schema  # noqa: E402
import settled  # noqa: E402
import tree as trees  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))

MACHINES = ("WORKSHOP", "CRANK", "ROTOR", "WHIP")

# Of defaults and of absurd values every so many, beginning at another one in each machine.
EVERY_DEFAULT, EVERY_ABSURD = 13, 83


class OfMachines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-pairs-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def tree(self, name):
        return trees.load(getattr(machine_models, name))


class Pairs(OfMachines):
    def check_pairs(self, name):
        pair = pairs.Pair(HERSEY, self.folder, self.tree(name))
        for title, differences in pairs.PAIRS.items():
            with self.subTest(title):
                self.assertEqual(differences(pair, name), [])

    def test_pairs_of_a_workshop(self):
        self.check_pairs("WORKSHOP")

    def test_pairs_of_a_crank(self):
        self.check_pairs("CRANK")

    def test_pairs_of_a_rotor(self):
        self.check_pairs("ROTOR")

    def test_pairs_of_a_beam(self):
        self.check_pairs("WHIP")

    def test_a_run_that_has_settled_is_the_bearing_by_itself(self):
        self.assertEqual(settled.differences(HERSEY, self.folder), [])


class Keys(OfMachines):
    def test_defaults_written_out_change_nothing(self):
        keys = schema.Schema(HERSEY)
        for k, name in enumerate(MACHINES):
            tree = self.tree(name)
            pair = pairs.Pair(HERSEY, self.folder, tree)
            for path, default in list(keys.defaults_left_out(tree))[k::EVERY_DEFAULT]:
                with self.subTest(f"{name} {trees.named(path)}: {default}"):
                    self.assertEqual(pairs.default_that_acts(pair, path, default), [])

    def test_absurd_numbers_are_answered_or_refused(self):
        for k, name in enumerate(MACHINES):
            tree = self.tree(name)
            cases = [(number, value) for number in machine_numbers.numbers(tree) for value in machine_numbers.ABSURD]
            self.assertEqual(machine_numbers.bad_endings(HERSEY, tree, self.folder, cases[k::EVERY_ABSURD]), [])


if __name__ == "__main__":
    unittest.main()
