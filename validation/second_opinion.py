#!/usr/bin/python3
"""150 random bearings by the program and by the second film solver of verification/second_film (docs/validation.md).

    second_opinion.py HERSEY OUTPUT
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "second_opinion"))

import second_opinion  # noqa: E402

if __name__ == "__main__":
    hersey, output = sys.argv[1:3]
    sys.argv = [sys.argv[0], hersey, "--count", "150", "--seed", "1", "--output", os.path.join(output, "second-opinion")]
    sys.exit(second_opinion.main())
