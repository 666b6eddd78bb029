#!/usr/bin/python3
"""Plants faults, one at a time, each in one line of physics or numerics, and tells which of them no test notices.

Works on a copy of the sources and a build of its own below build/mutations, so that neither sources nor build of the
user are touched. A fault is tried on the tests most likely to see it first, then on those of every module that depends
on the one that has it, then on those of the program; quick tests first. A module with a fault is compiled one source at a time. All faults are real changes of
behaviour: one that survives is a test that is missing.

Usage: mutations.py [--only REGEX] [--jobs N] [--list] [--check]     as `make mutations`
       mutations.py --drawn N [--seed SEED] [--modules A,B] ...         as `make mutations DRAWN=N SEED=...`
exit code 0 if all faults were caught, 1 if any survives, 2 if a fault has to be re-pointed or does not compile
--only: faults whose names match; --list: the faults, nothing else; --check: that each is found where it says
--drawn: N faults of each module by machine (mutation_operators.py) in place of the planted ones: a comparison, sign, constant, term, bound
or connective changed. Exit code 1 if more than 5 % of those that compile survive. A drawn change that is no fault (EQUIVALENT) is listed with its
reason and not tried.
--near: tests of the fault's own module only, for a first look
--within: tests of these modules only, those of the fault's own first: a sample of all four that fits into an hour. What survives them is looked
at, or tried again without it by --only and the same seed
"""

import argparse
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
import time
from typing import NamedTuple

import mutation_operators

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WORK = os.path.join(SOURCE, "build/mutations")
COPY, LOG, COSTS = os.path.join(WORK, "sources"), os.path.join(WORK, "log"), os.path.join(WORK, "costs.json")
BUILD = os.path.join(COPY, "build/release")  # where a clone has it: ccache knows what the user has compiled
PROGRAM = ["results_file", "defects", "cli"]  # tests of the whole, tried last
DRAWN_MAY_SURVIVE = 0.05  # of faults by machine
TIME_LIMIT = 100  # s of a processor that one test may take: a fault may turn an iteration into an endless one
QUICK = (0.2, 2)  # s of tests that are asked before those that take longer
# Ahead of a file with a fault: what compilers say of a && b || c, or of a name that nothing asks any longer, is no verdict.
UNWARNED = "#ifdef __clang__\n#pragma clang diagnostic ignored \"-Weverything\"\n#endif\n"


class Fault(NamedTuple):
    name: str    # "module: what"
    file: str    # below libs/
    old: str     # text that occurs once in it
    new: str
    tests: str = ""  # regex of the modules, "film.", whose tests are tried first; the fault's own where empty
    equivalent: str = ""  # why it is no fault, though drawn

    @property
    def module(self):
        return self.file.split("/")[0]


