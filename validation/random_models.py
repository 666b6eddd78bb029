#!/usr/bin/python3
"""400 random steady bearings and 200 random machines: how each ended and which invariants hold (docs/random-models.md).

    random_models.py HERSEY OUTPUT
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "random"))

import random_models  # noqa: E402

if __name__ == "__main__":
    hersey, output = sys.argv[1:3]
    sys.argv = [sys.argv[0], hersey, "--steady", "400", "--machines", "200", "--seed", "1",
                "--output", os.path.join(output, "random-models")]
    sys.exit(random_models.main())
