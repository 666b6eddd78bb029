#!/usr/bin/python3
"""key_figures_test.py SOURCE   what `make key-figures` compares: every example, every change, each with its reason. Programs are
stood in for; the committed table is read."""

import contextlib
import io
import os
import pathlib
import stat
import sys
import tempfile
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))
sys.path.insert(0, os.path.join(SOURCE, "bench"))

import key_figure_rules as rules  # noqa: E402
import key_figures  # noqa: E402

EXAMPLE, COMMAND = "plane_slider/model", "bearing"


def bearing(h_min=2e-5, load=1300.0, **more):
    """What `hersey bearing --json` would say."""
    figures = {"h_min": {"value": h_min, "unit": "m", "name": "minimum film thickness"},
               "load": {"value": load, "unit": "N", "name": "load"},
               "moment_x": {"value": 1e-17, "unit": "N.m", "name": "moment"},
               "whirl_ratio": {"value": None, "unit": "", "name": "whirl frequency ratio", "words": "no whirl"}}
    return {"solutions": [{"figures": figures | more, "wall_time": 0.1}]}


class KeyFigures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-key-figures-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.table = self.folder / "figures.csv"

    def program(self, answer, name="program"):
        """A program that says this; with None one that cannot read its model."""
        path = self.folder / name
        text = repr(answer).replace("None", "null").replace("'", '"')
        path.write_text("#!/bin/sh\n" + ("echo 'no such key' >&2; exit 2\n" if answer is None else f"cat <<'END'\n{text}\nEND\n"),
                        encoding="utf-8")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    def run_with(self, answer, *options):
        """Exit status and everything printed."""
        arguments, sys.argv = sys.argv, ["key_figures.py", self.program(answer), "--only", f"^{EXAMPLE}$", "--jobs", "1",
                                         "--table", str(self.table), *options]
        try:
            with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(out):
                return key_figures.main(), out.getvalue()
        finally:
            sys.argv = arguments

    def rows(self):
        return key_figures.Table.read(self.table).rows

    def give_reason(self, quantity, reason):
        table = key_figures.Table.read(self.table)
        table.rows[EXAMPLE, COMMAND, quantity][key_figures.WHY] = reason
        table.write(self.table)

    def release(self, version):
        text = self.table.read_text(encoding="utf-8")
        self.table.write_text(text.replace(",unreleased,", f",{version},", 1), encoding="utf-8")

    def test_every_example_is_run_or_left_out_with_a_reason(self):
        self.assertEqual(rules.complaints(key_figures.examples()), [])
        self.assertTrue(all(rules.LEFT_OUT.values()))

    def test_a_new_example_and_one_that_is_gone_are_named(self):
        names = key_figures.examples()
        reported = rules.complaints([*names[1:], "thrust_pad/model"])
        self.assertEqual(len(reported), 2)
        self.assertIn("thrust_pad/model: an example without key figures", reported[0])
        self.assertIn(f"{names[0]}: no such example", reported[1])

    def test_the_committed_table_has_figures_of_every_command(self):
        table = key_figures.Table.read(key_figures.TABLE)
        self.assertEqual(table.columns[:4], key_figures.KEYS)
        self.assertEqual(table.columns[-1], key_figures.WHY)
        listed = {key[:2] for key, row in table.rows.items() if row[table.last]}
        run = {(name, key_figures.text_of_command(command)) for name in key_figures.examples() for command in rules.commands(name)}
        self.assertEqual(listed, run)

    def test_an_unchanged_program_differs_nowhere(self):
        self.assertEqual(self.run_with(bearing(), "--update")[0], 0)
        status, text = self.run_with(bearing())
        self.assertEqual(status, 0, text)
        self.assertIn("0 differ", text)

    def test_a_change_beyond_round_off_is_found_and_needs_a_reason(self):
        self.run_with(bearing(), "--update")
        # Round-off of iterations stays below RELATIVE; twice RELATIVE does not.
        self.assertEqual(self.run_with(bearing(h_min=2e-5 * (1 + 0.5 * rules.RELATIVE)))[0], 0)
        status, text = self.run_with(bearing(h_min=2e-5 * (1 + 2 * rules.RELATIVE)))
        self.assertEqual(status, 1)
        self.assertIn("h_min: unreleased 2e-05, now 2.00000", text)
        self.assertIn("+2e-06", text)
        self.assertNotIn("load:", text)
        self.give_reason("h_min", "another law of the gap")
        status, text = self.run_with(bearing(h_min=2.1e-5))
        self.assertEqual(status, 0, text)
        self.assertIn("another law of the gap", text)

    def test_a_figure_that_vanishes_appears_or_answers_otherwise_is_found(self):
        self.run_with(bearing(), "--update")
        for answer, reported in ((bearing(load=0.0), "load: unreleased 1300, now - (gone)"),
                             (bearing(moment_x={"value": 2.0, "unit": "N.m", "name": "moment"}), "moment_x: unreleased -, now 2 (new)"),
                             (bearing(whirl_ratio={"value": 0.5, "unit": "", "name": "whirl"}), "now 0.5 (another answer)")):
            status, text = self.run_with(answer)
            self.assertEqual(status, 1, text)
            self.assertIn(reported, text)

    def test_round_off_where_symmetry_makes_zero_is_no_figure(self):
        self.run_with(bearing(), "--update")
        self.assertNotIn((EXAMPLE, COMMAND, "moment_x"), self.rows())
        self.assertEqual(self.run_with(bearing(moment_x={"value": -3e-16, "unit": "N.m", "name": "moment"}))[0], 0)

    def test_inputs_places_balances_and_times_are_no_key_figures(self):
        for name in ("mass_balance_error", "h_min_angle", "journal_speed", "wall_time", "power_film_other_shear"):
            answer = bearing() if name == "wall_time" else bearing(**{name: {"value": 1.0, "unit": "", "name": name}})
            self.assertNotIn(name, [quantity for quantity, _, _ in rules.of_bearing(answer)])

    def test_a_written_reason_has_its_day_and_excuses_no_later_change(self):
        self.run_with(bearing(), "--update")
        before = self.table.read_text(encoding="utf-8")
        status, _ = self.run_with(bearing(h_min=2.1e-5), "--update")
        self.assertEqual((status, self.table.read_text(encoding="utf-8")), (1, before))  # no reason: nothing written
        self.assertEqual(self.run_with(bearing(h_min=2.1e-5), "--update", "--why", "first")[0], 0)
        row = self.rows()[EXAMPLE, COMMAND, "h_min"]
        self.assertRegex(row[key_figures.WHY], r"^\d{4}-\d\d-\d\d: first$")
        self.assertEqual(row["unreleased"], "2.1e-05")
        self.assertEqual(self.rows()[EXAMPLE, COMMAND, "load"][key_figures.WHY], "")
        self.assertEqual(self.run_with(bearing(h_min=2.1e-5))[0], 0)
        self.assertEqual(self.run_with(bearing(h_min=2.2e-5))[0], 1)

    def test_a_figure_that_appears_needs_a_reason_and_a_new_command_none(self):
        self.run_with(bearing(), "--update")
        more = bearing(moment_x={"value": 2.0, "unit": "N.m", "name": "moment"})
        self.assertEqual(self.run_with(more, "--update")[0], 1)
        self.assertEqual(self.run_with(more, "--update", "--why", "tilted")[0], 0)
        self.assertTrue(self.rows()[EXAMPLE, COMMAND, "moment_x"][key_figures.WHY].endswith("tilted"))
        old = rules.COMMANDS[EXAMPLE]
        self.addCleanup(rules.COMMANDS.__setitem__, EXAMPLE, old)
        rules.COMMANDS[EXAMPLE] = [("bearing", "load=1kN")]
        self.assertEqual(self.run_with(more, "--update")[0], 0)
        self.assertEqual({(key[1], row[key_figures.WHY]) for key, row in self.rows().items()}, {("bearing --set load=1kN", "")})

    def test_after_a_release_a_new_column_begins_and_the_old_one_stays(self):
        self.run_with(bearing(), "--update")
        self.release("1.0.0")
        self.assertEqual(self.run_with(bearing())[0], 0)
        self.run_with(bearing(load=1400.0), "--update", "--why", "heavier")
        table = key_figures.Table.read(self.table)
        self.assertEqual(table.columns[4:], ["1.0.0", "unreleased", key_figures.WHY])
        row = table.rows[EXAMPLE, COMMAND, "load"]
        self.assertEqual((row["1.0.0"], row["unreleased"]), ("1300", "1400"))

    def test_an_update_of_some_leaves_other_examples_and_drops_those_that_are_gone(self):
        other = dict(zip(key_figures.KEYS, ("lemon_bore/model", "bearing", "load", "N"))) | {"unreleased": "1500"}
        key_figures.Table(rows=[other, other | {"example": "thrust_pad/model"}]).write(self.table)
        self.assertEqual(self.run_with(bearing(), "--update")[0], 0)
        self.assertEqual({key[0] for key in self.rows()}, {EXAMPLE, "lemon_bore/model"})

    def test_two_programs_are_compared_and_what_the_other_cannot_run_is_named(self):
        other = self.program(bearing(load=1200.0), "other")
        status, text = self.run_with(bearing(), "--against", other)
        self.assertEqual(status, 1)
        self.assertIn("load: before 1200, after 1300 (+0.083)", text)
        self.assertIn(f"largest relative difference 8.3e-02: {EXAMPLE}, {COMMAND}: load", text)
        self.assertIn("every number the same to the last bit", self.run_with(bearing(), "--against", self.program(bearing(), "same"))[1])
        status, text = self.run_with(bearing(), "--against", self.program(None, "old"))
        self.assertEqual(status, 0, text)
        self.assertIn("skipped", text)
        self.assertIn(EXAMPLE, text)
        self.assertFalse(self.table.exists())

    def test_a_program_that_fails_fails_the_comparison(self):
        self.run_with(bearing(), "--update")
        status, text = self.run_with(None)
        self.assertEqual(status, 1)
        self.assertIn("no such key", text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
