#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>

#include "commands.h"
#include "crash.h"
#include "exit_code.h"
#include "hersey/core/blas_threads.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/task_pool.h"
#include "hersey/core/version.h"
#include "hersey/results/error.h"
#include "standard_streams.h"
#include "study_command.h"

namespace hersey::cli {
namespace {

constexpr const char* kAbout =
    "hersey: oil-film journal bearings inside moving machines.\n"
    "A model file (YAML, with units) describes bodies, joints, loads and bearings; a run simulates it in time and\n"
    "leaves one HDF5 results file and one self-contained HTML report.";

constexpr const char* kFooter =
    "Examples:\n"
    "  hersey init big_end my_rod                                    a commented model to begin with\n"
    "  hersey explain bearings.main.supply                           what a key means, its unit and default\n"
    "  hersey run examples/paper_big_end/model.yaml                  all runs of its study\n"
    "  hersey run model.yaml --set load=500N --output out            one parameter changed\n"
    "  hersey run model.yaml --resume                                goes on after Ctrl-C or a crash\n"
    "  hersey run model.yaml --set bearings.big_end.grid.circumferential=120\n"
    "  hersey bearing model.yaml --sweep load=100N:2500N:10          one bearing by itself\n"
    "  hersey check model.yaml                                       every fault, nothing simulated\n"
    "  hersey mesh conrod.msh --length-unit mm                       a mesh: sets, mass, quality, bores\n"
    "  hersey mesh conrod.step --size 4mm                            a mesh of a CAD file, by gmsh\n"
    "  hersey modes conrod.msh --length-unit mm --hold big_end       its natural frequencies\n"
    "  hersey export rotor.yaml --fmu rotor.fmu                      for co-simulation in other programs\n"
    "  hersey oil iso_vg_46 --at 40degC 100degC                      viscosity and density of an oil\n"
    "  hersey convert old.yaml --in-place                            a model file of an earlier version\n"
    "  hersey schema > hersey.schema.json                            completion and checking in an editor\n"
    "\n"
    "Exit codes:\n"
    "  0    done\n"
    "  1    the simulation failed or its results could not be written; what was written stays readable\n"
    "  2    wrong usage or input, or results exist already (see --force); nothing was written\n"
    "  130  stopped by Ctrl-C; results up to then are complete and the report shows them\n";

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "Override a parameter (load=500N) or any key (bearings.big_end.width=20mm)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_threads(CLI::App& command, int& threads) {
  command
      .add_option("--threads", threads,
                  "Threads at work at the same time, which change no result (default: one per processor it may use)")
      ->check(CLI::PositiveNumber);
}

CLI::App* add_export_command(CLI::App& app, ExportArguments& exported) {
  CLI::App* command = app.add_subcommand("export", "Write a model as an FMU, for co-simulation in other programs");
  command->add_option("MODEL", exported.model, "Model file")->required();
  command->add_option("--fmu", exported.fmu, "The FMU to write")->type_name("FILE.fmu")->required();
  command->add_option("--fmi", exported.fmi, "Version of the standard: 2 or 3 (default: 2)")
      ->type_name("2|3")
      ->check(CLI::IsMember({2, 3}).description(""));
  add_overrides(*command, exported.overrides);
  command->add_flag("--force", exported.force, "Replace the FMU if it exists");
  return command;
}

CLI::App* add_bearing_command(CLI::App& app, BearingArguments& bearing) {
  CLI::App* command = app.add_subcommand(
      "bearing",
      "Solve one bearing by itself: position under a load, coefficients, friction, flows; once or in sweeps");
  command->add_option("MODEL", bearing.model, "Model file; bodies and a simulation are not needed")->required();
  add_overrides(*command, bearing.overrides);
  command->add_option("--bearing", bearing.bearing, "Which bearing, if the model has several")->type_name("NAME");
  const auto value = [&](const char* option, std::string& text, const char* description, const char* type) {
    command->add_option(option, text, description)->type_name(type);
  };
  value("--speed", bearing.speed, "Angular velocity of the journal", "3000rpm");
  value("--shell-speed", bearing.shell_speed, "Angular velocity of the shell", "0rpm");
  value("--load", bearing.load, "Load on the journal: its position is sought", "2500N");
  value("--load-angle", bearing.load_angle, "Direction of the load, from x towards y", "-90deg");
  value("--eccentricity-ratio", bearing.eccentricity_ratio, "Position of the journal: its load is sought", "0.6");
  value("--eccentricity-angle", bearing.eccentricity_angle, "Direction of that position", "-60deg");
  command
      ->add_option("--sweep", bearing.sweeps,
                   "Solve at several values of load, speed, clearance, viscosity, eccentricity_ratio, any parameter or "
                   "key path: load=100N:2500N:10, speed=1rpm:3000rpm:20:log or load=100N,500N; several sweeps combine")
      ->type_name("NAME=VALUES")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--csv", bearing.csv, "Write every figure of every solution as a table")->type_name("FILE");
  command->add_option("--fields", bearing.fields, "Write pressure, film thickness and fill fraction of a solution")
      ->type_name("FILE");
  command
      ->add_option("--vtu", bearing.vtu,
                   "Write the temperatures of the body that the shell, or the journal, is in for ParaView")
      ->type_name("FILE");
  command->add_option("--report", bearing.report, "Write a page with figures, maps and curves of all solutions")
      ->type_name("FILE");
  command->add_flag("--json", bearing.json, "Print every figure as JSON");
  command->add_flag("--no-grid-error", bearing.no_grid_error, "Leave out the estimate of the grid's error");
  command->add_flag("--sensitivity", bearing.sensitivity,
                    "Tell how every figure follows load, speed, size, clearance, viscosity and supplies");
  command
      ->add_option("--sensitivity-to", bearing.sensitivity_to,
                   "Tell how every figure follows a key of the file: bearings.main.asperities.roughness")
      ->type_name("KEY")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--thermal-coefficients", bearing.thermal_coefficients,
                   "Stiffness and damping with temperatures as they are (frozen, the default) or as they follow the "
                   "motion (total)")
      ->check(CLI::IsMember({"frozen", "total"}))
      ->type_name("frozen|total");
  command->add_option("--jobs", bearing.jobs, "Solutions at the same time (default: one per processor)")
      ->check(CLI::PositiveNumber);
  add_threads(*command, bearing.threads);
  return command;
}