FAULTS = [
    # -- film
    Fault("film: sign of squeeze", "film/src/balance/film_storage.cpp",
          "return area_[i] * ((g_rate_[i] + rate_excesses_[i])",
          "return area_[i] * (-(g_rate_[i] + rate_excesses_[i])"),
    Fault("film: wedge of a shell that turns", "film/src/balance/flow_balance.cpp",
          "speed_phi_ = 0.5 * (motion.u_shell + motion.u_journal);",
          "speed_phi_ = 0.5 * (motion.u_journal - motion.u_shell);"),
    Fault("film: twelve of the pressure flow", "film/src/balance/face_loop.cpp",
          "shape.unit = shape.width / (12.0 *", "shape.unit = shape.width / (6.0 *"),
    Fault("film: slope of the gap's cube", "film/src/balance/face_law.h",
          "gap.cube_h = 3.0 * square;", "gap.cube_h = 2.0 * square;"),
    Fault("film: shear in the cavity", "film/src/observe/film_wrench.cpp",
          "couette = node.sheared_fraction * node.mu / node.h;", "couette = node.mu / node.h;"),
    Fault("film: flow factor of Patir and Cheng, digits", "film/src/gap/flow_factors.cpp",
          "{1.38, 0.42, 1.0}", "{1.39, 0.42, 1.0}"),
    Fault("film: stress factor of Patir and Cheng, digits", "film/src/gap/flow_factors.cpp",
          "{10.1, 2.25, 2.90, 0.18}", "{10.1, 2.25, 2.80, 0.18}"),
    Fault("film: power of Greenwood and Tripp's fit", "film/src/gap/greenwood_tripp.cpp", "b = 6.804;", "b = 6.408;"),
    Fault("film: viscosity falls with pressure", "film/src/balance/node.cpp",
          "std::exp(-ratio.value)", "std::exp(ratio.value)"),
    Fault("film: dense oil is stored as light oil", "film/src/balance/node.cpp",
          "node.content = node.density * node.theta;", "node.content = node.theta;"),
    Fault("film: liner gives way to the oil only", "film/src/balance/node.cpp",
          "node.w = C * (pressed + node.asperity);", "node.w = C * pressed;"),
    Fault("film: side flows change places", "film/src/balance/flow_balance.h",
          "node % model_.grid.n_z == 0 ? flows.flow_left : flows.flow_right;",
          "node % model_.grid.n_z == 0 ? flows.flow_right : flows.flow_left;"),
    Fault("film: feature's pressure is taken for that above the cavity's", "film/src/balance/supply_rows.cpp",
          "double u = std::max(lowest_supply(static_cast<int>(f)), pressure - model_.p_cav);",
          "double u = std::max(lowest_supply(static_cast<int>(f)), pressure);"),
    Fault("film: restrictor sees the supply's pressure above a vacuum", "film/src/balance/supply_rows.cpp",
          "const double supply = pressure - model_.p_cav;", "const double supply = pressure;"),
    Fault("film: slope of a restrictor left out of the Jacobian", "film/src/balance/restricted_ports.cpp",
          "(port.has_pressure ? restrictor_flow(port).slope : 0)", "(port.has_pressure ? 0 * restrictor_flow(port).slope : 0)"),
    Fault("film: a supply takes back what leaves over an edge in air", "film/src/balance/settle.cpp",
          "out = std::max(out, -coming);  // as", "out = std::max(out, 0.0);  // as", "run."),
    Fault("film: a cavity sheared all over conducts by its oil only", "film/src/heat/heat_equations.cpp",
          "return model_.cavitated_shear == CavitatedShear::full ? 1 :", "return", "run."),
    Fault("film: oil of a recess over a step without its squeeze", "film/src/balance/settle.cpp",
          "if (prescribed.feature == port.feature)", "if (prescribed.feature == port.feature && prescribed.chi < 0)"),
    Fault("film: jet of an orifice by its diameter", "film/src/laws/restrictor.cpp",
          "const double area = std::numbers::pi / 4 * diameter * diameter;", "const double area = std::numbers::pi * diameter * diameter;"),
    Fault("film: land before an edge is as long as a cell", "film/src/balance/land.cpp",
          "1 / land - 1 / flow_tube", "(1 / flow_tube - 1 / flow_tube)"),
    Fault("film: hot oil passes a supply along the edge", "film/src/heat/heat_assembly.cpp",
          ".chi = film.balance.supplied_fraction(node),", ".chi = 1 - film.balance.balance_weight(node),"),
    Fault("film: conductance between supply line and node", "film/src/balance/supply_rows.cpp",
          ".conductance = geometry_.width_z[j] / (12 * geometry_.step(i, j)),",
          ".conductance = geometry_.width_z[j] / (6 * geometry_.step(i, j)),"),
    Fault("film: faces between radii have the width at one of them", "film/src/gap/grid_geometry.cpp",
          "stretch_between[j] = stretch_at(z[j] + above);", "stretch_between[j] = stretch_at(z[j]);"),
    Fault("film: a pad's last edge is its first", "film/include/hersey/film/film_model.h",
          "const Edge& of_line = grid.begins_patch(line) ? ends.first : ends.last;", "const Edge& of_line = ends.first;"),
    # -- bearing
    Fault("bearing: sign of the shear by pressure", "film/src/observe/film_wrench.cpp",
          "area * sheared(s.couette[0] * slip[0] - s.half_gap[0] * p_phi,",
          "area * sheared(s.couette[0] * slip[0] + s.half_gap[0] * p_phi,", r"^(film|bearing)\."),
    Fault("bearing: lever of the load about the journal's axis", "film/src/observe/observables.cpp",
          "+ e.x() * on_shell[4] - e.y() * on_shell[3];", "- e.x() * on_shell[4] + e.y() * on_shell[3];",
          r"^(film|bearing)\."),
    Fault("circuit: the head of rotation the other way", "circuit/src/circuit.cpp",
          "(element.r_to * element.r_to - element.r_from * element.r_from);",
          "(element.r_from * element.r_from - element.r_to * element.r_to);"),
    Fault("circuit: what a node stores is a source", "circuit/src/circuit.cpp",
          "balance.surplus[i] -= stored;", "balance.surplus[i] += stored;"),
    Fault("circuit: what leaves a node that lacks oil is full", "circuit/src/circuit.cpp",
          "through.value += upstream.fill * full.value;", "through.value += full.value;"),
    Fault("circuit: a film on a node that lacks oil is full", "bearing/src/force/oil_circuit.cpp",
          "film.film->model().p_cav) - lack;", "film.film->model().p_cav);", r"^(bearing|run)\."),
    Fault("circuit: oil that a rotating bore brings inwards brakes it", "circuit/src/circuit.cpp",
          "network_.oil.density * flow(element, p, conditions).value * speed *",
          "network_.oil.density * std::abs(flow(element, p, conditions).value) * speed *"),
    Fault("circuit: a film does not answer to the circuit's pressures", "bearing/src/force/film_force.cpp",
          "film.wrench += film.wrench_by_s.rightCols(ports) * dp;", "film.wrench -= film.wrench_by_s.rightCols(ports) * dp;",
          r"^(bearing|run)\."),
    Fault("circuit: a hole that passes a groove does not answer to the journal's angle", "bearing/src/force/oil_circuit.cpp",
          "    add_passing_holes(f, p, rhs);\n", "", r"^(bearing|run)\."),
    Fault("bearing: force on the journal is that on the shell", "bearing/src/force/film_force.cpp",
          "response.W_B_A = -film.wrench;", "response.W_B_A = film.wrench;"),
    Fault("bearing: relative velocity along z off the centre", "bearing/src/kinds/journal/journal_kinematics.cpp",
          "velocity.z() + omega.x() * k.value[kEy] - omega.y() * k.value[kEx];",
          "velocity.z() - omega.x() * k.value[kEy] + omega.y() * k.value[kEx];"),
    Fault("bearing: a pad sees only its own wear of the journal", "bearing/src/force/wearing_surfaces.cpp",
          "moving += film->of_moving(film->worn_);", "if (film == this) moving += film->of_moving(film->worn_);", "run."),
    Fault("bearing: wear of coefficient 0 moves the smallest film to a node", "bearing/src/force/wearing_surfaces.h",
          "return wear_.fixed.coefficient > 0 || wear_.moving.coefficient > 0 || common_ != nullptr;", "return true;", "run."),
    Fault("bearing: a journal's shape turns backwards", "bearing/src/kinds/journal/rigid_surfaces.cpp",
          "motion.g_rate += omega * first_;", "motion.g_rate -= omega * first_;"),
    Fault("bearing: damping over the load without the speed", "bearing/src/steady/bearing_numbers.cpp",
          "(c * omega / W);", "(c * (omega / omega) / W);"),
    # -- mbd
    Fault("mbd: gyroscopic term", "mbd/src/tree/inertia.cpp", "F_[l] = IA + Vh;", "F_[l] = IA;"),
    Fault("mbd: row of a universal joint", "mbd/src/tree/joint_kind.cpp",
          ".rows = {{t1}, {t2}, {axis}, {t1, t2}}},", ".rows = {{t1}, {t2}, {axis}, {t1, axis}}},"),
    Fault("mbd: lever of a reaction", "mbd/src/mechanism/observe.cpp",
          "(through[j].head<3>() - X_WI.r.cross(f));", "through[j].head<3>();"),
    Fault("mbd: Coriolis force of a deforming body", "mbd/src/elastic/modal_body.cpp",
          "w.Omega * w.S + 2 * omega.cross(w.S_rate) + w.S_acc;", "w.Omega * w.S + omega.cross(w.S_rate) + w.S_acc;"),
    Fault("mbd: moment of a contact", "mbd/src/contact/contact.cpp",
          "response.W_B_A.head<3>() += point.position.cross(f);", "response.W_B_A.head<3>() -= point.position.cross(f);"),
    Fault("mbd: curvature of a coupling", "mbd/src/tree/coupling.cpp",
          "bias -= input.curvature(state) * v * v;", "bias += input.curvature(state) * v * v;"),
    # -- solver
    Fault("solver: gamma of the integrator", "solver/include/hersey/solver/alpha_parameters.h",
          "gamma(0.5 + alpha_f - alpha_m),", "gamma(0.5 - alpha_f + alpha_m),"),
    Fault("solver: beta of the integrator", "solver/include/hersey/solver/alpha_parameters.h",
          "beta(0.25 * (gamma + 0.5) * (gamma + 0.5)) {}", "beta(0.25 * gamma * gamma) {}"),
    Fault("solver: share of the estimated error", "solver/src/generalized_alpha.cpp",
          "0.5 * gamma - beta - 1.0 / 12;", "0.5 * gamma - beta - 1.0 / 6;"),
    Fault("solver: order of the step's error", "solver/include/hersey/solver/step_control.h",
          "double order = 3;", "double order = 2;"),
    Fault("solver: weight of a stage of the explicit method", "solver/src/dormand_prince.cpp",
          "trial.v = state.v + change.tail(nv);\n    if (!assemble", "trial.v = state.v;\n    if (!assemble"),
    # -- fem
    Fault("fem: averaging frames beside rigid ones", "fem/src/reduction/frame_interface.cpp",
          "interface.motion - interface.C * interface.prescribed;", "interface.motion;"),
    Fault("fem: slope of a quadratic shape function", "fem/src/element/interpolation.cpp",
          "s.dN.row(a) = (4 * b.L[a] - 1) * b.dL.row(a);", "s.dN.row(a) = (4 * b.L[a] - 2) * b.dL.row(a);"),
    Fault("fem: mass without the element's size", "fem/src/element/solid_element.cpp",
          "m.noalias() += weight * J.determinant() * shape.N", "m.noalias() += weight * (J.determinant() / J.determinant()) * shape.N"),
    Fault("fem: film temperatures without the film's mean", "fem/src/surface/face_temperatures.cpp",
          "return T.array() + mean_of_film - mean(T);", "return T.array() + mean_of_film;"),
    Fault("fem: shift of the natural modes", "fem/src/reduction/vibration.cpp",
          "const double omega_squared = shift + 1 / lanczos.theta[k];",
          "const double omega_squared = 1 / lanczos.theta[k];"),
    # -- model
    Fault("model: products of inertia change places", "model/src/interpret/machine/interpret_mechanism.cpp",
          "(Matrix3() << xx, xy, zx, xy, yy, yz, zx, yz, zz).finished();",
          "(Matrix3() << xx, zx, xy, zx, yy, yz, xy, yz, zz).finished();"),
    Fault("model: diametral clearance is taken for radial", "model/src/interpret/bearings/kinds/journal.cpp",
          'number_of(value_, "diametral_clearance") / 2', 'number_of(value_, "diametral_clearance")'),
    # -- run, results, study
    Fault("run: a checkpoint forgets the last step's length", "run/src/time_stepping/time_stepper.cpp",
          'archive.io("length", last_dt_), archive.io("rejected", rejected_);', 'archive.io("rejected", rejected_);'),
    Fault("run: energy of a cycle", "run/src/cycle/bearing_cycle.cpp",
          "cycle_.energy_film += 0.5 * dt * (last_.power_film + next.power_film);",
          "cycle_.energy_film += dt * (last_.power_film + next.power_film);"),
    Fault("results: unit of the oil's volume", "bearing/src/quantities/film_quantities.cpp",
          '{"oil_volume", "", "m^3",', '{"oil_volume", "", "m^3/s",', r"^run\."),
    Fault("study: revolutions per minute", "study/src/figure_table.h",
          'kRpm{"rpm", "rad/s", std::numbers::pi / 30};', 'kRpm{"rpm", "rad/s", std::numbers::pi / 60};'),
]


