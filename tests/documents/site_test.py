#!/usr/bin/python3
"""site_test.py SOURCE   what the documentation site is made of: plain notation becomes LaTeX, pictures are as they were drawn, every
page is in the menu. The built site is checked by `make docs`."""

import glob
import os
import re
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))
sys.path.insert(0, os.path.join(SOURCE, "scripts/site"))
import inline  # noqa: E402
import notation  # noqa: E402


def read(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


def squeezed(tex):
    return re.sub(r"\s+", "", tex)


class Notation(unittest.TestCase):
    def assert_tex(self, plain, tex):
        self.assertEqual(squeezed(notation.convert(plain)), squeezed(tex), plain)

    def test_fractions_hold_one_factor_on_either_side(self):
        self.assert_tex("-h^3/(12 mu) dp/dx", r"- \frac{h^{3}}{12 \mu} \frac{\mathrm{d}p}{\mathrm{d}x}")
        self.assert_tex("m/3 a_a", r"\frac{m}{3} a_{a}")

    def test_x_between_operands_is_a_cross_product_and_else_a_name(self):
        self.assert_tex("omega x r", r"\omega \times r")
        self.assert_tex("K x + D", r"K x + D")

    def test_indices_and_dots(self):
        self.assert_tex("a_n+1 - vdot_n", r"a_{n+1} - \dot{v}_{n}")
        self.assert_tex("p_cav, r_b,W", r"p_{\mathrm{cav}}, r_{b,W}")

    def test_sums_name_what_they_are_over(self):
        self.assert_tex("sum over films of Q_i", r"\sum_{\text{ films }} Q_{i}")

    def test_words_stay_words(self):
        self.assert_tex("u < 0 is slack", r"u < 0 \text{ is slack }")

    def test_numbers_of_equations_are_not_part_of_them(self):
        self.assertEqual([number for _, number in notation.lines_of("    a = b,      (film.3)\n    c = d\n")], ["film.3", None])

    def test_formulas_in_sentences_end_where_words_begin(self):
        marked = inline.replace("In a gap h that is thin, p_cav = 0 and theta <= 1; `h = 1` is code.", lambda formula: f"<{formula}>")
        self.assertEqual(marked, "In a gap <h> that is thin, <p_cav = 0> and <theta <= 1>; `h = 1` is code.")


class Pages(unittest.TestCase):
    def test_every_page_is_in_the_menu(self):
        menu = set(re.findall(r"[\w/.-]+\.md", read("mkdocs.yml")))
        pages = {os.path.relpath(path, os.path.join(SOURCE, "docs")) for path in glob.glob(os.path.join(SOURCE, "docs/**/*.md"), recursive=True)}
        self.assertEqual(sorted(pages - menu), [], "pages of docs/ that mkdocs.yml does not name")
        self.assertEqual(sorted(menu - pages), [], "pages that mkdocs.yml names and docs/ does not hold")

    def test_pages_show_pictures_that_exist(self):
        shown = 0
        for page in glob.glob(os.path.join(SOURCE, "docs/**/*.md"), recursive=True):
            with open(page, encoding="utf-8") as file:
                for picture in re.findall(r"!\[[^\]]+\]\(([^)]+)\)", file.read()):
                    shown += 1
                    self.assertTrue(os.path.exists(os.path.join(os.path.dirname(page), picture)), f"{page}: {picture}")
        self.assertGreater(shown, 8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
