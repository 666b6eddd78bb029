#include <CLI/CLI.hpp>
#include <memory>

#include "command_line.h"
#include "commands.h"
#include "hersey/core/task_pool.h"

namespace hersey::cli {
namespace {

void use_threads(int threads) {
  if (threads > 0) TaskPool::shared().set_threads(threads);
}

void add_threads(CLI::App& command, int& threads) {
  command
      .add_option("--threads", threads,
                  "Threads at work at the same time, which change no result (default: one per processor it may use)")
      ->check(CLI::PositiveNumber);
}

void add_run(CLI::App& app, Commands& commands) {
  const auto run = std::make_shared<RunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "Simulate a model, or every run of its study; write results and report");
  command->add_option("MODEL", run->model, "Model file")->required();
  add_overrides(*command, run->overrides);
  command->add_option("--output", run->output, "Folder for results and report (default: results/<model>)")
      ->type_name("DIR");
  CLI::Option* force = command->add_flag("--force", run->force, "Replace results that exist already");
  CLI::Option* resume =
      command
          ->add_flag("--resume", run->resume,
                     "Go on where a run was interrupted, from its last checkpoint; of a study, finish what is missing")
          ->excludes(force);
  command
      ->add_flag("--step-error", run->step_error,
                 "Estimate what the time step does to each bearing's figures, by a run with steps twice as long")
      ->excludes(resume);
  command
      ->add_option("--events", run->events,
                   "Append what happens to this file, one line of JSON each, at most ten steps a second")
      ->type_name("FILE");
  command->add_flag("--json", run->json, "Print the closing table as JSON");
  command->add_flag("--all", run->all, "Print every figure of every bearing, however many");
  command->add_flag("--timing", run->timing,
                    "Print where the computing time of a single run went, in 25 lines at most");
  command->add_option("--jobs", run->jobs, "Runs of a study at the same time (default: one per processor)")
      ->check(CLI::PositiveNumber);
  add_threads(*command, run->threads);
  commands.push_back({command, [run] {
                        use_threads(run->threads);
                        return run_command(*run);
                      }});
}

void add_check(CLI::App& app, Commands& commands) {
  const auto check = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check", "Report everything that can be found wrong without simulating");
  command->add_option("MODEL", check->model, "Model file")->required();
  add_overrides(*command, check->overrides);
  command->add_flag("--json", check->json, "Print the faults as JSON");
  command->add_flag("--expanded", check->expanded,
                    "Print the model with templates, aliases, overrides and parameters put in, instead");
  commands.push_back({command, [check] { return check_command(*check); }});
}

void add_report(CLI::App& app, Commands& commands) {
  const auto report = std::make_shared<ReportArguments>();
  CLI::App* command =
      app.add_subcommand("report", "Write the HTML report of results: of one run, or of several as a study");
  command->add_option("RESULTS", report->results, "Results files (.h5)")->required();
  command->add_option("--output", report->output, "The page to write (default: report.html beside the results)")
      ->type_name("FILE");
  command->add_option("--names", report->names, "Names of the runs, in the order of the files: --names before,after")
      ->delimiter(',')
      ->type_name("A,B");
  command->add_flag("--json", report->json, "Print the summary as JSON");
  command->add_flag("--all", report->all, "Print every figure of every bearing, however many");
  commands.push_back({command, [report] { return report_command(*report); }});
}

// The workbench asks it of runs that go on: a damaged file then costs this program and not that one.
void add_film(CLI::App& app, Commands& commands) {
  const auto film = std::make_shared<FilmArguments>();
  CLI::App* command = app.add_subcommand("film", "Write the latest fields of a film as JSON")->group("");
  command->add_option("RESULTS", film->results, "Results file (.h5)")->required();
  command->add_option("--bearing", film->bearing, "Which bearing")->required();
  command->add_option("--output", film->output, "File to write")->required();
  commands.push_back({command, [film] { return film_command(*film); }});
}

void add_bearing(CLI::App& app, Commands& commands) {
  const auto bearing = std::make_shared<BearingArguments>();
  CLI::App* command = app.add_subcommand(
      "bearing",
      "Solve one bearing by itself: position under a load, coefficients, friction, flows; once or in sweeps");
  command->add_option("MODEL", bearing->model, "Model file; bodies and a simulation are not needed")->required();
  add_overrides(*command, bearing->overrides);
  command->add_option("--bearing", bearing->bearing, "Which bearing, if the model has several")->type_name("NAME");
  const auto value = [&](const char* option, std::string& text, const char* description, const char* type) {
    command->add_option(option, text, description)->type_name(type);
  };
  value("--speed", bearing->speed, "Angular velocity of the journal", "3000rpm");
  value("--shell-speed", bearing->shell_speed, "Angular velocity of the shell", "0rpm");
  value("--load", bearing->load, "Load on the journal: its position is sought", "2500N");
  value("--whirl-ratio", bearing->whirl_ratios,
        "Frequencies over the journal's at which tilting pads follow, in stiffness and damping", "0,0.5,1");
  value("--load-angle", bearing->load_angle, "Direction of the load, from x towards y", "-90deg");
  value("--eccentricity-ratio", bearing->eccentricity_ratio, "Position of the journal: its load is sought", "0.6");
  value("--eccentricity-angle", bearing->eccentricity_angle, "Direction of that position", "-60deg");
  repeatable(
      command
          ->add_option(
              "--sweep", bearing->sweeps,
              "Solve at several values of load, speed, clearance, viscosity, eccentricity_ratio, any parameter or "
              "key path: load=100N:2500N:10, speed=1rpm:3000rpm:20:log or load=100N,500N; several sweeps combine")
          ->type_name("NAME=VALUES"));
  command->add_option("--csv", bearing->csv, "Write every figure of every solution as a table")->type_name("FILE");
  command
      ->add_option("--coefficients", bearing->coefficients,
                   "Write stiffness and damping over the speed as a table for rotors: with --sweep speed=...")
      ->type_name("FILE");
  command
      ->add_option("--coefficients-for", bearing->coefficients_for,
                   "Which program that table is for: CSV for a `bearing_table` and spreadsheets (hersey, the default), "
                   "TOML for ROSS, bearing characteristics for COMBI214 of Ansys")
      ->check(CLI::IsMember({"hersey", "ross", "ansys"}).description(""))
      ->type_name("hersey|ross|ansys");
  command->add_option("--fields", bearing->fields, "Write pressure, film thickness and fill fraction of a solution")
      ->type_name("FILE");
  command
      ->add_option("--vtu", bearing->vtu,
                   "Write the temperatures of the body that the shell, or the journal, is in for ParaView")
      ->type_name("FILE");
  command->add_option("--report", bearing->report, "Write a page with figures, maps and curves of all solutions")
      ->type_name("FILE");
  command->add_option("--text", bearing->text, "File with a text in place of the model's")->group("");
  command->add_flag("--json", bearing->json, "Print every figure as JSON");
  command->add_flag("--no-grid-error", bearing->no_grid_error, "Leave out the estimate of the grid's error");
  command->add_flag("--timing", bearing->timing, "Print where the computing time of a single solution went");
  command->add_flag("--sensitivity", bearing->sensitivity,
                    "Print the derivatives of every figure by load, speed, size, clearance, viscosity and supplies");
  repeatable(
      command
          ->add_option("--sensitivity-to", bearing->sensitivity_to,
                       "Print the derivatives of every figure by a key of the file: bearings.main.asperities.roughness")
          ->type_name("KEY"));
  command
      ->add_option("--thermal-coefficients", bearing->thermal_coefficients,
                   "Stiffness and damping with temperatures as they are (frozen, the default) or as they follow the "
                   "motion (total)")
      ->check(CLI::IsMember({"frozen", "total"}).description(""))
      ->type_name("frozen|total");
  command->add_option("--jobs", bearing->jobs, "Solutions at the same time (default: one per processor)")
      ->check(CLI::PositiveNumber);
  add_threads(*command, bearing->threads);
  commands.push_back({command, [bearing] {
                        use_threads(bearing->threads);
                        return bearing_command(*bearing);
                      }});
}

void add_rotor(CLI::App& app, Commands& commands) {
  const auto rotor = std::make_shared<RotorArguments>();
  CLI::App* command = app.add_subcommand(
      "rotor", "Modes, stability, unbalance response and critical speeds of a shaft on its bearings, over its speeds");
  command->add_option("MODEL", rotor->model, "Model file of a machine with a shaft that a drive rotates")->required();
  add_overrides(*command, rotor->overrides);
  repeatable(command
                 ->add_option("--sweep", rotor->sweeps,
                              "Speeds, by a parameter or key path of the model: speed=1000rpm:9000rpm:41")
                 ->type_name("NAME=VALUES"));
  command
      ->add_option("--stations", rotor->stations,
                   "Frames on the shaft's axis whose motion is wanted: shaft.middle,shaft.end (default: all bearings)")
      ->delimiter(',')
      ->type_name("A,B");
  command
      ->add_option("--operating", rotor->operating,
                   "Speed in service, or the range of them, for separation margins: 7000rpm:9000rpm")
      ->type_name("SPEED");
  command
      ->add_option(
          "--cross-coupling", rotor->cross_coupling,
          "Anticipated cross-coupled stiffness at a station, for the screening of stability: shaft.middle=2MN/m")
      ->type_name("STATION=Q");
  command
      ->add_option("--stiffness-map", rotor->stiffness_map,
                   "Undamped critical speeds over this range of the bearings' stiffness: 1MN/m:10GN/m")
      ->type_name("LOW:HIGH");
  command->add_option("--results", rotor->results, "Write everything as JSON; to a name ending in .h5 or .hdf5 as HDF5")
      ->type_name("FILE");
  command->add_option("--report", rotor->report, "Write a page with diagrams and tables")->type_name("FILE");
  command->add_flag("--json", rotor->json, "Print everything as JSON");
  add_threads(*command, rotor->threads);
  commands.push_back({command, [rotor] {
                        use_threads(rotor->threads);
                        return rotor_command(*rotor);
                      }});
}

void add_orbits(CLI::App& app, Commands& commands) {
  const auto orbits = std::make_shared<OrbitsArguments>();
  CLI::App* command = app.add_subcommand(
      "orbits", "Periodic motions of a machine over a parameter, stable or not: folds, oil whirl, doubled periods");
  command->add_option("MODEL", orbits->model, "Model file of a machine with `cycle: {lead_in: shooting}`")->required();
  add_overrides(*command, orbits->overrides);
  command->add_option("--along", orbits->along, "Parameter or key path of the model, and its range: speed=4000:9000rpm")
      ->required()
      ->type_name("NAME=FROM:TO");
  command
      ->add_option("--observe", orbits->observe,
                   "Quantities of the results whose extremes are wanted: bearings.left.h_min,joints.slide.coordinates "
                   "(default: those of all films, else of all joints)")
      ->type_name("A,B");
  command->add_option("--step", orbits->step, "Largest step along the branch, as a share of the range (default: 0.05)")
      ->check(CLI::Range(1e-4, 1.0));
  command->add_option("--most", orbits->most, "Orbits after which the branch ends (default: 200)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--tolerance", orbits->tolerance,
                   "Distance from the periodic motion, in shares of each coordinate's swing (default: 1e-4)")
      ->check(CLI::Range(1e-8, 1e-1));
  command->add_option("--multipliers", orbits->multipliers, "Floquet multipliers of each orbit (default: 2)")
      ->check(CLI::Range(1, 20));
  command->add_option("--results", orbits->results, "Write everything as JSON")->type_name("FILE");
  command->add_option("--report", orbits->report, "Write a page with diagrams and tables")->type_name("FILE");
  command->add_flag("--json", orbits->json, "Print everything as JSON");
  add_threads(*command, orbits->threads);
  commands.push_back({command, [orbits] {
                        use_threads(orbits->threads);
                        return orbits_command(*orbits);
                      }});
}

}  // namespace

void add_run_commands(CLI::App& app, Commands& commands) {
  add_run(app, commands);
  add_check(app, commands);
  add_report(app, commands);
  add_film(app, commands);
  add_bearing(app, commands);
  add_rotor(app, commands);
  add_orbits(app, commands);
}

}  // namespace hersey::cli
