#include <CLI/CLI.hpp>
#include <memory>

#include "command_line.h"
#include "commands.h"

namespace hersey::cli {
namespace {

void add_oil(CLI::App& app, Commands& commands) {
  const auto oil = std::make_shared<OilArguments>();
  CLI::App* command =
      app.add_subcommand("oil", "Print viscosity and density of an oil over temperature, pressure and shear rate");
  command
      ->add_option("oil", oil->oil,
                   "A grade such as iso_vg_46 or sae_5w30, or a model file, of several lubricants with the name of one")
      ->required()
      ->type_name("GRADE|MODEL[:OIL]");
  add_overrides(*command, oil->overrides);
  command->add_option("--lubricant", oil->lubricant, "Which, of a model with several")->type_name("NAME");
  command->add_option("--at", oil->at, "Temperatures (default: 0 to 160 degC)")->type_name("100degC ...");
  command
      ->add_option("--pressure", oil->pressures,
                   "Above the cavitation pressure (default: 0, and 100 MPa where the viscosity depends on it)")
      ->type_name("100MPa ...");
  command
      ->add_option("--shear-rate", oil->shear_rates,
                   "Shear rates (default: 0, and up to 1e7 1/s where the oil thins by shear)")
      ->type_name("\"1e6 1/s\" ...");
  command->add_option("--report", oil->report, "Write an HTML page with curves")->type_name("FILE");
  command->add_flag("--json", oil->json, "Print it as JSON");
  commands.push_back({command, [oil] { return oil_command(*oil); }});
}

void add_load_options(CLI::App& command, LoadsArguments& loads) {
  const auto value = [&](const char* option, std::string& text, const char* what, const char* type) {
    command.add_option(option, text, what)->type_name(type);
  };
  command
      .add_option("--loads", loads.format,
                  "Write the pressures of films on a body's mesh for a strength program, from results")
      ->type_name("calculix|nastran|vtkhdf")
      ->check(CLI::IsMember({"calculix", "nastran", "vtkhdf"}).description(""));
  command.add_option("--output", loads.output, "Folder of the loads")->type_name("DIR");
  value("--body", loads.body, "Whose loads (default: the only body with a mesh and a film)", "NAME");
  repeatable(
      command
          .add_option("--bearing", loads.bearings, "Of this bearing only (default: of all on the body; of films: all)")
          ->type_name("NAME"));
  repeatable(command
                 .add_option("--instant", loads.instants,
                             "At the stored film nearest to this time or crank angle, or all (default: the last cycle; "
                             "of films: all)")
                 ->type_name("12ms|370deg|all"));
  command.add_option("--units", loads.units, "Of CalculiX and Nastran files: mm, N, t, MPa or SI (default: mm)")
      ->type_name("mm|si")
      ->check(CLI::IsMember({"mm", "si"}).description(""));
  repeatable(
      command.add_option("--hold", loads.hold, "Support: set of nodes that does not move, or SET:xz along some axes")
          ->type_name("SET"));
  value("--mesh", loads.mesh, "Mesh of a body that is rigid in the run, in the body's axes", "FILE");
  value("--length-unit", loads.length_unit, "What one unit of that mesh is (default: m)", "mm");
  value("--youngs-modulus", loads.youngs_modulus, "Young's modulus, instead of that mesh's", "210GPa");
  value("--poisson-ratio", loads.poisson_ratio, "Poisson's ratio, instead of that mesh's", "0.3");
  value("--density", loads.density, "Density, instead of that mesh's", "7850kg/m^3");
  value("--conductivity", loads.conductivity,
        "Write temperatures, too: of heat conduction between the films' surfaces and what cools the body (default: "
        "that of the body's `heat` in the model)",
        "46W/m/K");
  value("--expansion", loads.expansion, "Linear thermal expansion, for temperatures that strain the body", "12e-6 1/K");
  value("--reference-temperature", loads.reference_temperature,
        "At which the body has the shape of its mesh (default: 20degC)", "20degC");
  repeatable(command.add_option("--temperature", loads.temperature, "Temperature of a set's nodes, as the films' are")
                 ->type_name("SET=80degC"));
  repeatable(command.add_option("--cooling", loads.cooling, "Heat transfer from a surface to what is at a temperature")
                 ->type_name("SURFACE=80W/m^2/K:20degC"));
  value("--model", loads.model_file, "Where the model file lies now, if it has moved since the run", "FILE");
}

void add_export(CLI::App& app, Commands& commands) {
  const auto exported = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "Write a model as an FMU for co-simulation, or results of a run for other programs");
  command->add_option("FILE", exported->file, "Model file; with --loads, --films or --netcdf a results file")
      ->required();
  command->add_option("--fmu", exported->fmu, "The FMU to write")->type_name("FILE.fmu");
  command->add_option("--ssp", exported->ssp, "The system to write, of the machine and the FMUs of its model")
      ->type_name("FILE.ssp");
  command->add_option("--fmi", exported->fmi, "Version of the standard: 2 or 3 (default: 2)")
      ->type_name("2|3")
      ->check(CLI::IsMember({2, 3}).description(""));
  add_overrides(*command, exported->overrides);
  add_load_options(*command, exported->loads);
  command->add_option("--films", exported->films, "Write the films of a run over time for ParaView, from results")
      ->type_name("FILE.vtkhdf");
  command
      ->add_option("--surface", exported->surface,
                   "Where these films lie: in the machine as it moves, in their bearing's axes, or rolled out "
                   "(default: machine)")
      ->type_name("machine|bearing|unwrapped")
      ->check(CLI::IsMember({"machine", "bearing", "unwrapped"}).description(""));
  command->add_option("--netcdf", exported->netcdf, "Write a copy of results as netCDF by the CF conventions")
      ->type_name("FILE.nc");
  command->add_flag("--force", exported->force, "Replace what exists");
  command->add_flag("--json", exported->json, "Print what was written as JSON");
  commands.push_back({command, [exported] { return export_command(*exported); }});
}

void add_convert(CLI::App& app, Commands& commands) {
  const auto convert = std::make_shared<ConvertArguments>();
  CLI::App* command =
      app.add_subcommand("convert", "Bring a model file of an earlier version up to date; comments and layout stay");
  command->add_option("MODEL", convert->model, "Model file")->required();
  CLI::Option* output = command->add_option("--output", convert->output, "File to write (default: standard output)");
  output->type_name("FILE");
  command->add_flag("--in-place", convert->in_place, "Write it over the model file")->excludes(output);
  commands.push_back({command, [convert] { return convert_command(*convert); }});
}

void add_init(CLI::App& app, Commands& commands) {
  const auto init = std::make_shared<InitArguments>();
  CLI::App* command =
      app.add_subcommand("init", "Write a commented model to begin with; alone: list the available ones");
  command->add_option(
      "TEMPLATE", init->model,
      "bearing, hydrostatic, tilting_pads, thrust, tilting_thrust, floating_ring, damper, skirt, rotor, big_end, "
      "engine, turbocharger or flexible_rod");
  command->add_option("NAME", init->name, "Name of the file to write (default: as the template)");
  commands.push_back({command, [init] { return init_command(*init); }});
}

void add_recipes(CLI::App& app, Commands& commands) {
  const auto name = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "recipes",
      "Print how a task is done, step by step, with commands that work as they stand; alone: list the tasks");
  command->add_option("NAME", *name, "Which one, such as size-a-bearing");
  command->add_flag("--json", *as_json, "Print it, or all of them, as JSON");
  commands.push_back({command, [name, as_json] { return recipes_command(*name, *as_json); }});
}

void add_explain(CLI::App& app, Commands& commands) {
  const auto key = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("explain", "Print what a key of the model file is; alone: the sections of a model");
  command->add_option("KEY", *key, "Key path, such as bearings.main.supply");
  commands.push_back({command, [key] { return explain_command(*key); }});
}

void add_schema(CLI::App& app, Commands& commands) {
  const auto what = std::make_shared<SchemaArguments>();
  CLI::App* command = app.add_subcommand("schema", "Print the model file's format as a JSON Schema for editors");
  command->add_flag("--results", what->of_results, "Print what results files hold, as JSON for programs, instead");
  command->add_flag("--quantities", what->of_quantities, "Print the page of what is reported of a bearing instead");
  command->add_flag("--markdown", what->markdown, "Print it as the reference page of the documentation instead");
  commands.push_back({command, [what] { return schema_command(*what); }});
}

}  // namespace

void add_file_commands(CLI::App& app, Commands& commands) {
  add_oil(app, commands);
  add_export(app, commands);
  add_init(app, commands);
  add_recipes(app, commands);
  add_convert(app, commands);
  add_explain(app, commands);
  add_schema(app, commands);
}

}  // namespace hersey::cli
