#!/usr/bin/python3
"""Fifty small random models, the same every time: each ends with an answer in which every invariant holds, or says why there is none.

    random_test.py HERSEY [Class.test_name]

A failing model is left in the folder `random-models` of where the test runs, with the command that repeats it.
"""

import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import fitted_machines  # noqa: E402
import fitted_parts  # noqa: E402
import fitted_rotor  # noqa: E402
import model_text  # noqa: E402
import random_models  # noqa: E402
import rotor_bearings  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))
SEED = "hersey"


class RandomModels(unittest.TestCase):
    def fulfil(self, kind, first, count):
        results = [random_models.examine(HERSEY, SEED, f"{kind}-{k}", os.path.abspath("random-models"), is_small=True)
                   for k in range(first, first + count)]
        for result in results:
            with self.subTest(result.name):
                reported = [f"{result.ending}: {result.text}"] if result.ending != "answer" else []
                reported += [f"{invariant}: {text}" for invariant, text in result.findings]
                self.assertFalse(result.fails(), "\n".join(reported))
        # Messages are honest, but where nothing is answered nothing is tested.
        answered = sum(result.ending == "answer" for result in results)
        self.assertGreaterEqual(answered, count // 2, f"{count - answered} of {count} models have no answer")

    def test_steady_bearings_0_to_4(self):
        self.fulfil("steady", 0, 5)

    def test_steady_bearings_5_to_9(self):
        self.fulfil("steady", 5, 5)

    def test_steady_bearings_10_to_14(self):
        self.fulfil("steady", 10, 5)

    def test_steady_bearings_15_to_19(self):
        self.fulfil("steady", 15, 5)

    def test_steady_bearings_20_to_24(self):
        self.fulfil("steady", 20, 5)

    def test_steady_bearings_25_to_29(self):
        self.fulfil("steady", 25, 5)

    def test_bearings_of_rotors(self):
        for name in [f"{kind}-{k}" for kind in rotor_bearings.KINDS for k in range(2, 5)]:
            with self.subTest(name):
                ending, text, findings, _ = rotor_bearings.examine(HERSEY, "1", name, os.path.abspath("random-models"))
                self.assertEqual((ending, findings), ("answer", []), text)

    def test_machines_with_circuits_skirts_and_wear(self):
        for name in [f"{kind}-{k}" for kind in fitted_machines.KINDS for k in range(2)]:
            with self.subTest(name):
                ending, text, findings, _ = fitted_machines.examine(HERSEY, "1", name, os.path.abspath("random-models"))
                self.assertEqual((ending, findings), ("answer", []), text)

    def test_machines_0_to_4(self):
        self.fulfil("machine", 0, 5)

    def test_machines_5_to_9(self):
        self.fulfil("machine", 5, 5)

    def test_machines_10_to_14(self):
        self.fulfil("machine", 10, 5)

    def test_machines_15_to_19(self):
        self.fulfil("machine", 15, 5)


class TheChecksOfFittedMachines(unittest.TestCase):
    """Machines that are not the same are found out."""

    def test_a_thinner_oil_is_another_machine(self):
        self.assert_found(lambda model: model["lubricants"]["oil"].update(viscosity="19.9 mPa.s"), mu=20e-3)

    def test_a_drilling_a_hundredth_longer_is_another_circuit(self):
        def lengthen(model):
            for way in fitted_parts.ways(model["circuit"]):
                entry = model["circuit"]["elements"][way]
                for key in entry.keys() & {"length", "resistance", "diameter"}:
                    value, unit = entry[key].split()
                    entry[key] = f"{1.01 * float(value)} {unit}"
        self.assert_found(lengthen)

    def assert_found(self, alter, **given):
        import copy
        import random
        import tempfile

        case = fitted_rotor.Rotor(random.Random("altered"))
        vars(case).update(given)
        model = case.model()
        altered = copy.deepcopy(model)
        alter(altered)
        with tempfile.TemporaryDirectory() as folder:
            _, one = fitted_machines.solved(HERSEY, model_text.yaml(model), folder, "model")
            _, other = fitted_machines.solved(HERSEY, model_text.yaml(altered), folder, "altered")
        self.assertNotEqual(fitted_machines.differences(one, other, fitted_parts.Writing(altered)), [])


class TheChecks(unittest.TestCase):
    """The checks see what they are made for: an answer altered by hand is found out."""

    def answer(self, radial_velocity=0.0, **changes):
        import tempfile

        import bearings
        import steady
        import steady_case

        b = bearings.Bearing(0.025, 0.02, 40e-6, 0.015, 60, 13, **({"p_edge": (1e5, 1e5)} | changes))
        case = steady.Steady(b, 300.0, position=(0.6, 0.3), radial_velocity=radial_velocity)
        with tempfile.TemporaryDirectory() as folder:
            ending, answer = steady_case.Runs(HERSEY, folder).solve(case, "model")
        self.assertEqual(ending.kind, "answer", ending.text)
        return case, answer, steady

    def assert_found(self, invariant, alter):
        case, answer, steady = self.answer()
        self.assertEqual(list(steady.check(case, answer)), [])
        alter(answer)
        self.assertIn(invariant, [name for name, _ in steady.check(case, answer)])

    def test_a_film_thinner_than_any_place_is_found(self):
        self.assert_found("h_min is somewhere", lambda a: a.values.update(h_min=0.9 * a["h_min"]))

    def test_a_smallest_film_above_a_node_is_found(self):
        self.assert_found("h_min <= h", lambda a: a.values.update(h_min=1.1 * a["h_min"]))

    def test_a_fill_below_nothing_is_found(self):
        self.assert_found("0 <= theta <= 1", lambda a: a.theta.__setitem__((3, 4), -0.01))

    def test_a_load_ten_percent_off_is_found(self):
        self.assert_found("load", lambda a: a.values.update(load=1.1 * a["load"]))

    def test_a_torque_five_percent_off_is_found(self):
        self.assert_found("power: turned + pumped = dissipated",
                          lambda a: a.values.update(torque_journal=1.05 * a["torque_journal"]))

    def test_oil_from_nowhere_is_found(self):
        self.assert_found("oil", lambda a: a.values.update(flow_left=a["flow_left"] + 0.001 * abs(a["flow_left"]) + 1e-9))

    def test_contact_of_another_roughness_is_found(self):
        case, answer, steady = self.answer(asperities={"model": "greenwood_tripp_fit", "sigma": 5e-6, "summits": 5e-6,
                                                       "factor": 3e-3, "modulus": 1e11, "friction": 0.1})
        self.assertEqual(list(steady.check(case, answer)), [])
        case.bearing.asperities["summits"] = 0.0
        self.assertIn("asperities by formula", [name for name, _ in steady.check(case, answer)])

    def test_oil_through_a_wall_is_found(self):
        case, answer, steady = self.answer(walls=(True, True), p_edge=(0.0, 0.0), supply=("widest_gap", 1e5))
        self.assertEqual(list(steady.check(case, answer)), [])
        answer.values.update(flow_left=1e-9)
        self.assertIn("closed edges", [name for name, _ in steady.check(case, answer)])

    def test_work_of_a_journal_that_squeezes_is_missed(self):
        case, answer, steady = self.answer(radial_velocity=2e-3)
        self.assertEqual(list(steady.check(case, answer)), [])
        case.radial_velocity = 0.0
        self.assertIn("power: turned + pumped = dissipated", [name for name, _ in steady.check(case, answer)])

    def test_a_gap_in_the_wrong_place_is_found(self):
        self.assert_found("gap by formula", lambda a: setattr(a, "h", a.h * 1.001))


if __name__ == "__main__":
    unittest.main()