class Failure(Exception):
    """Says what the script cannot go on with."""


def sources():
    """Files that a clone has or will have, with changes that are not committed yet."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=SOURCE,
                            capture_output=True, check=True).stdout.decode()
    return [path for path in listed.split("\0") if path and os.path.isfile(os.path.join(SOURCE, path))]


def content_of(path):
    with open(path, "rb") as file:
        return file.read()


def copy_sources():
    """Brings the copy up to date and touches nothing that is: what was built of it serves."""
    wanted = set(sources())
    for folder, folders, names in os.walk(COPY):
        if folder == COPY and "build" in folders:
            folders.remove("build")
        for name in names:
            path = os.path.join(folder, name)
            if os.path.relpath(path, COPY) not in wanted:
                os.remove(path)
    for path in wanted:
        here, there = os.path.join(SOURCE, path), os.path.join(COPY, path)
        if os.path.isfile(there) and content_of(here) == content_of(there):
            continue
        os.makedirs(os.path.dirname(there), exist_ok=True)
        shutil.copy(here, there)


def dependents():
    """module -> itself and those that depend on it and have tests, from the lowest floor to the highest."""
    with open(os.path.join(SOURCE, "CMakeLists.txt"), encoding="utf-8") as file:
        text = re.sub(r"#.*", "", file.read())
    below = {}
    for name, rest in re.findall(r"^hersey_module\((\w+)([^)]*)\)", text, re.MULTILINE):
        named = re.search(r"DEPENDS((?:\s+[a-z]+)*)", rest)
        below[name] = {name}.union(*(below[m] for m in (named[1].split() if named else [])))
    tested = [name for name in below if os.path.isdir(os.path.join(SOURCE, "libs", name, "test"))]
    return {name: [m for m in tested if name in below[m]] for name in below}


def misplaced(fault):
    """Why the fault cannot be planted, or nothing."""
    path = os.path.join(SOURCE, "libs", fault.file)
    if not os.path.isfile(path):
        return "there is no such file"
    with open(path, encoding="utf-8") as file:
        count = file.read().count(fault.old)
    return "" if count == 1 else f"{count} times in it, expected once: '{fault.old}'"


def check_places(faults):
    wrong = [(fault, why) for fault in faults if (why := misplaced(fault))]
    if wrong:
        raise Failure("faults to re-point in validation/mutations.py:\n" +
                      "\n".join(f"  {fault.name}\n    libs/{fault.file}: {why}" for fault, why in wrong))


def logged(title, command, seconds=None):
    """Runs a command, its output to the log too, each of its processes for so many seconds of a processor at most."""
    limited = ["prlimit", f"--cpu={seconds}"] if seconds else []
    run = subprocess.run(limited + command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                         cwd=COPY, check=False, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})  # tests run beside each other
    with open(LOG, "a", encoding="utf-8") as log:
        log.write(f"\n==== {title}: {' '.join(command)}\n{run.stdout}")
    return run


def program_of(module):
    return os.path.join(BUILD, f"{module}_test")


class Trial:
    """The copy, with one fault or none."""

    def __init__(self, jobs, is_near=False, within=()):
        self.jobs, self.is_near, self.within, self.costs = jobs, is_near, within, {}

    def configure(self, one_by_one):
        """Several sources are compiled as one, which ccache may know from the user's build, but for those of the modules `one_by_one`."""
        run = logged("configure", ["scripts/compiler", "cmake", "--preset", "release", "-DHERSEY_UNITY=ON",
                                   "-DHERSEY_UNITY_EXCEPT=" + ";".join(one_by_one)])
        if run.returncode:
            raise Failure(f"the copy cannot be configured, see {LOG}:\n{run.stdout[-2000:]}")

    def build(self, title, modules):
        targets = sorted({"hersey" if module in PROGRAM else f"{module}_test" for module in modules})
        return logged(title, ["cmake", "--build", BUILD, "-j", str(self.jobs), "--target", *targets])

    def know_costs(self, modules):
        """Passes the tests of modules in sources without a fault, where what each takes is not known from an earlier run."""
        if os.path.isfile(COSTS):
            with open(COSTS, encoding="utf-8") as file:
                self.costs = json.load(file)
        for module in sorted(set(modules) - set(self.costs)):
            if self.build("no fault", [module]).returncode:
                raise Failure(f"the copy does not compile without a fault, see {LOG}")
            run = logged("no fault", [program_of(module), "--duration=true"])
            if run.returncode:
                raise Failure(f"tests of {module} fail without a fault, see {LOG}")
            self.costs[module] = {name: float(s) for s, name in re.findall(r"^([\d.]+) s: (\S+)$", run.stdout, re.MULTILINE)}
            with open(COSTS, "w", encoding="utf-8") as file:
                json.dump(self.costs, file, indent=1)

    def test(self, title, module):
        """The first tests that fail of a module's, or of those of the program: quick ones are asked first."""
        costs = self.costs.get(module)
        if costs is None:
            return self.run(title, ["-R", rf"^{module}\."])
        for low, high in zip((0, *QUICK), (*QUICK, float("inf"))):
            names = [name for name, cost in sorted(costs.items(), key=lambda item: item[1]) if low <= cost < high]
            parts = [names[k::self.jobs] for k in range(self.jobs)]
            wanted = ["--test-case=" + ",".join(part) for part in parts if part]
            if low == 0:  # and those that are new
                wanted[:1] = ["--test-case-exclude=" + ",".join(name for name in costs if name not in parts[0])]
            if failed := self.run_parts(title, module, wanted):
                return failed
        return []

    def run_parts(self, title, module, wanted):
        """The first tests that fail of some of a module's, each part in a process beside the others."""
        with concurrent.futures.ThreadPoolExecutor(len(wanted) or 1) as pool:
            runs = list(pool.map(lambda which: logged(title, [program_of(module), "--abort-after=1", which], TIME_LIMIT), wanted))
        # A process that is ended from outside may not tell which.
        found = [re.search(r"^TEST CASE: +(\S+)", run.stdout, re.MULTILINE) for run in runs if run.returncode]
        return [f"{module}." + (one[1] if one else "*") for one in found]

    def run(self, title, which):
        """The first tests that fail."""
        run = logged(title, ["ctest", "--test-dir", BUILD, "-j", str(self.jobs), "--stop-on-failure", "--timeout", "1500",
                             "--no-tests=error", "--output-on-failure", *which], TIME_LIMIT)
        if "***Not Run" in run.stdout or "No tests were found" in run.stdout:
            raise Failure(f"{title}: tests that cannot run, see {LOG}")
        failed = re.findall(r"Test +#\d+: (\S+) \.+[^*\n]*\*\*\*", run.stdout)
        if run.returncode and not failed:
            raise Failure(f"{title}: ctest ended with {run.returncode}, see {LOG}")
        return failed

    def plant(self, fault):
        path = os.path.join(COPY, "libs", fault.file)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(UNWARNED + text.replace(fault.old, fault.new))

    def mend(self, fault):
        shutil.copyfile(os.path.join(SOURCE, "libs", fault.file), os.path.join(COPY, "libs", fault.file))

    def verdict(self, fault, modules_above):
        """What became of a fault: caught, survived, broken or equivalent, and the tests that caught it or the reason."""
        if fault.equivalent:
            return "equivalent", [fault.equivalent]
        rest = [fault.module] if self.is_near else modules_above[fault.module] + PROGRAM
        if self.within:
            rest = [module for module in rest if module == fault.module or module in self.within]
        likely = [module for module in rest if re.search(fault.tests or rf"^{fault.module}\.", module + ".")] or rest[:1]
        self.plant(fault)
        try:
            for modules in [likely] + [[module] for module in rest if module not in likely]:
                build = self.build(fault.name, modules)
                if build.returncode:
                    return "broken", [line for line in build.stdout.splitlines() if "error" in line][:3]
                for module in modules:
                    if failed := self.test(fault.name, module):
                        return "caught", failed
            return "survived", []
        finally:
            self.mend(fault)


