#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <system_error>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/write_file.h"
#include "hersey/fem/load_file.h"
#include "hersey/fem/vtkhdf_file.h"
#include "hersey/results/error.h"
#include "hersey/run/body_loads.h"
#include "hersey/run/model_of_results.h"
#include "hersey/session/output_file.h"
#include "instant_option.h"
#include "load_heat.h"
#include "run_stress.h"
#include "solid_setup.h"

namespace hersey::cli {
namespace {

using Path = std::filesystem::path;

constexpr double to_megapascal = 1e-6, to_millisecond = 1e3;
constexpr double to_degrees = 180 / std::numbers::pi;

[[noreturn]] void refuse_export(const char* option, std::string found, std::string expected) {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), ""});
}

void require_load_options(const ExportArguments& arguments) {
  if (!arguments.fmu.empty()) refuse_export("--fmu", "it stands beside --loads", "one of them");
  if (!arguments.ssp.empty()) refuse_export("--ssp", "it stands beside --loads", "one of them");
  if (!arguments.overrides.empty())
    refuse_export("--set", "the loads of a run are those of its own model", "another run with this, then its results");
  if (!is_results_file(arguments.file))
    refuse_export("FILE", "'" + arguments.file + "' is no results file (.h5)", "results of a run, for --loads");
  if (arguments.loads.output.empty()) refuse_export("--output", "it is missing", "a folder for the loads");
}

/// The mesh of a body that is rigid in the run, with its materials.
std::optional<fem::ElasticBody> given_mesh(const LoadsArguments& loads) {
  if (loads.mesh.empty()) return std::nullopt;
  SolidArguments solid;
  solid.file = loads.mesh, solid.length_unit = loads.length_unit;
  solid.young = loads.youngs_modulus, solid.poisson = loads.poisson_ratio, solid.density = loads.density;
  return solid_of(solid, false);
}

/// Materials of the body in the model.
const std::vector<fem::SolidMaterial>& materials_of(const model::Model& model, const std::string& name) {
  const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                 [&](const model::Body& candidate) { return candidate.name == name; });
  const model::Flexible& flexible = *body->flexible;
  const auto& materials = flexible.reduced ? flexible.reduced->materials : flexible.materials;
  if (materials.empty())
    refuse_export("--body", fmt::format("of body {} the materials are not known", name), "a body made of a mesh");
  return materials;
}

std::string name_of(const run::BodyLoadsAt& at) {
  std::string name = fmt::format("t = {:.9g} ms", at.time * to_millisecond);
  if (at.crank_angle) name += fmt::format(" crank {:.6g} deg", *at.crank_angle * to_degrees);
  return name;
}

/// A table of the instants: resultants of films and faces, and the motion that makes inertia loads.
std::string table_text(const std::vector<run::BodyLoadsAt>& instants) {
  std::string text = "time [s],crank_angle [rad]";
  for (const char* quantity : {"film", "faces"})
    for (const char* part : {"force", "moment"})
      for (const char axis : {'x', 'y', 'z'})
        text += fmt::format(",{}_{}_{} [{}]", quantity, part, axis, part[0] == 'f' ? "N" : "N.m");
  for (const char axis : {'x', 'y', 'z'}) text += fmt::format(",acceleration_{} [m/s^2]", axis);
  for (const char axis : {'x', 'y', 'z'}) text += fmt::format(",angular_velocity_{} [rad/s]", axis);
  text += '\n';
  for (const run::BodyLoadsAt& at : instants) {
    text += fmt::format("{:.12g},{}", at.time, at.crank_angle ? fmt::format("{:.12g}", *at.crank_angle) : "");
    for (const Vector6* wrench : {&at.film, &at.mapped})
      for (const int part : {3, 0})
        for (int k = 0; k < 3; ++k) text += fmt::format(",{:.12g}", (*wrench)[part + k]);
    for (const Vector3* vector : {&at.acceleration, &at.angular_velocity})
      for (const double value : *vector) text += fmt::format(",{:.12g}", value);
    text += '\n';
  }
  return text;
}

