"""What a finished study leaves: a table of runs, its statistics as JSON, a page, and a few lines for who waits."""

import csv
import json
import os
import subprocess
import sys

from . import courses, spectra, statistics
from .study import is_drawn

# A page with more runs than this is no page; statistics see all of them.
MOST_RUNS_SHOWN = 5000


def finish(study, results, args):
    """Writes and prints the results. Returns the program's exit code."""
    settings = study.settings
    if not results.runs:
        sys.stderr.write(f"hersey: no run of {len(results.texts)} has an answer\n")
        for reason in list(results.failed.values())[:3]:
            sys.stderr.write(f"hersey: {reason}\n")
        return 1
    summary = statistics.summary(results)
    write_table(study.folder.file("runs.csv"), results)
    data = page_data(settings, results, summary, study.folder)
    if study.search:
        data["search"] = study.search
    if data.get("bands"):
        courses.write_table(study.folder.file("bands.csv"), data["bands"])
    study.folder.write_json("results.json", data)
    page = study.folder.file("study.html")
    command = [settings["program"], "study-page", study.folder.file("results.json"), page]
    code = 0 if subprocess.run(command, check=False).returncode == 0 else 1
    if args.json:
        print(json.dumps(data, indent=1))
    else:
        tell(results, summary)
        if study.search:
            print(search_text(study.search))
        print(f"study:   {study.folder.path}\nreport:  {page}")
    if results.failed:
        sys.stderr.write(f"hersey: {len(results.failed)} of {len(results.texts)} runs failed, for the reasons above or "
                         "in records.jsonl; --again does them again\n")
    return code if not results.failed and not results.missing else 1


def write_table(path, results):
    """One row per run: values as written, figures in their units."""
    values = results.outputs()
    with open(path + ".new", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        units = [f"{n} [{results.units[n]['unit'] or '1'}]" for n in results.names]
        table.writerow([*(p["name"] for p in results.settings["parameters"]), *units, "run"])
        for run, row in zip(results.runs, values):
            table.writerow([*results.texts[run], *(f"{v:.10g}" for v in row), run])
    os.replace(path + ".new", path)


def plain(value):
    """NaN is null in JSON."""
    if isinstance(value, float):
        return value if value == value and abs(value) != float("inf") else None
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value


def page_data(settings, results, summary, folder):
    """What the page shows; web/src/sampling_data.ts names the same keys."""
    shown = list(range(min(len(results.runs), MOST_RUNS_SHOWN)))
    inputs, outputs, feasible = results.inputs(), results.outputs(), results.is_feasible()
    runs = [{"run": results.runs[i], "texts": results.texts[results.runs[i]], "inputs": inputs[i].tolist(),
             "outputs": outputs[i].tolist(), "feasible": bool(feasible[i]),
             "seconds": results.found[results.runs[i]]["seconds"],
             "report": relative(results.found[results.runs[i]]["report"], folder)} for i in shown]
    reasons = {}
    for reason in results.failed.values():
        reasons[reason] = reasons.get(reason, 0) + 1
    data = {"title": settings["title"] or os.path.basename(settings["model"]), "model": settings["model"],
            "version": settings["version"], "plan": settings["plan"], "analysis": settings["analysis"],
            "set": settings["set"], "planned": len(results.texts), "completed": len(results.runs),
            "failed": [{"reason": r, "count": c} for r, c in reasons.items()],
            "parameters": [{"name": p["name"], "unit": p["unit"], "values": p["values"], "numbers": p["numbers"],
                            "is_words": any(n is None for n in p["numbers"]), "distribution": p.get("distribution")}
                           for p in settings["parameters"]],
            "objectives": settings["objectives"],
            "constraints": [{"text": c["text"], "name": c["name"], "lower": c["lower"], "bound": results.bound(c)}
                            for c in settings["constraints"]],
            "runs": runs, **summary}
    if settings["diagram"] == "campbell":
        data["campbell"] = spectra.campbell(results)
    if settings["diagram"] == "run_up":
        data["run_up"] = spectra.run_up(results, folder)
    if settings["analysis"] == "simulation" and is_drawn(settings):
        data["bands"] = courses.bands(results, folder)
    return plain(data)


def relative(report, folder):
    return os.path.relpath(report, folder.path) if report else ""


def search_text(search):
    """How the best was looked for, in a line."""
    how = "with exact derivatives" if search["derivatives"] == "exact" else f"without derivatives: {search['reason']}"
    return f"search:  {' and '.join(search['methods'])} of NLopt, {search['runs']} runs, {how}"


def tell(results, summary):
    """The figures in a few lines."""
    settings = results.settings
    names = [p["name"].split(".")[-1] for p in settings["parameters"]]
    print(f"{len(results.runs)} runs")
    for figure in summary["figures"]:
        spread = figure["scatter"]
        if spread is None:
            continue
        unit = f" {figure['unit']}" if figure["unit"] else ""
        p = spread["percentiles"]
        print(f"{figure['key']}: {spread['mean']:.5g} ± {spread['standard_deviation']:.3g}{unit}, "
              f"5 % {p['5']:.5g}, 50 % {p['50']:.5g}, 95 % {p['95']:.5g}, "
              f"from {spread['smallest']:.5g} to {spread['largest']:.5g}")
        model = figure["surrogate"]
        if model:
            shares = ", ".join(f"{n} {a:.3f} ({b:.3f})" for n, a, b in zip(names, model["first"], model["total"]))
            print(f"  Sobol indices, first order (total): {shares}")
            print(f"  surrogate of {model['terms']} terms, cross-validated error "
                  f"{100 * model['cross_validated_error']:.2g} % of the variance")
    if settings["objectives"]:
        best = summary["best"]
        if not best:
            print("no run keeps to every bound of subject_to")
        for run in best[:10]:
            values = results.outputs()[results.runs.index(run)]
            texts = ", ".join(f"{n} = {t}" for n, t in zip(names, results.texts[run]))
            figures = ", ".join(f"{n} {v:.5g} {results.units[n]['unit']}".rstrip()
                                for n, v in zip(results.names, values))
            print(f"{'best' if len(settings['objectives']) == 1 else 'not beaten'}: {texts}: {figures}")