def try_all(faults, jobs, is_near=False, within=()):
    modules_above = dependents()
    trial = Trial(jobs, is_near, within)
    copy_sources()
    trial.configure(sorted({fault.module for fault in faults if not fault.equivalent}.union(within)))
    trial.know_costs(sorted({fault.module for fault in faults if not fault.equivalent}))
    verdicts, catching = [], {}
    for fault in faults:
        began = time.monotonic()
        what, tests = trial.verdict(fault, modules_above)
        verdicts.append(what)
        catching.update({test: fault.name for test in tests if what == "caught"})
        text = {"caught": "caught by " + ", ".join(tests[:2]), "survived": "SURVIVED", "equivalent": "NO FAULT: " + "".join(tests),
                "broken": "DOES NOT COMPILE: " + " / ".join(tests)}[what]
        print(f"{fault.name:<66} {text}  ({time.monotonic() - began:.0f} s)", flush=True)
    return verdicts, failing_anyway(trial, catching)


def failing_anyway(trial, catching):
    """Tests that have caught faults and fail without any."""
    modules = sorted({test.split(".")[0] for test in catching})
    if not modules:
        return []
    if trial.build("no fault", modules).returncode:
        raise Failure(f"the copy does not compile without a fault, see {LOG}")
    return trial.run("no fault", ["-R", "^(" + "|".join(re.escape(test).replace(r"\*", ".*") for test in catching) + ")$"])


