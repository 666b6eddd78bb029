#!/usr/bin/python3
"""Models that once gave a wrong number, or no words for it: each with what should come out, from formulas or from the
stored fields alone. Comments number and name the faults; docs/random-models.md
lists their kinds, docs/decisions/0012-tests-of-meaning.md says why such tests exist."""

import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "../../examples")

# Words of the program's checks of itself, which mean nothing to a user.
INTERNAL = ("does not hold", "is not finite", ".cpp", ".h:", "internal error", "linearis", "Jacobian")


def hersey(*arguments):
    return subprocess.run([HERSEY, *arguments], capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL,
                          check=False)


class Defects(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-defects-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def bearing(self, name, *arguments):
        """Figures of a bearing by itself in SI and, node by node, its film thickness [m]."""
        fields = os.path.join(self.folder, "fields.csv")
        done = hersey("bearing", os.path.join(HERE, name + ".yaml"), "--no-grid-error", "--json", "--fields", fields,
                      *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = json.loads(done.stdout)["solutions"][0]["figures"]
        thickness = 1e-6 * np.genfromtxt(fields, delimiter=",", skip_header=1)[:, 4]
        return {key: f["value"] for key, f in figures.items()}, thickness

    def run_model(self, path, *settings):
        """Results of a run that completes, open, and what it has said."""
        out = os.path.join(self.folder, "out")
        arguments = [word for setting in settings for word in ("--set", setting)]
        done = hersey("run", os.path.join(HERE, path), "--output", out, "--force", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        results = h5py.File(os.path.join(out, "results.h5"))
        self.addCleanup(results.close)
        return results, done.stderr

    # -- 1: the smallest film

    def test_thickness_beside_depth_is_that_of_the_land(self):
        for name, expected in (("hole", 23.75e-6), ("hole_by_grid", 23.75e-6), ("groove", 50e-6),
                               ("arc_groove", 26e-6), ("pocket", 2.5e-6)):
            for grid in ((), ("120", "25"), ("61", "12")):
                settings = [f"bearings.main.grid.{key}={n}" for key, n in zip(("circumferential", "axial"), grid)]
                arguments = [word for setting in settings for word in ("--set", setting)]
                with self.subTest(name=name, grid=grid):
                    figures, thickness = self.bearing("thickness_beside_" + name, *arguments)
                    self.assertAlmostEqual(figures["h_min"] / expected, 1, delta=2e-4)
                    self.assertLessEqual(figures["h_min"], thickness.min() * (1 + 1e-6))

    def test_thickness_beside_a_pocket_in_a_run(self):
        results, _ = self.run_model("thickness_beside_pocket_run.yaml")
        expected = 25e-6 - math.hypot(3.52e-6, 22.2e-6)
        self.assertAlmostEqual(results["bearings/main/h_min"][-1] / expected, 1, delta=2e-3)

    def test_thickness_of_a_liner_that_gives_way(self):
        results, _ = self.run_model("thickness_column.yaml")
        b = results["bearings/ma"]
        rows = np.searchsorted(results["time"][:], b["fields/time"][:] * (1 - 1e-12))
        least = b["fields/thickness"][:].min(axis=(1, 2))
        self.assertTrue((b["h_min"][:] > 0).all())
        self.assertTrue((b["h_min"][:][rows] <= least * (1 + 1e-9)).all())
        # A smooth gap dips between two nodes of 48 by no more than an eighth of its second difference.
        self.assertTrue((b["h_min"][:][rows] > 0.5 * least).all())

    # -- 2 and 14: flow

    def test_side_flow_does_not_depend_on_the_depth_of_a_fed_groove(self):
        flow = {}
        for grid in ("60 13", "120 33", "240 65"):
            around, along = grid.split()
            for depth in ("5 mm", "0 mm"):
                figures, _ = self.bearing("fed_groove_leaks", "--set", f"bearings.b.grid.circumferential={around}",
                                          "--set", f"bearings.b.grid.axial={along}",
                                          "--set", f"bearings.b.features.groove.depth={depth}")
                flow[grid, depth] = figures["side_flow"]
            self.assertAlmostEqual(flow[grid, "5 mm"] / flow[grid, "0 mm"], 1, delta=1e-9)
        # By a program that shares nothing with this one [m^3/s].
        reference = 94200e-9
        self.assertAlmostEqual(flow["240 65", "5 mm"] / reference, 1, delta=0.005)
        self.assertLess(abs(flow["120 33", "5 mm"] / reference - 1), abs(flow["60 13", "5 mm"] / reference - 1))

    def test_supply_line_between_nodes_acts_as_on_one(self):
        on_node, _ = self.bearing("supply_line_off_node", "--eccentricity-angle", "0deg")
        for share in (0.25, 0.5, 0.75):
            between, _ = self.bearing("supply_line_off_node", "--eccentricity-angle", f"{3 * share}deg")
            for key in ("load", "side_flow"):
                self.assertAlmostEqual(between[key] / on_node[key], 1, delta=0.003)

    # -- 3: torque

    def test_torque_of_a_bore_that_bends_is_that_of_the_fields(self):
        results, _ = self.run_model(
            os.path.join(EXAMPLES, "flexible_big_end/model.yaml"), "variant=mesh", "load=-2500N",
            "bearings.big_end.asperities=none", "simulation.duration=360deg", "simulation.step=30deg",
            "output.fields_every=360deg", "bearings.big_end.shell_surface={faces: big_end, modes: 12}")
        b = results["bearings/big_end"]
        phi, z = b["fields/phi"][:], b["fields/z"][:]
        p, h, fill = (b["fields/" + key][-1] for key in ("pressure", "thickness", "fill"))
        R, slip = 0.0225, 3570 * math.pi / 30 * 0.0225
        simpson = np.ones(len(z))
        simpson[1:-1:2], simpson[2:-1:2] = 4, 2

        def integral(field):
            return field.sum(0) @ simpson * (z[1] - z[0]) / 3 * (phi[1] - phi[0]) * R**2

        rise = (np.roll(p, -1, 0) - np.roll(p, 1, 0)) / (2 * (phi[1] - phi[0]) * R)
        torque = integral(0.015 * np.exp(1.28e-10 * p) * slip * fill / h + h / 2 * rise)
        self.assertAlmostEqual(-b["torque_journal"][-1] / torque, 1, delta=5e-4)
        # The moment of the pressure on the slopes of the bore, once left out, is more than that.
        slopes = (np.roll(b["fields/shell_displacement"][-1], -1, 0) -
                  np.roll(b["fields/shell_displacement"][-1], 1, 0)) / (2 * (phi[1] - phi[0]) * R)
        self.assertGreater(abs(integral(p * slopes)), 10 * 5e-4 * torque)

    # -- 4: oil

    def check_fill_and_oil(self, results, name):
        b = results["bearings/" + name]
        fill = b["fields/fill"][:]
        self.assertGreaterEqual(fill.min(), 0)
        self.assertLessEqual(fill.max(), 1)
        self.assertGreaterEqual(b["power_film"][:].min(), 0)
        through = b["oil_through_flow"][-1]
        self.assertGreater(through, 0)
        self.assertLess(np.abs(b["oil_unexplained"][:]).max(), 1e-6 * through)

    def test_fill_stays_between_none_and_full(self):
        for name, bearing in (("negative_fill", "main"), ("negative_fill_no_depth", "ma")):
            with self.subTest(name=name):
                results, _ = self.run_model(name + ".yaml")
                self.check_fill_and_oil(results, bearing)
                self.assertEqual(results.attrs["status"], "completed")

    def test_oil_of_a_cycle_is_explained_at_any_step(self):
        for step in ("1 deg", "2 deg", "4 deg"):
            with self.subTest(step=step):
                results, _ = self.run_model(
                    os.path.join(EXAMPLES, "slider_crank/model.yaml"), "simulation.step=" + step,
                    "bearings.big_end.grid={circumferential: 24, axial: 5}", "output.fields_every=20 deg")
                self.assertGreater(results["crank_angle"][-1] - results["crank_angle"][0], 12.5)
                self.check_fill_and_oil(results, "big_end")

    # -- 5 and 6: start

    def test_start_moves_by_the_least_and_is_reported(self):
        results, said = self.run_model("start_changed.yaml")
        crank = results["joints/main/coordinates"][0]
        self.assertAlmostEqual(math.degrees(float(crank.ravel()[0])), 45, delta=0.001)
        self.assertIn("joints.main.initial.rotation: 45 deg given, 44.999", said)
        self.assertIn("joints.bore.initial.translation: 594.72 mm given, 594.68", said)

    def test_given_rate_is_kept(self):
        results, said = self.run_model("start_rate_changed.yaml", "simulation.duration=10 ms")
        self.assertAlmostEqual(float(results["joints/A/rates"][0].ravel()[0]), 6, delta=1e-9)
        self.assertNotIn("given", said)

    def test_light_journal_arrives_when_its_load_drives_it_there(self):
        arrived = {}
        for step in ("0.2 ms", "0.8 ms"):
            results, _ = self.run_model("light_journal.yaml", "simulation.step=" + step,
                                        "bearings.main.grid={circumferential: 40, axial: 9}")
            ratio = results["bearings/main/eccentricity_ratio"][:].ravel()
            self.assertTrue((np.diff(ratio) > 0).all())
            arrived[step] = np.interp(0.9, ratio, results["time"][:])
        self.assertAlmostEqual(arrived["0.2 ms"], 52.1e-3, delta=0.3e-3)
        self.assertAlmostEqual(arrived["0.8 ms"] / arrived["0.2 ms"], 1, delta=1e-3)

    # -- 9: nodal bodies let go

    def test_nodal_body_is_let_go_undeformed_where_asked(self):
        strain = {}
        for asked in ("none", "static"):
            results, _ = self.run_model("nodal_initial_deformation_none.yaml", "simulation.initial_deformation=" + asked)
            strain[asked] = results["energy/strain"][:]
        self.assertEqual(strain["none"][0], 0)
        self.assertGreater(strain["none"][-1], 0)
        self.assertGreater(strain["static"][0], 0)

    # -- films and mechanisms that solvers did not find

    def test_films_that_solvers_did_not_find(self):
        for solver in ("newton", "multigrid"):
            with self.subTest(solver=solver):
                figures, _ = self.bearing("deep_groove_barus", "--set", "bearings.main.solver=" + solver)
                reference, _ = self.bearing("deep_groove_barus", "--set", "bearings.main.solver=sor")
                self.assertAlmostEqual(figures["side_flow"] / reference["side_flow"], 1, delta=1e-6)
                results, _ = self.run_model("compressible_slider.yaml", "bearings.main.solver=" + solver)
                b = results["bearings/main"]
                self.assertLess(b["h_min"][-1], 25.5e-6)
                self.assertGreater(b["p_max"][-1], 10e5)

    def test_squeeze_without_any_torque(self):
        results, _ = self.run_model("planar_squeeze.yaml")
        self.assertAlmostEqual(float(results["bearings/main/eccentricity_ratio"][-1]), 0.94, delta=1e-6)

    def test_a_starved_steady_film_is_not_asked_for_a_shorter_step(self):
        for solver in ("newton", "multigrid", "sor"):
            done = hersey("bearing", os.path.join(HERE, "starved.yaml"), "--set", "bearings.main.solver=" + solver)
            self.assertIn("a film that starves", done.stderr)
            self.assertNotIn("shorter step", done.stderr)

    # -- 13: messages

    def test_films_far_from_any_answer_end_in_words_of_the_model(self):
        for name, command in (("assertion_shown", "bearing"), ("jacobian_not_finite_ends_small", "run")):
            with self.subTest(name=name):
                output = ["--output", os.path.join(self.folder, name)] if command == "run" else ["--no-grid-error"]
                done = hersey(command, os.path.join(HERE, name + ".yaml"), *output)
                self.assertIn(done.returncode, (0, 1), done.stderr)
                for word in INTERNAL:
                    self.assertNotIn(word, done.stderr)
                if done.returncode:
                    self.assertRegex(done.stderr, r"bearing \w+: ")

    def test_solver_that_does_not_arrive_tells_no_limit_of_the_film(self):
        for solver in ("newton", "multigrid"):
            with self.subTest(solver=solver):
                figures, _ = self.bearing("assertion_shown_multigrid", "--set", "bearings.main.solver=" + solver)
                self.assertAlmostEqual(figures["load"], 1137.74, delta=0.01)
        # Sweeps go round in circles between a spot's pressure and its density; on few nodes they soon do.
        done = hersey("bearing", os.path.join(HERE, "assertion_shown_multigrid.yaml"), "--no-grid-error", "--set",
                      "bearings.main.solver=sor", "--set", "bearings.main.grid={circumferential: 12, axial: 5}")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "and perhaps more; further out the solver does not find it .* `solver: newton` may")


    # -- cases that ended without an answer

    def test_load_far_out_is_found(self):
        figures, _ = self.bearing("load_not_found")
        self.assertAlmostEqual(figures["load"] / 204.634, 1, delta=1e-6)
        self.assertAlmostEqual(math.degrees(figures["load_angle"]), -95.72, delta=1e-4)
        self.assertTrue(0.9 < figures["eccentricity_ratio"] < 1)

    def test_reynolds_has_one_side_flow_for_all_solvers(self):
        flows = [self.bearing("newton_and_multigrid_differ", "--set", "bearings.main.solver=" + solver)[0]["side_flow"]
                 for solver in ("newton", "multigrid", "sor")]
        self.assertLess(max(flows) - min(flows), 1e-6 * max(flows))

    def test_coarse_step_at_a_dead_centre_goes_on(self):
        results, _ = self.run_model("coarse_step_ends_run.yaml")
        self.assertEqual(results.attrs["status"], "completed")
        self.assertGreaterEqual(results["time"][-1], 4.99)
        self.assertGreater(results["solver/rejected_steps"][:].sum(), 0)
        # What the steps cost in energy is reported, not hidden.
        self.assertGreater(abs(results["energy/since_start/unexplained"][-1]), 0.01)

    def test_stiff_bar_that_turns_starts_and_keeps_turning(self):
        results, _ = self.run_model("finite_strain_start.yaml")
        self.assertEqual(results.attrs["status"], "completed")
        turned = results["joints/j/coordinates"][-1] - results["joints/j/coordinates"][0]
        self.assertAlmostEqual(turned / (40 * 2e-3), 1, delta=1e-3)

    def test_limp_blade_keeps_its_modes(self):
        results, _ = self.run_model("blade.yaml")
        frequencies = results["modes/fields/frequency"][:6]
        # Bending in the plane of rotation lags what bends out of it by the turning alone, mode by mode.
        for lag, flap in zip(frequencies[::2], frequencies[1::2]):
            self.assertAlmostEqual(flap ** 2 - lag ** 2, (12 / (2 * math.pi)) ** 2, delta=1e-4)
        # A string on a hub of five times its length flaps faster than it turns, by sqrt(1 + 1.5 * 5) or a little less.
        self.assertTrue(2.7 < frequencies[1] / (12 / (2 * math.pi)) < math.sqrt(1 + 1.5 * 5) * 1.02)

    def test_bodies_without_freedom_hang_on_their_clamp(self):
        for name, mass in (("clamped_mesh", None), ("clamped_body", 1.0)):
            with self.subTest(name=name):
                results, _ = self.run_model(name + ".yaml")
                force = results["joints/j/reaction_force"][-1]
                mass = mass or results["bodies/bar"].attrs["mass"]
                self.assertAlmostEqual(abs(force[2]) / (9.81 * mass), 1, delta=1e-9)

    def test_closed_edges_of_a_run_let_no_oil_pass_and_are_reported(self):
        results, _ = self.run_model("../cli/bearing.yaml", "bearings.main.edge_pressure=closed")
        b = results["bearings/main"]
        self.assertEqual(max(abs(b["flow_left"][:]).max(), abs(b["flow_right"][:]).max()), 0)
        reported = {name: str(item[()]) for name, item in b.items() if "assumptions" in name} | dict(b.attrs)
        self.assertIn("closed: no oil passes", str(reported))

    # -- heat

    def test_oil_that_a_line_renews_takes_the_heat_of_a_closed_film(self):
        figures, _ = self.bearing("closed_insulated")
        self.assertLess(abs(figures["heat_balance_error"]), 1e-6)
        self.assertAlmostEqual(figures["heat_to_oil"] / figures["heat_dissipated"], 1, delta=1e-5)
        self.assertEqual(figures["heat_to_shell"], 0)
        # The friction of the whole film warms all the oil that it drags past the line once a turn, at most twice: as much
        # as passes the widest gap.
        self.assertTrue(40 < figures["T_film"] < figures["T_max"] < 150)
        # With open edges far apart the same film loses no oil to speak of.
        wide, _ = self.bearing("closed_insulated", "--set", "bearings.main.edge_pressure=0 Pa", "--set",
                               "bearings.main.width=100 m", "--set", "bearings.main.grid.axial=25")
        self.assertAlmostEqual(wide["T_max"], figures["T_max"], delta=0.02 * (figures["T_max"] - 40))
        # A line that stirs all and renews nothing leaves the heat where it is.
        done = hersey("bearing", os.path.join(HERE, "closed_insulated.yaml"), "--set",
                      "bearings.main.thermal.carry_over=1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no heat can leave", done.stderr)

    def test_heat_of_a_long_closed_film_comes_together_on_every_grid(self):
        loads = {}
        for around, across in ((240, 3), (240, 5), (240, 9), (120, 13)):
            figures, _ = self.bearing("long_hot_no_convergence", "--set", f"bearings.main.grid.circumferential={around}", "--set",
                                      f"bearings.main.grid.axial={across}")
            loads[around, across] = figures["load"]
        # What is alike all along the axis does not depend on the nodes there; temperatures are solved to 1e-6 of their rise.
        self.assertAlmostEqual(loads[240, 5] / loads[240, 3], 1, delta=1e-6)
        self.assertAlmostEqual(loads[240, 9] / loads[240, 3], 1, delta=1e-6)
        self.assertAlmostEqual(loads[120, 13] / loads[240, 3], 1, delta=0.005)  # second order around

    def test_heat_at_mid_width_does_not_feel_edges_far_away(self):
        def per_width(*settings):
            arguments = [word for setting in settings for word in ("--set", f"bearings.main.{setting}")]
            self.bearing("wide_hot_mid_width", *arguments)
            field = np.genfromtxt(os.path.join(self.folder, "fields.csv"), delimiter=",", skip_header=1)
            middle = field[np.abs(field[:, 1]) < 1]  # mm
            angle = np.radians(middle[:, 0])
            return 1e6 * 0.05 * 2 * math.pi / len(angle) * np.hypot(middle[:, 2] @ np.cos(angle), middle[:, 2] @ np.sin(angle))

        endless = per_width("edge_pressure=closed")
        for across in (3, 5, 9):
            # What oil exchanges with the next row falls with the square of the width over the bore.
            self.assertAlmostEqual(per_width(f"grid.axial={across}") / endless, 1, delta=0.003, msg=f"{across} nodes across")

    def test_table_of_a_tiny_period_is_refused(self):
        done = hersey("run", os.path.join(HERE, "table_of_tiny_period.yaml"), "--output", os.path.join(self.folder, "out"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("a table that bends 1e+10 times during the run", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