void write_faces(const Path& path, const run::BodyLoads& loads, const std::vector<run::BodyLoadsAt>& instants) {
  std::vector<double> times;
  for (const run::BodyLoadsAt& at : instants) times.push_back(at.time);
  std::vector<fem::VtkHdfField> fields{{.name = "pressure", .on_cells = true},
                                       {.name = "contact_pressure", .on_cells = true},
                                       {.name = "element", .on_cells = true, .is_constant = true},
                                       {.name = "face", .on_cells = true, .is_constant = true}};
  const bool is_warm = instants.front().temperature.size() > 0;
  if (is_warm) fields.push_back({.name = "temperature", .on_cells = true});
  fem::VtkHdfFile file(path, fem::vtk_cells(loads.mesh(), loads.faces()), fields, times);
  for (std::size_t step = 0; step < instants.size(); ++step) {
    file.write(step, 0, instants[step].pressure.transpose());
    file.write(step, 1, instants[step].contact.transpose());
    if (is_warm) file.write(step, 4, instants[step].temperature.transpose());
  }
  const auto count = static_cast<Eigen::Index>(loads.faces().size());
  Eigen::RowVectorXd elements(count), faces(count);
  for (Eigen::Index f = 0; f < count; ++f) {
    const fem::ElementFace& face = loads.faces()[static_cast<std::size_t>(f)];
    elements[f] = static_cast<double>(loads.mesh().elements[static_cast<std::size_t>(face.element)].label);
    faces[f] = face.face + 1;
  }
  file.write(0, 2, elements);
  file.write(0, 3, faces);
  file.close();
}

/// The files that a format has, the table first.
std::vector<Path> files_of(const LoadsArguments& loads, const std::string& body, bool is_warm) {
  std::vector<Path> files{loads.output / (body + "_loads.csv")};
  if (loads.format == "calculix")
    for (const char* part : {"_mesh.inp", "_steps.inp", "_history.inp"}) files.push_back(loads.output / (body + part));
  if (loads.format == "calculix" && is_warm)
    for (const char* part : {"_heat.inp", "_temperatures.inp"}) files.push_back(loads.output / (body + part));
  if (loads.format == "nastran") files.push_back(loads.output / (body + ".bdf"));
  if (loads.format == "nastran" && is_warm) files.push_back(loads.output / (body + "_heat.bdf"));
  if (loads.format == "vtkhdf") files.push_back(loads.output / (body + ".vtkhdf"));
  return files;
}

void prepare(const ExportArguments& arguments, const std::vector<Path>& files, const model::Model& model) {
  std::vector<Path> inputs{arguments.file, model.file};
  if (!arguments.loads.mesh.empty()) inputs.emplace_back(arguments.loads.mesh);
  for (const auto& [name, digest] : model.files) inputs.push_back(Path(model.file).parent_path() / name);
  std::vector<session::OutputFile> outputs;
  for (const Path& file : files) outputs.push_back({"--output", file});
  session::require_separate(outputs, inputs);
  for (const Path& file : files)
    if (!arguments.force && std::filesystem::exists(file))
      refuse_export("--output", file.string() + " exists", "another folder, or --force to replace it");
  std::error_code error;
  std::filesystem::create_directories(arguments.loads.output, error);
  if (error) throw results::WriteError(arguments.loads.output, "the folder cannot be made: " + error.message());
}

/// Figures of all instants.
struct Worst {
  double off_force = 0, off_moment = 0, pressure = 0, at_time = 0, shear = 0;
};

Worst worst_of(const std::vector<run::BodyLoadsAt>& instants) {
  Worst worst;
  for (const run::BodyLoadsAt& at : instants) {
    worst.off_force = std::max(worst.off_force, at.off_force);
    worst.off_moment = std::max(worst.off_moment, at.off_moment);
    worst.shear = std::max(worst.shear, at.shear);
    if (const double p = at.pressure.maxCoeff(); p > worst.pressure) worst.pressure = p, worst.at_time = at.time;
  }
  return worst;
}

nlohmann::json json_of(const LoadHeat& heat) {
  nlohmann::json films = nlohmann::json::object();
  for (const run::FilmTemperatures::Surface& film : heat.films) films[film.bearing] = film.mean;
  return {{"films", films}, {"heat_from_films", heat.film_heat}, {"coldest", heat.coldest}, {"warmest", heat.warmest}};
}

void print_json(const run::BodyLoads& loads, const std::vector<run::BodyLoadsAt>& instants,
                const std::optional<LoadHeat>& heat, const std::vector<Path>& files) {
  const Worst worst = worst_of(instants);
  nlohmann::json document{{"body", loads.body()},
                          {"faces", loads.faces().size()},
                          {"bearings", nlohmann::json::array()},
                          {"instants", nlohmann::json::array()},
                          {"largest_pressure", worst.pressure},
                          {"off_force", worst.off_force},
                          {"off_moment", worst.off_moment},
                          {"shear_left_out", worst.shear},
                          {"files", nlohmann::json::array()},
                          {"units",
                           {{"instants", "s"},
                            {"largest_pressure", "Pa"},
                            {"off_force", "1"},
                            {"off_moment", "1"},
                            {"shear_left_out", "N"}}}};
  if (heat) {
    document["temperatures"] = json_of(*heat);
    document["units"]["temperatures"] = {
        {"films", "degC"}, {"heat_from_films", "W"}, {"coldest", "degC"}, {"warmest", "degC"}};
  }
  for (const auto& [name, faces] : loads.films()) document["bearings"].push_back(name);
  for (const run::BodyLoadsAt& at : instants) document["instants"].push_back(at.time);
  for (const Path& file : files) document["files"].push_back(file.string());
  fmt::print("{}\n", document.dump(2));
}