def try_drawn(options):
    """Faults by machine: how many that compile survive, and which."""
    seed = options.seed or str(int(time.time()))
    print(f"seed {seed}", flush=True)
    drawn = mutation_operators.drawn(SOURCE, options.modules.split(","), options.drawn, seed)
    faults = [Fault(name, file, old, new, "", why) for name, file, old, new, why in drawn if re.search(options.only, name)]
    for fault in faults if options.list else ():
        tell_change(fault)
    if options.list or not faults:
        return 0 if faults else 2
    try:
        os.makedirs(WORK, exist_ok=True)
        open(LOG, "w", encoding="utf-8").close()
        verdicts, anyway = try_all(faults, options.jobs, options.near, [m for m in options.within.split(",") if m])
    except Failure as failure:
        print(f"mutations: {failure}", file=sys.stderr)
        return 2
    for fault, verdict in zip(faults, verdicts):
        if verdict == "survived":
            tell_change(fault)
    tell_counts(faults, verdicts)
    if anyway:
        print("these fail without any fault: " + ", ".join(anyway))
        return 2
    return 1 if verdicts.count("survived") > DRAWN_MAY_SURVIVE * tried(verdicts) else 0


def tell_change(fault):
    print("\n    ".join((fault.name, mutation_operators.last_line(fault.old), mutation_operators.last_line(fault.new))))


