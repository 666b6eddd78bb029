#include <CLI/CLI.hpp>
#include <memory>

#include "command_line.h"
#include "commands.h"

namespace hersey::cli {
namespace {

void add_parts(CLI::App* command, std::string& part, std::string& parts) {
  command->add_option("--part", part, "Of an Abaqus file with several parts: the one that is read")->type_name("NAME");
  command->add_option("--parts", parts, "Whether parts that share no node are a mistake or left apart (default: one)")
      ->type_name("one|apart")
      ->check(CLI::IsMember({"one", "apart"}).description(""));
}

void add_mesh(CLI::App& app, Commands& commands) {
  const auto mesh = std::make_shared<MeshArguments>();
  CLI::App* command = app.add_subcommand(
      "mesh", "Print the contents and quality of a mesh, its planes and possible bores; mesh a CAD file first");
  command
      ->add_option(
          "FILE", mesh->file,
          "Gmsh .msh, Abaqus or CalculiX .inp, Nastran .bdf; STEP, IGES or BREP, which the program gmsh meshes")
      ->required();
  command
      ->add_option("--length-unit", mesh->length_unit,
                   "What one unit of the file is (default: m, of BREP mm; STEP and IGES say it)")
      ->type_name("mm");
  add_parts(command, mesh->part, mesh->parts);
  command->add_option("--size", mesh->size, "How large the elements made of a CAD file are")->type_name("4mm");
  command->add_option("--order", mesh->order, "Of these elements, 1 or 2 (default: 2)")
      ->type_name("1|2")
      ->check(CLI::IsMember({1, 2}).description(""));
  command->add_option("--around", mesh->around, "How many of them a full circle has at least (default: 16)")
      ->check(CLI::Range(4, 1000));
  command->add_option("--time-limit", mesh->time_limit, "How long gmsh may take (default: 30min)")->type_name("10min");
  command
      ->add_option("--output", mesh->output,
                   "Write the mesh with what was found as named surfaces, in metres (default: of a CAD file beside it)")
      ->type_name("FILE.msh");
  command->add_flag("--force", mesh->force, "Replace that file if it exists");
  command->add_option("--density", mesh->density, "For the mass, where the file has none")->type_name("7850kg/m^3");
  command->add_option("--vtu", mesh->vtu, "Write the mesh with its elements' shapes for ParaView")->type_name("FILE");
  command->add_flag("--json", mesh->json, "Print it as JSON");
  commands.push_back({command, [mesh] { return mesh_command(*mesh); }});
}

void add_reduce(CLI::App& app, Commands& commands) {
  const auto reduce = std::make_shared<ReduceArguments>();
  CLI::App* command = app.add_subcommand(
      "reduce", "Make an elastic body of few coordinates from a mesh: frames, Craig-Bampton modes, one HDF5 file");
  command->add_option("FILE", reduce->file, "Mesh: .msh, .inp or .bdf")->required();
  command->add_option("--length-unit", reduce->length_unit, "What one unit of the file is (default: m)")
      ->type_name("mm");
  add_parts(command, reduce->part, reduce->parts);
  repeatable(command
                 ->add_option("--frame", reduce->frames,
                              "Frame for joints and forces on a set's nodes: pin=big_end:average (or rigid)")
                 ->type_name("NAME=SET:CONNECTION")
                 ->required());
  command->add_option("--youngs-modulus", reduce->youngs_modulus, "Default: the file's")->type_name("210GPa");
  command->add_option("--poisson-ratio", reduce->poisson_ratio, "Default: the file's")->type_name("0.3");
  command
      ->add_option(
          "--orthotropic", reduce->orthotropic,
          "Nine constants along the mesh's axes in place of these: E_1,E_2,E_3,nu_12,nu_23,nu_13,G_12,G_23,G_13")
      ->type_name("140GPa,...");
  command->add_option("--density", reduce->density, "Default: the file's")->type_name("7850kg/m^3");
  command->add_option("--stiffness", reduce->stiffness, "Stiffness matrix of another program instead (.mtx, SI)")
      ->type_name("FILE");
  command->add_option("--mass", reduce->mass, "Mass matrix of another program (.mtx, SI)")->type_name("FILE");
  command->add_option("--modes", reduce->modes, "Modes with all frames fixed, at most (default: 20)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--highest", reduce->highest, "Modes up to this frequency only")->type_name("5000Hz");
  repeatable(
      command
          ->add_option(
              "--load", reduce->loads,
              "Surface or node set that carries load: prints how well the modes reproduce its static displacement")
          ->type_name("SET"));
  command
      ->add_option("--harmonics", reduce->harmonics,
                   "Of the pressures looked at around a bore under --load (default: 4)")
      ->check(CLI::Range(0, 40));
  command
      ->add_option("--static-error", reduce->static_error, "Adds static shapes until no error under --load is larger")
      ->type_name("1%");
  command->add_option("--output", reduce->output, "File to write")->type_name("FILE.h5")->required();
  command->add_flag("--force", reduce->force, "Replace the file if it exists");
  commands.push_back({command, [reduce] { return reduce_command(*reduce); }});
}

CLI::App* add_solid_command(CLI::App& app, const char* name, const char* description, SolidArguments& solid,
                            const char* what = "Mesh of solid elements: Gmsh, Abaqus, CalculiX, Nastran") {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("FILE", solid.file, what)->required();
  const auto value = [&](const char* option, std::string& text, const char* what, const char* type) {
    command->add_option(option, text, what)->type_name(type);
  };
  value("--length-unit", solid.length_unit, "What one unit of the file is (default: m)", "mm");
  add_parts(command, solid.part, solid.parts);
  value("--youngs-modulus", solid.young, "Young's modulus, instead of the file's", "210GPa");
  value("--poisson-ratio", solid.poisson, "Poisson's ratio, instead of the file's", "0.3");
  value("--orthotropic", solid.orthotropic,
        "Nine constants along the mesh's axes in place of these: E_1,E_2,E_3,nu_12,nu_23,nu_13,G_12,G_23,G_13",
        "140GPa,...");
  value("--density", solid.density, "Density, instead of the file's", "7850kg/m^3");
  repeatable(
      command->add_option("--hold", solid.hold, "Set of nodes that does not move, or SET:xz along some axes only")
          ->type_name("SET"));
  command->add_option("--vtu", solid.vtu, "Write the result on the mesh for ParaView")->type_name("FILE");
  command->add_flag("--json", solid.json, "Print it as JSON");
  return command;
}

void add_modes(CLI::App& app, Commands& commands) {
  const auto solid = std::make_shared<SolidArguments>();
  CLI::App* command =
      add_solid_command(app, "modes", "Natural frequencies and shapes of an elastic body, free or supported", *solid);
  command->add_option("--count", solid->count, "How many modes, rigid ones included (default: 10)")
      ->check(CLI::Range(1, 1000));
  commands.push_back({command, [solid] { return modes_command(*solid); }});
}

// Temperatures that strain a body.
void add_heat_options(CLI::App& command, SolidArguments& solid) {
  const auto several = [&](const char* option, std::vector<std::string>& texts, const char* what, const char* type) {
    repeatable(command.add_option(option, texts, what)->type_name(type));
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

// Of stresses over a run.
void add_run_options(CLI::App& command, SolidArguments& solid) {
  command.add_option("--body", solid.body, "Of results: whose stresses (default: the only flexible body)")
      ->type_name("NAME");
  repeatable(command
                 .add_option("--instant", solid.instants,
                             "Of results: at the row nearest to this time or crank angle, or all (default: where the "
                             "stress is largest)")
                 ->type_name("12ms|370deg|all"));
  command.add_option("--largest", solid.largest, "Of results: number of instants of largest stress (default: 5)")
      ->check(CLI::Range(1, 1000));
  command.add_option("--vtkhdf", solid.vtkhdf, "Of results: write stresses at these instants for ParaView")
      ->type_name("FILE.vtkhdf");
  command.add_option("--model", solid.model_file, "Of results: where the model file lies now, if it has moved")
      ->type_name("FILE");
  command.add_flag("--force", solid.force, "Replace that file if it exists");
}

void add_stress(CLI::App& app, Commands& commands) {
  const auto solid = std::make_shared<SolidArguments>();
  CLI::App* command = add_solid_command(
      app, "stress", "Displacements and stresses of an elastic body under constant loads, or over a run", *solid,
      "Mesh of solid elements (Gmsh, Abaqus, CalculiX, Nastran), or results (.h5) of a run with a flexible body");
  repeatable(
      command
          ->add_option("--pressure", solid->pressure,
                       "Pressure on a surface or a node set's faces; with :x,y,z that of a pin pressed this way, which "
                       "falls as the cosine")
          ->type_name("SURFACE=20MPa"));
  command->add_option("--gravity", solid->gravity, "Acceleration of gravity in m/s^2")->type_name("0,0,-9.81");
  add_heat_options(*command, *solid);
  add_run_options(*command, *solid);
  commands.push_back({command, [solid] { return stress_command(*solid); }});
}

}  // namespace

void add_mesh_commands(CLI::App& app, Commands& commands) {
  add_mesh(app, commands);
  add_reduce(app, commands);
  add_modes(app, commands);
  add_stress(app, commands);
}

}  // namespace hersey::cli