CLI::App* add_convert_command(CLI::App& app, ConvertArguments& convert) {
  CLI::App* command =
      app.add_subcommand("convert", "Bring a model file of an earlier version up to date; comments and layout stay");
  command->add_option("MODEL", convert.model, "Model file")->required();
  CLI::Option* output = command->add_option("--output", convert.output, "File to write (default: standard output)");
  output->type_name("FILE");
  command->add_flag("--in-place", convert.in_place, "Write it over the model file")->excludes(output);
  return command;
}

CLI::App* add_mesh_command(CLI::App& app, MeshArguments& mesh) {
  CLI::App* command = app.add_subcommand(
      "mesh", "Tell what a mesh holds, how good it is, its planes and possible bores; of a CAD file make it first");
  command
      ->add_option(
          "FILE", mesh.file,
          "Gmsh .msh, Abaqus or CalculiX .inp, Nastran .bdf; STEP, IGES or BREP, which the program gmsh meshes")
      ->required();
  command
      ->add_option("--length-unit", mesh.length_unit,
                   "What one unit of the file is (default: m, of BREP mm; STEP and IGES say it)")
      ->type_name("mm");
  command->add_option("--size", mesh.size, "How large the elements made of a CAD file are")->type_name("4mm");
  command->add_option("--order", mesh.order, "Of these elements, 1 or 2 (default: 2)")
      ->type_name("1|2")
      ->check(CLI::IsMember({1, 2}).description(""));
  command->add_option("--around", mesh.around, "How many of them a full turn has at least (default: 16)")
      ->check(CLI::Range(4, 1000));
  command->add_option("--time-limit", mesh.time_limit, "How long gmsh may take (default: 30min)")->type_name("10min");
  command
      ->add_option("--output", mesh.output,
                   "Write the mesh with what was found as named surfaces, in metres (default: of a CAD file beside it)")
      ->type_name("FILE.msh");
  command->add_flag("--force", mesh.force, "Replace that file if it exists");
  command->add_option("--density", mesh.density, "For the mass, where the file has none")->type_name("7850kg/m^3");
  command->add_option("--vtu", mesh.vtu, "Write the mesh with its elements' shapes for ParaView")->type_name("FILE");
  command->add_flag("--json", mesh.json, "Print it as JSON");
  return command;
}