def tried(verdicts):
    """How many faults the tests were asked about."""
    return verdicts.count("caught") + verdicts.count("survived")


def tell_counts(faults, verdicts):
    """A table of what became of the faults of each module."""
    print("\n| module | drawn | do not compile | equivalent | tried | caught | survive |\n|---|---|---|---|---|---|---|")
    modules = list(dict.fromkeys(fault.module for fault in faults))
    for module in modules + ["all"] * (len(modules) > 1):
        of = [verdict for fault, verdict in zip(faults, verdicts) if module in (fault.module, "all")]
        counts = (len(of), of.count("broken"), of.count("equivalent"), tried(of), of.count("caught"), of.count("survived"))
        print(f"| {module} | " + " | ".join(str(count) for count in counts) + " |")
    print(f"{100 * verdicts.count('survived') / max(tried(verdicts), 1):.1f} % of those tried survive")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", metavar="REGEX")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--drawn", type=int, default=0, metavar="N")
    parser.add_argument("--seed", default="")
    parser.add_argument("--modules", default="film,solver,bearing,mbd")
    parser.add_argument("--near", action="store_true")
    parser.add_argument("--within", default="", metavar="A,B")
    options = parser.parse_args()
    if options.drawn:
        return try_drawn(options)
    faults = [fault for fault in FAULTS if re.search(options.only, fault.name)]
    if options.list:
        print("\n".join(f"{fault.name:<66} libs/{fault.file}" for fault in faults))
        return 0
    try:
        check_places(FAULTS)
        if options.check or not faults:
            print(f"{len(faults)} faults" + (", each where it says" if faults else f" match '{options.only}'"))
            return 0 if faults else 2
        os.makedirs(WORK, exist_ok=True)
        open(LOG, "w", encoding="utf-8").close()
        verdicts, anyway = try_all(faults, options.jobs)
    except Failure as failure:
        print(f"mutations: {failure}", file=sys.stderr)
        return 2
    print(f"{verdicts.count('caught')} of {len(verdicts)} caught")
    if anyway:
        print("these fail without any fault: " + ", ".join(anyway))
    if anyway or "broken" in verdicts:
        return 2
    return 1 if "survived" in verdicts else 0


if __name__ == "__main__":
    sys.exit(main())
