#!/usr/bin/python3
"""Stands in for the program: answers runs by Ishigami's function of x1, x2 and x3, and by a parabola's valley.

ishigami.py [LOG [SECONDS [slopes]]]   writes each run that it does into LOG, and takes so long for it; `slopes`: tells the
derivatives of the valley where it is asked for them, `some_slopes`: only where x1 is below 1.7.
Values of x1 above 100 are refused, and above 200 end the program.
"""

import json
import math
import os
import sys
import time

LOG = sys.argv[1] if len(sys.argv) > 1 else os.devnull
SECONDS = float(sys.argv[2]) if len(sys.argv) > 2 else 0.0

for line in sys.stdin:
    run = json.loads(line)
    x = {name: float(text) for name, text in (item.split("=") for item in run["set"])}
    x1, x2, x3 = x["x1"], x.get("x2", 0.0), x.get("x3", 0.0)
    if x1 > 200:
        os.abort()
    time.sleep(SECONDS)
    with open(LOG, "a", encoding="utf-8") as log:
        log.write(run["run"] + "\n")
    if x1 > 100:
        answer = {"run": run["run"], "status": "failed", "error": "x1 is too large"}
    else:
        figures = {"y": math.sin(x1) + 7 * math.sin(x2) ** 2 + 0.1 * x3**4 * math.sin(x1),
                   "valley": (x1 - 2) ** 2 + (x2 - 1) ** 2, "sum": x1 + x2}
        answer = {"run": run["run"], "status": "completed", "figures": figures, "seconds": SECONDS}
        if "slopes" in run and sys.argv[-1].endswith("slopes"):
            if sys.argv[-1] == "some_slopes" and x1 >= 1.7:
                answer["no_slopes"] = "x1 is beyond 1.7"
            else:
                answer["slopes"] = {"x1": {"valley": 2 * (x1 - 2), "sum": 1.0}, "x2": {"valley": 2 * (x2 - 1), "sum": 1.0},
                                    "x3": {"valley": 0.0, "sum": 0.0}}
    print(json.dumps(answer), flush=True)
