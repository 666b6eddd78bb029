"""`hersey study`, called by the program with its own path."""

import argparse
import contextlib
import json
import os
import signal
import sys

OK, FAILED, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130
# Of a plan: more than anyone reads.
MOST_SHOWN = 1000


def arguments():
    parser = argparse.ArgumentParser(prog="hersey study")
    parser.add_argument("model")
    parser.add_argument("--program", required=True)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--out", default="")
    parser.add_argument("--on", choices=("local", "slurm"), default="local")
    parser.add_argument("--jobs", type=int, default=0)
    parser.add_argument("--chunk", type=int, default=0)
    parser.add_argument("--partition", default="")
    parser.add_argument("--runner", default="")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--plan", default="", metavar="FILE")
    parser.add_argument("--text", default="")
    return parser.parse_args()


def say(text):
    if text:
        sys.stderr.write(f"hersey: {text}\n")


def has_packages(settings):
    """Refused before anything is computed, not when it is all done."""
    import importlib.util

    from .study import is_drawn

    needs = {"numpy": "python3-numpy", "scipy": "python3-scipy"}
    if is_drawn(settings):
        needs["openturns"] = "python3-openturns"
    if settings["plan"] == "optimise":
        needs["nlopt"] = "python3-nlopt"
    lacking = [package for module, package in needs.items() if importlib.util.find_spec(module) is None]
    if lacking:
        say(f"Python ({sys.executable}) lacks {', '.join(lacking)}: `scripts/setup study` installs what studies use")
    return not lacking


def plan_shown(settings, texts, identity=None):
    """A plan for who looks at it: its first runs with their values, and their names where `identity` gives them."""
    runs = [{"values": list(values), **({"run": identity(values)} if identity else {})} for values in texts[:MOST_SHOWN]]
    return {"plan": settings["plan"], "samples": settings["samples"], "analysis": settings["analysis"],
            "parameters": [{"name": p["name"], "unit": p["unit"]} for p in settings["parameters"]],
            "objectives": settings["objectives"], "constraints": [c["text"] for c in settings["constraints"]],
            "wanted": settings["wanted"], "runs": runs, "total": len(texts)}


def tell_plan(study, texts):
    """Leaves the plan in the study's folder. It is for who looks at the runs as they come: without room for it the study
    goes on, as far as its records have room."""
    try:
        study.folder.write_json("plan.json", plan_shown(study.settings, texts, study.identity))
    except OSError:
        with contextlib.suppress(OSError):
            os.remove(study.folder.file("plan.json.new"))


def write_plan(settings, path):
    """Writes the runs that a study would do, none of which is done. An optimum's follow from each other: there are none."""
    from . import plan
    from .study import StudyError

    needs_packages = settings["plan"] not in ("full_factorial", "list", "corners", "optimise")
    if needs_packages and not has_packages(settings):
        return FAILED
    try:
        texts = [] if settings["plan"] == "optimise" else plan.runs(settings)
    except plan.PlanError as error:
        raise StudyError(str(error)) from None
    text = json.dumps(plan_shown(settings, texts)) + "\n"
    if path == "-":
        sys.stdout.write(text)
        return OK
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return OK


def work(args):
    from . import slurm
    from .study import Study, StudyError, default_folder, load
    from .table import Table

    settings = load(args.program, args.model, args.set, args.runner, args.text)
    if args.plan:
        return write_plan(settings, args.plan)
    if not has_packages(settings):
        return FAILED
    folder = args.out or default_folder(args.model)
    with Study(settings, folder) as study:
        study.folder.write_json("study.json", {k: v for k, v in settings.items() if k not in ("program", "checked")})
        jobs = args.jobs or len(os.sched_getaffinity(0))
        if settings["plan"] == "optimise":
            if args.on != "local":
                raise StudyError("--on slurm with the plan 'optimise', whose runs follow from each other; expected "
                                 "--on local")
            from . import optimise

            tell_plan(study, [])
            study.table = Table(0, 0, settings["wanted"], study.folder.units)
            texts = optimise.search(study, jobs)
        else:
            texts = study.planned()
            tell_plan(study, texts)
            done = study.folder.done(failed_too=not args.again)
            reused = len({study.identity(t) for t in texts} & done)
            study.table = Table(len(texts), reused, settings["wanted"], study.folder.units)
            if args.on == "slurm":
                slurm.run(study, texts, args)
            else:
                study.run(texts, jobs, args.again)
        study.table.close()
        results = study.collect(texts)
        from . import page

        return page.finish(study, results, args)


def main():
    args = arguments()
    # One processor each for the runs, and none for threads that BLAS would start with NumPy.
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    from .folder import FolderError
    from .study import StudyError
    from .workers import RunnerError

    try:
        return work(args)
    except KeyboardInterrupt:
        say("stopped; every finished run is kept, and the same command goes on")
        return INTERRUPTED
    except OSError as error:
        say(f"{error.filename or args.out or 'the study'}: {error.strerror}; what is finished is kept, and the same "
            "command goes on")
        return FAILED
    except (StudyError, FolderError, RunnerError) as error:
        say(str(error))
        return WRONG_INPUT


if __name__ == "__main__":
    sys.exit(main())