CLI::App* add_reduce_command(CLI::App& app, ReduceArguments& reduce) {
  CLI::App* command = app.add_subcommand(
      "reduce", "Make an elastic body of few coordinates from a mesh: frames, Craig-Bampton modes, one HDF5 file");
  command->add_option("FILE", reduce.file, "Mesh: .msh, .inp or .bdf")->required();
  command->add_option("--length-unit", reduce.length_unit, "What one unit of the file is (default: m)")
      ->type_name("mm");
  command
      ->add_option("--frame", reduce.frames,
                   "Frame for joints and forces on a set's nodes: pin=big_end:average (or rigid)")
      ->type_name("NAME=SET:CONNECTION")
      ->required()
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--youngs-modulus", reduce.youngs_modulus, "Default: the file's")->type_name("210GPa");
  command->add_option("--poisson-ratio", reduce.poisson_ratio, "Default: the file's")->type_name("0.3");
  command
      ->add_option(
          "--orthotropic", reduce.orthotropic,
          "Nine constants along the mesh's axes in place of these: E_1,E_2,E_3,nu_12,nu_23,nu_13,G_12,G_23,G_13")
      ->type_name("140GPa,...");
  command->add_option("--density", reduce.density, "Default: the file's")->type_name("7850kg/m^3");
  command->add_option("--stiffness", reduce.stiffness, "Stiffness matrix of another program instead (.mtx, SI)")
      ->type_name("FILE");
  command->add_option("--mass", reduce.mass, "Mass matrix of another program (.mtx, SI)")->type_name("FILE");
  command->add_option("--modes", reduce.modes, "Modes with all frames held, at most (default: 20)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--highest", reduce.highest, "Modes up to this frequency only")->type_name("5000Hz");
  command
      ->add_option("--load", reduce.loads,
                   "Surface or node set that carries load: tells how well the modes meet its static displacement")
      ->type_name("SET")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--harmonics", reduce.harmonics,
                   "Of the pressures looked at around a bore under --load (default: 4)")
      ->check(CLI::Range(0, 40));
  command->add_option("--static-error", reduce.static_error, "Adds static shapes until no error under --load is larger")
      ->type_name("1%");
  command->add_option("--output", reduce.output, "File to write")->type_name("FILE.h5")->required();
  command->add_flag("--force", reduce.force, "Replace the file if it exists");
  return command;
}

CLI::App* add_solid_command(CLI::App& app, const char* name, const char* description, SolidArguments& solid) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("FILE", solid.file, "Mesh of solid elements: Gmsh, Abaqus, CalculiX, Nastran")->required();
  const auto value = [&](const char* option, std::string& text, const char* what, const char* type) {
    command->add_option(option, text, what)->type_name(type);
  };
  value("--length-unit", solid.length_unit, "What one unit of the file is (default: m)", "mm");
  value("--youngs-modulus", solid.young, "Young's modulus, instead of the file's", "210GPa");
  value("--poisson-ratio", solid.poisson, "Poisson's ratio, instead of the file's", "0.3");
  value("--orthotropic", solid.orthotropic,
        "Nine constants along the mesh's axes in place of these: E_1,E_2,E_3,nu_12,nu_23,nu_13,G_12,G_23,G_13",
        "140GPa,...");
  value("--density", solid.density, "Density, instead of the file's", "7850kg/m^3");
  command->add_option("--hold", solid.hold, "Set of nodes that does not move, or SET:xz along some axes only")
      ->type_name("SET")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--vtu", solid.vtu, "Write the result on the mesh for ParaView")->type_name("FILE");
  command->add_flag("--json", solid.json, "Print it as JSON");
  return command;
}

