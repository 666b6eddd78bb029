#!/usr/bin/python3
"""Every number that `hersey bearing` prints is of second order in the grid, but for those with a reason.

    order_test.py HERSEY [Order.test_name]
"""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import models  # noqa: E402
import order  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))


class Order(unittest.TestCase):
    def test_every_number_is_of_second_order(self):
        for name, cavitation in order.CASES:
            if name == "GLOBAL":
                continue  # takes longer: all_pairs.py
            with self.subTest(name, cavitation=cavitation), tempfile.TemporaryDirectory(prefix="hersey-order-") as folder:
                self.assertEqual(list(order.lower(HERSEY, models, name, cavitation, folder)), [])

    def test_an_error_that_does_not_fall_is_reported(self):
        found = order.Order({"load": 100.0, "h_min": 1.0}, [{"load": 101.0, "h_min": 1.4}], [{"load": 99.0, "h_min": 1.1}])
        self.assertEqual({key: round(rate, 6) for key, _, _, rate in found.rows()}, {"load": 0.0, "h_min": 2.0})


if __name__ == "__main__":
    unittest.main()
