#!/usr/bin/python3
"""Pairs of machines with the same results, defaults, numbers that act and absurd numbers, all of them (docs/random-models.md).

    machine_pairs.py HERSEY OUTPUT
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../tests/metamorphic"))

import all_pairs  # noqa: E402

if __name__ == "__main__":
    sys.argv = sys.argv[:2]
    sys.exit(all_pairs.main())