void print_heat(const LoadHeat& heat) {
  for (const run::FilmTemperatures::Surface& film : heat.films)
    fmt::print("surface           {}, {:.5g} degC: mean over surface and time\n", film.bearing, film.mean);
  fmt::print("body              {:.5g} to {:.5g} degC, {:.4g} W from its films{}\n", heat.coldest, heat.warmest,
             heat.film_heat,
             heat.temperatures.cooled.empty() ? "; no surface cools it: --cooling SURFACE=80W/m^2/K:20degC" : "");
}

void print_text(const run::BodyLoads& loads, const std::vector<run::BodyLoadsAt>& instants,
                const std::optional<LoadHeat>& heat, const std::vector<Path>& files) {
  const Worst worst = worst_of(instants);
  fmt::print("body              {}, {} nodes\n", loads.body(), loads.mesh().nodes.size());
  for (const auto& [name, faces] : loads.films()) fmt::print("film              {}, {} faces\n", name, faces.size());
  fmt::print("instants          {}, from {:.6g} ms to {:.6g} ms\n", instants.size(),
             instants.front().time * to_millisecond, instants.back().time * to_millisecond);
  fmt::print("largest pressure  {:.5g} MPa on a face, t = {:.6g} ms\n", worst.pressure * to_megapascal,
             worst.at_time * to_millisecond);
  if (heat) print_heat(*heat);
  fmt::print("off the film      force {:.1e}, moment {:.1e} of the force times half the width, at most\n",
             worst.off_force, worst.off_moment);
  fmt::print("left out          shear, at most {:.4g} N; what else loads the body: joints, gravity, inertia\n",
             worst.shear);
  for (const Path& file : files) fmt::print("wrote             {}\n", file.string());
}

}  // namespace

int loads_command(const ExportArguments& arguments) {
  require_load_options(arguments);
  const LoadsArguments& asked = arguments.loads;
  const results::Reader results(arguments.file);
  const model::Model model = run::model_of_results(results, asked.model_file);
  const std::optional<fem::ElasticBody> given = given_mesh(asked);
  run::LoadRequest request{.body = asked.body, .bearings = asked.bearings};
  if (given) request.mesh = given->mesh, request.mesh_file = asked.mesh;
  const run::BodyLoads loads(results, model, std::move(request));
  const std::vector<std::size_t> chosen =
      asked.instants.empty() ? loads.last_cycle() : named_instants(asked.instants, loads.times(), loads.crank_angles());
  std::vector<run::BodyLoadsAt> instants;
  for (const std::size_t k : chosen) instants.push_back(loads.at(k));
  SolidArguments solid;
  solid.hold = asked.hold;
  const std::vector<fem::SolidMaterial>& materials = given ? given->materials : materials_of(model, loads.body());
  const std::optional<LoadHeat> heat = heat_of_loads(asked, model, loads, chosen, materials.size());
  fem::LoadedBody body{.name = loads.body(),
                       .mesh = loads.mesh(),
                       .materials = materials,
                       .fixed_dofs = fixed_dofs_of(solid, loads.mesh()),
                       .films = {},
                       .faces = loads.faces(),
                       .instants = {}};
  if (heat) body.heat = heat->temperatures;
  for (const auto& [name, faces] : loads.films()) body.films["film_" + name] = faces;
  for (const run::BodyLoadsAt& at : instants) body.instants.push_back({at.time, name_of(at), at.pressure});

  const std::vector<Path> files = files_of(asked, loads.body(), heat.has_value());
  prepare(arguments, files, model);
  write_file(files.front(), {table_text(instants)});
  const fem::FileUnits units = asked.units == "si" ? fem::FileUnits::si : fem::FileUnits::millimetres;
  if (asked.format == "calculix") fem::write_calculix_loads(asked.output, body, units);
  if (asked.format == "nastran") fem::write_nastran_loads(asked.output, body, units);
  if (asked.format == "vtkhdf") write_faces(files.back(), loads, instants);
  if (arguments.json)
    print_json(loads, instants, heat, files);
  else
    print_text(loads, instants, heat, files);
  return kOk;
}

}  // namespace hersey::cli
