#!/usr/bin/python3
"""How shear is counted moves friction by a third and the attitude of narrow bearings by tens of degrees: every output says
which choice holds and what the other gives, and the other choice then gives it."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "../../examples")
ALONE = os.path.join(EXAMPLES, "bearing_alone/model.yaml")
SLIDER_CRANK = os.path.join(EXAMPLES, "slider_crank/model.yaml")

# The half-inch handbook example of a pump's journal, in inches and pounds.
HANDBOOK = """hersey: 1
lubricants: {oil: {viscosity: 27.58 mPa.s}}
bearings:
  main:
    diameter: 1.5 in
    width: 1.5 in
    radial_clearance: 0.0015 in
    lubricant: oil
    cavitation: reynolds
    supply: {line: widest_gap}
    operating_point: {journal_speed: 30 rev/s, load: 500 lbf}
"""
STUDY = "study: {parameters: {bearings.main.operating_point.load: [100 lbf, 200 lbf, 300 lbf]}}\n"
BY_PARAMETER = "parameters: {w: 1 lbf}\nstudy: {parameters: {w: [100 lbf, 200 lbf, 300 lbf]}}\n"


def hersey(*arguments):
    done = subprocess.run([HERSEY, *arguments], capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL,
                          check=False)
    if done.returncode != 0:
        raise AssertionError((arguments, done.stderr))
    return done


class Shear(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-shear-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, text, name="model.yaml"):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def solution(self, path, *arguments):
        return json.loads(hersey("bearing", path, "--json", "--no-grid-error", *arguments).stdout)["solutions"][0]

    def test_first_lines_tell_the_choice_and_what_the_other_gives(self):
        path = self.write(HANDBOOK)
        # Without the net force of shear, position and pressure do not depend on the choice.
        choices = {word: self.solution(path, "--set", f"bearings.main.cavitated_shear={word}", "--set",
                                       "bearings.main.shear_force=torque_only")["figures"]
                   for word in ("film_share", "full")}
        for word, other in (("film_share", "full"), ("full", "film_share")):
            for key in ("power_film", "torque_journal"):
                reported = choices[word][key + "_other_shear"]["value"]
                self.assertAlmostEqual(reported / choices[other][key]["value"], 1, delta=1e-9)  # of Newton's 1e-10
        self.assertGreater(choices["full"]["power_film"]["value"], 1.3 * choices["film_share"]["power_film"]["value"])
        text = hersey("bearing", path, "--no-grid-error").stdout.splitlines()
        self.assertIn("the oil's share of the gap (`cavitated_shear: film_share`); over the whole gap (`full`)", text[1])
        reported = self.solution(path)["figures"]["power_film_other_shear"]["value"]
        self.assertIn(f"{reported:.4g} W", text[1])
        table = hersey("bearing", path, "--no-grid-error", "--sweep", "load=100lbf,500lbf").stdout.splitlines()
        self.assertIn("`cavitated_shear: film_share`", table[0])
        self.assertIn("cavitated shear", self.solution(path)["conditions"])
        # A table over the choice itself has a row of each, and no line that could be true of both.
        both = hersey("bearing", path, "--no-grid-error", "--sweep", "bearings.main.cavitated_shear=film_share,full").stdout
        self.assertNotIn("`cavitated_shear:", both)
        powers = [f["figures"]["power_film"]["value"] for f in json.loads(hersey(
            "bearing", path, "--no-grid-error", "--json", "--sweep", "bearings.main.cavitated_shear=film_share,full").stdout)["solutions"]]
        self.assertAlmostEqual(powers[1] / self.solution(path)["figures"]["power_film_other_shear"]["value"], 1, delta=0.01)

    def test_the_report_of_a_bearing_says_so(self):
        page = os.path.join(self.folder, "page.html")
        hersey("bearing", self.write(HANDBOOK), "--no-grid-error", "--report", page)
        with open(page, encoding="utf-8") as file:
            self.assertIn("over the whole gap (`full`) this film would take", file.read())

    def test_a_run_tells_it_too(self):
        out = os.path.join(self.folder, "out")
        run = hersey("run", SLIDER_CRANK, "--json", "--output", out, "--set", "simulation.duration=90 deg")
        self.assertIn("the mean power loss in the film would be", run.stderr)
        document = json.loads(run.stdout)
        (bearing,) = document["runs"][0]["conditions"]
        self.assertIn("`cavitated_shear: film_share`", document["runs"][0]["conditions"][bearing]["cavitated shear"])
        named = {row["name"] for row in document["summary"]}
        self.assertIn("mean power loss in the film, cavitated film sheared the other way", named)

    def test_net_force_of_shear_is_reported_where_it_bears_the_load(self):
        narrow = ("--set", "bearings.main.width=2.25 mm", "--eccentricity-ratio", "0.1", "--eccentricity-angle", "-60deg")
        solution = self.solution(ALONE, *narrow)
        share = solution["figures"]["load_on_shear"]["value"]
        self.assertGreater(abs(share), 0.05)
        self.assertIn(f"carries {100 * share:.3g} % of the load", solution["conditions"]["shear force"])
        without = self.solution(ALONE, *narrow, "--set", "bearings.main.shear_force=torque_only")
        self.assertEqual(without["figures"]["load_on_shear"]["value"], 0)
        self.assertNotIn("shear force", without.get("conditions", {}))
        self.assertNotIn("shear force", self.solution(ALONE).get("conditions", {}))  # a loaded bearing

    def test_an_option_over_a_study_of_what_it_sets_leaves_one_row(self):
        for text in (HANDBOOK + STUDY, HANDBOOK.replace("500 lbf", '"${w}"') + BY_PARAMETER):
            path = self.write(text)
            count = len(json.loads(hersey("bearing", path, "--json", "--no-grid-error").stdout)["solutions"])
            self.assertEqual(count, 3)
            for option in (("--load", "500 lbf"), ("--eccentricity-ratio", "0.5")):
                (alone,) = json.loads(hersey("bearing", path, "--json", "--no-grid-error", *option).stdout)["solutions"]
                same = self.solution(self.write(HANDBOOK, "plain.yaml"), *option)
                self.assertEqual(alone["figures"]["load"]["value"], same["figures"]["load"]["value"])


if __name__ == "__main__":
    unittest.main()