CLI::App* add_oil_command(CLI::App& app, OilArguments& oil) {
  CLI::App* command =
      app.add_subcommand("oil", "Tell viscosity and density of an oil over temperature, pressure and shear rate");
  command
      ->add_option("oil", oil.oil,
                   "A grade such as iso_vg_46 or sae_5w30, or a model file, of several lubricants with the name of one")
      ->required()
      ->type_name("GRADE|MODEL[:OIL]");
  add_overrides(*command, oil.overrides);
  command->add_option("--lubricant", oil.lubricant, "Which, of a model with several")->type_name("NAME");
  command->add_option("--at", oil.at, "Temperatures (default: 0 to 160 degC)")->type_name("100degC ...");
  command
      ->add_option("--pressure", oil.pressures,
                   "Above the cavitation pressure (default: 0, and 100 MPa where the viscosity depends on it)")
      ->type_name("100MPa ...");
  command
      ->add_option("--shear-rate", oil.shear_rates,
                   "Shear rates (default: 0, and up to 1e7 1/s where the oil thins by shear)")
      ->type_name("\"1e6 1/s\" ...");
  command->add_option("--report", oil.report, "Write an HTML page with curves")->type_name("FILE");
  command->add_flag("--json", oil.json, "Print it as JSON");
  return command;
}

CLI::App* add_modes_command(CLI::App& app, SolidArguments& solid) {
  CLI::App* command =
      add_solid_command(app, "modes", "Natural frequencies and shapes of an elastic body, free or held", solid);
  command->add_option("--count", solid.count, "How many modes, rigid ones included (default: 10)")
      ->check(CLI::Range(1, 1000));
  return command;
}

// Temperatures that strain a body.
void add_heat_options(CLI::App& command, SolidArguments& solid) {
  const auto several = [&](const char* option, std::vector<std::string>& texts, const char* what, const char* type) {
    command.add_option(option, texts, what)
        ->type_name(type)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  several("--temperature", solid.temperature, "Temperature of a set's nodes, or of the whole body", "[SET=]80degC");
  several("--cooling", solid.cooling, "Heat transfer from a surface to what is at a temperature",
          "SURFACE=80W/m^2/K:20degC");
  several("--heat", solid.heat, "Heat into a surface, spread evenly over it", "SURFACE=500W");
  command.add_option("--conductivity", solid.conductivity, "Of heat, for these")->type_name("46W/m/K");
  command.add_option("--expansion", solid.expansion, "Linear thermal expansion, for these")->type_name("12e-6 1/K");
  command
      .add_option("--reference-temperature", solid.reference_temperature,
                  "At which the body has the shape of the mesh (default: 20degC)")
      ->type_name("20degC");
}

CLI::App* add_stress_command(CLI::App& app, SolidArguments& solid) {
  CLI::App* command =
      add_solid_command(app, "stress", "Displacements and stresses of an elastic body under constant loads", solid);
  command
      ->add_option("--pressure", solid.pressure,
                   "Pressure on a surface or a node set's faces; with :x,y,z that of a pin pressed this way, which "
                   "falls as the cosine")
      ->type_name("SURFACE=20MPa")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--gravity", solid.gravity, "Acceleration of gravity in m/s^2")->type_name("0,0,-9.81");
  add_heat_options(*command, solid);
  return command;
}

CLI::App* add_study_command(CLI::App& app, StudyArguments& study) {
  CLI::App* command = app.add_subcommand(
      "study", "Plan the runs of a model's study, do those that are missing, sum up: uncertainty, optimum, figures");
  command->add_option("MODEL", study.model, "Model file with a section `study`")->required();
  add_overrides(*command, study.overrides);
  command->add_option("--out,--output", study.output, "The study's folder (default: studies/<model>)")
      ->type_name("DIR");
  command->add_option("--on", study.on, "Where runs are done (default: local)")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->type_name("local|slurm");
  command
      ->add_option("--jobs", study.jobs, "Runs, or tasks of the cluster, at the same time (default: one per processor)")
      ->check(CLI::PositiveNumber);
  command->add_option("--partition", study.partition, "Partition of the cluster (default: its own)")->type_name("NAME");
  command->add_option("--chunk", study.chunk, "Runs of one task of the cluster (default: as many as take a while)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--again", study.again, "Do failed runs again too");
  command->add_option("--runner", study.runner, "Another program that answers runs, one line of JSON each")
      ->type_name("COMMAND");
  command->add_flag("--json", study.json, "Print the results as JSON");
  return command;
}

// The commands that the module of studies calls are in no list.
CLI::App* add_study_plan_command(CLI::App& app, StudyPlanArguments& plan) {
  CLI::App* command = app.add_subcommand("study-plan", "Print a model's study, checked, as JSON")->group("");
  command->add_option("MODEL", plan.model, "Model file")->required();
  add_overrides(*command, plan.overrides);
  command->add_flag("--any-figure", plan.any_figure, "Do not check names of figures");
  return command;
}

CLI::App* add_study_task_command(CLI::App& app, StudyTaskArguments& task) {
  CLI::App* command = app.add_subcommand("study-task", "Answer runs given as JSON, one a line")->group("");
  command->add_option("MODEL", task.model, "Model file")->required();
  add_overrides(*command, task.overrides);
  command->add_option("--analysis", task.analysis, "What a run is")->check(CLI::IsMember({"steady", "simulation"}));
  command->add_option("--figure", task.outputs, "A figure that is wanted")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--end-with-parent", task.end_with_parent, "End when the program ends that started this one");
  return command;
}

CLI::App* add_study_page_command(CLI::App& app, std::filesystem::path& data, std::filesystem::path& page) {
  CLI::App* command = app.add_subcommand("study-page", "Write the page of a study from its data")->group("");
  command->add_option("DATA", data, "JSON")->required();
  command->add_option("PAGE", page, "HTML file to write")->required();
  return command;
}

// What is wrong with the first word, if it is no command: "unknown command 'rnu': did you mean 'run'?".
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  const std::string given = argc > 1 ? argv[1] : "";
  if (given.empty() || given.starts_with('-')) return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == given) return {};
    if (!command->get_group().empty()) names.push_back(command->get_name());  // the others are hersey's own
  }
  const std::string hint = did_you_mean(given, names);
  return fmt::format("unknown command '{}': {}", given, hint.empty() ? "expected " + one_of(names) : hint);
}

// Declares the command line and calls the command named in it.
int dispatch(int argc, char** argv) {
  CLI::App app{kAbout, "hersey"};
  app.footer(kFooter);
  app.set_version_flag("--version", fmt::format("hersey {}", version()));
  app.require_subcommand(1);

  RunArguments run;
  CLI::App* run_app =
      app.add_subcommand("run", "Simulate a model, or every run of its study; write results and report");
  run_app->add_option("MODEL", run.model, "Model file")->required();
  add_overrides(*run_app, run.overrides);
  run_app->add_option("--output", run.output, "Folder for results and report (default: results/<model>)")
      ->type_name("DIR");
  CLI::Option* force = run_app->add_flag("--force", run.force, "Replace results that exist already");
  CLI::Option* resume =
      run_app
          ->add_flag("--resume", run.resume,
                     "Go on where a run was interrupted, from its last checkpoint; of a study, finish what is missing")
          ->excludes(force);
  run_app
      ->add_flag("--step-error", run.step_error,
                 "Estimate what the time step does to each bearing's figures, by a run with steps twice as long")
      ->excludes(resume);
  run_app->add_flag("--json", run.json, "Print the closing table as JSON");
  run_app->add_flag("--all", run.all, "Print every figure of every bearing, however many");
  run_app->add_option("--jobs", run.jobs, "Runs of a study at the same time (default: one per processor)")
      ->check(CLI::PositiveNumber);
  add_threads(*run_app, run.threads);
  CheckArguments check;
  CLI::App* check_app = app.add_subcommand("check", "Report everything that can be found wrong without simulating");
  check_app->add_option("MODEL", check.model, "Model file")->required();
  add_overrides(*check_app, check.overrides);
  check_app->add_flag("--json", check.json, "Print the faults as JSON");
  check_app->add_flag("--expanded", check.expanded,
                      "Print the model with templates, aliases, overrides and parameters put in, instead");

  ReportArguments report;
  CLI::App* report_app =
      app.add_subcommand("report", "Write the HTML report of results: of one run, or of several as a study");
  report_app->add_option("RESULTS", report.results, "Results files (.h5)")->required();
  report_app->add_option("--output", report.output, "The page to write (default: report.html beside the results)")
      ->type_name("FILE");
  report_app->add_option("--names", report.names, "Names of the runs, in the order of the files: --names before,after")
      ->delimiter(',')
      ->type_name("A,B");
  report_app->add_flag("--json", report.json, "Print the summary as JSON");
  report_app->add_flag("--all", report.all, "Print every figure of every bearing, however many");

  BearingArguments bearing;
  const CLI::App* bearing_app = add_bearing_command(app, bearing);

  MeshArguments mesh;
  const CLI::App* mesh_app = add_mesh_command(app, mesh);

  ReduceArguments reduce;
  const CLI::App* reduce_app = add_reduce_command(app, reduce);
  SolidArguments modes, stress;
  const CLI::App* modes_app = add_modes_command(app, modes);
  const CLI::App* stress_app = add_stress_command(app, stress);
  OilArguments oil;
  const CLI::App* oil_app = add_oil_command(app, oil);

  StudyArguments study;
  StudyPlanArguments study_plan;
  StudyTaskArguments study_task;
  std::filesystem::path study_data, study_page;
  study.program = argv[0];
  const CLI::App* study_app = add_study_command(app, study);

  ExportArguments exported;
  const CLI::App* export_app = add_export_command(app, exported);
  const CLI::App* study_plan_app = add_study_plan_command(app, study_plan);
  const CLI::App* study_task_app = add_study_task_command(app, study_task);
  const CLI::App* study_page_app = add_study_page_command(app, study_data, study_page);

  InitArguments init;
  CLI::App* init_app = app.add_subcommand("init", "Write a commented model to begin with; alone: tell which there are");
  init_app->add_option("TEMPLATE", init.model, "bearing, rotor, big_end, engine, turbocharger or flexible_rod");
  init_app->add_option("NAME", init.name, "Name of the file to write (default: as the template)");
  ConvertArguments convert;
  const CLI::App* convert_app = add_convert_command(app, convert);
  std::string explained;
  CLI::App* explain_app =
      app.add_subcommand("explain", "Print what a key of the model file is; alone: the sections of a model");
  explain_app->add_option("KEY", explained, "Key path, such as bearings.main.supply");

  bool markdown = false, of_results = false;
  CLI::App* schema_app = app.add_subcommand("schema", "Print the model file's format as a JSON Schema for editors");
  schema_app->add_flag("--results", of_results, "Print what results files hold, as JSON for programs, instead");
  schema_app->add_flag("--markdown", markdown, "Print it as the reference page of the documentation instead");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string unknown = unknown_command(app, argc, argv); !unknown.empty()) {
      say("hersey: {}\n", unknown);
      return kWrongInput;
    }
    return app.exit(error) == 0 ? kOk : kWrongInput;
  }
  if (const int threads = std::max(run.threads, bearing.threads); threads > 0) TaskPool::shared().set_threads(threads);
  if (*run_app) return run_command(run);
  if (*export_app) return export_command(exported);
  if (*check_app) return check_command(check);
  if (*report_app) return report_command(report);
  if (*bearing_app) return bearing_command(bearing);
  if (*mesh_app) return mesh_command(mesh);
  if (*reduce_app) return reduce_command(reduce);
  if (*modes_app) return modes_command(modes);
  if (*stress_app) return stress_command(stress);
  if (*oil_app) return oil_command(oil);
  if (*study_app) return study_command(study);
  if (*study_plan_app) return study_plan_command(study_plan);
  if (*study_task_app) return study_task_command(study_task);
  if (*study_page_app) return study_page_command(study_data, study_page);
  if (*init_app) return init_command(init);
  if (*convert_app) return convert_command(convert);
  if (*explain_app) return explain_command(explained);
  return schema_command(of_results, markdown);
}

}  // namespace
}  // namespace hersey::cli

int main(int argc, char** argv) {
  using namespace hersey;
  try {
    cli::open_standard_streams();
    cli::tell_crashes_of_damaged_files();
    use_one_blas_thread();
    const int code = cli::dispatch(argc, argv);
    return cli::finish_standard_output() || code != cli::kOk ? code : static_cast<int>(cli::kFailed);
  } catch (const InputError& error) {
    cli::say("{}\n", error.what());
    if (error.faults().size() > 1) cli::say("hersey: {} faults\n", error.faults().size());
    return cli::kWrongInput;
  } catch (const results::FileExists& error) {
    cli::say("hersey: {}; use --force to replace it or --output to write elsewhere\n", error.what());
    return cli::kWrongInput;
  } catch (const results::ReadError& error) {
    cli::say("hersey: {}\n", error.what());
    return cli::kWrongInput;
  } catch (const std::exception& error) {
    cli::say("hersey: {}\n", error_text(error));
    return cli::kFailed;
  } catch (...) {
    cli::say("hersey: internal error, please report it with the model\n");
    return cli::kFailed;
  }
}
