#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <stdexcept>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "hersey/fem/imported_body.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/matrix_market.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/reduced_body_file.h"
#include "hersey/session/output_file.h"
#include "option_value.h"
#include "orthotropic_option.h"
#include "table.h"

namespace hersey::cli {
namespace {

using fem::Mesh;

constexpr int kMostModes = 1000;  // as in models

[[noreturn]] void fail(const char* option, std::string found, std::string expected, std::string suggestion = {}) {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), std::move(suggestion)});
}

const std::vector<int>& nodes_of(const Mesh& mesh, const std::string& set) {
  std::vector<std::string> names;
  names.reserve(mesh.node_sets.size());
  for (const auto& [name, nodes] : mesh.node_sets) names.push_back(name);
  const auto found = mesh.node_sets.find(set);
  if (found == mesh.node_sets.end())
    fail("--frame", fmt::format("no set '{}' in the mesh", set), one_of(names), did_you_mean(set, names));
  if (found->second.empty()) fail("--frame", fmt::format("the set '{}' has no nodes", set), "a set with nodes");
  return found->second;
}

// "big_end", "pin=big_end" or "pin=big_end:average"; the origin is the centre of the set's faces.
fem::InterfaceFrame frame_of(const Mesh& mesh, const std::string& text) {
  fem::InterfaceFrame frame;
  const std::size_t colon = text.rfind(':'), equals = text.find('=');
  const std::string connection = colon == std::string::npos ? "rigid" : text.substr(colon + 1);
  if (connection != "rigid" && connection != "average")
    fail("--frame", fmt::format("'{}'", connection), "rigid or average");
  const std::string names = text.substr(0, colon);
  const std::string set = equals == std::string::npos ? names : names.substr(equals + 1);
  frame.name = equals == std::string::npos ? set : names.substr(0, equals);
  frame.connection = connection == "rigid" ? fem::Connection::rigid : fem::Connection::average;
  frame.nodes = nodes_of(mesh, set);
  frame.origin = fem::face_centre(mesh, frame.nodes);
  if (frame.connection == fem::Connection::average) frame.weights = fem::face_weights(mesh, frame.nodes);
  return fem::braced(mesh, std::move(frame));
}

double constant(const char* option, const std::string& given, const std::optional<double>& in_file, const char* unit,
                const std::string& material) {
  if (!given.empty()) return in_si(option, given, unit);
  if (!in_file)
    fail(option,
         material.empty() ? "none, and the mesh has no material"
                          : fmt::format("none, and material '{}' of the mesh has none", material),
         dimension_of(unit).name);
  return *in_file;
}

// One material for each of the mesh file's; values from the command line hold for all of them.
std::vector<fem::SolidMaterial> materials_of(const Mesh& mesh, const ReduceArguments& arguments) {
  std::vector<fem::MeshMaterial> in_file = mesh.materials;
  if (in_file.empty()) in_file.emplace_back();
  std::vector<fem::SolidMaterial> materials;
  for (const fem::MeshMaterial& material : in_file) {
    if (!arguments.orthotropic.empty()) {
      materials.push_back(orthotropic_material(
          arguments.orthotropic, constant("--density", arguments.density, material.density, "kg/m^3", material.name)));
      continue;
    }
    const double E =
        constant("--youngs-modulus", arguments.youngs_modulus, material.youngs_modulus, "Pa", material.name);
    const double nu = constant("--poisson-ratio", arguments.poisson_ratio, material.poisson_ratio, "1", material.name);
    const double rho = constant("--density", arguments.density, material.density, "kg/m^3", material.name);
    if (!(E > 0)) fail("--youngs-modulus", fmt::format("{} Pa", E), "a modulus > 0");
    if (!(nu > -1 && nu < 0.5)) fail("--poisson-ratio", fmt::format("{}", nu), "a ratio between -1 and 0.5");
    if (!(rho > 0)) fail("--density", fmt::format("{} kg/m^3", rho), "a density > 0");
    materials.push_back(fem::isotropic({.youngs_modulus = E, .poisson_ratio = nu, .density = rho}));
  }
  return materials;
}

fem::ElasticBody body_of(Mesh mesh, const ReduceArguments& arguments, const std::vector<Fault>& material_faults) {
  if (arguments.stiffness.empty() != arguments.mass.empty())
    fail("--stiffness, --mass", "one without the other", "both matrices, or a material");
  if (!arguments.stiffness.empty())
    return fem::import_body(std::move(mesh), fem::read_matrix_market(arguments.stiffness),
                            fem::read_matrix_market(arguments.mass), arguments.stiffness.string());
  const bool has_moduli =
      !arguments.orthotropic.empty() || (!arguments.youngs_modulus.empty() && !arguments.poisson_ratio.empty());
  const bool is_of_file = !has_moduli || arguments.density.empty();
  if (is_of_file && !material_faults.empty()) throw InputError(material_faults);
  std::vector<fem::SolidMaterial> materials = materials_of(mesh, arguments);
  return fem::assemble(std::move(mesh), std::move(materials));
}

// "1%" or "0.01".
double share_of(const std::string& text) {
  const bool percent = !text.empty() && text.back() == '%';
  const double share =
      in_si("--static-error", percent ? text.substr(0, text.size() - 1) : text, "1") * (percent ? 0.01 : 1);
  if (!(share > 0 && share < 1)) fail("--static-error", "'" + text + "'", "a share between 0 and 1, such as 1%");
  return share;
}

std::vector<fem::LoadedSurface> surfaces_of(const Mesh& mesh, const ReduceArguments& arguments) {
  std::vector<fem::LoadedSurface> surfaces;
  for (const std::string& name : arguments.loads) {
    if (fem::faces_called(mesh, name).empty()) {
      std::set<std::string> names;
      for (const auto& [known, nodes] : mesh.node_sets) names.insert(known);
      for (const auto& [known, faces] : mesh.surfaces) names.insert(known);
      const std::vector<std::string> all(names.begin(), names.end());
      fail("--load", names.count(name) > 0 ? "'" + name + "' has no faces" : "no surface or set '" + name + "'",
           one_of(all), did_you_mean(name, all));
    }
    surfaces.push_back(fem::loaded_surface(mesh, name, arguments.harmonics));
  }
  return surfaces;
}

fem::ReductionOptions options_of(const Mesh& mesh, const ReduceArguments& arguments) {
  fem::ReductionOptions options;
  options.modes = arguments.modes;
  if (!arguments.highest.empty()) options.highest = 2 * std::numbers::pi * in_si("--highest", arguments.highest, "Hz");
  options.surfaces = surfaces_of(mesh, arguments);
  if (arguments.static_error.empty()) return options;
  options.static_error = share_of(arguments.static_error);
  if (options.surfaces.empty()) fail("--static-error", "no --load", "a surface that carries load: --load SET");
  return options;
}

void print_static_errors(const fem::ReducedBody& reduced) {
  if (reduced.static_errors.empty()) return;
  std::vector<std::vector<std::string>> lines = {{"load on", "pressures", "static error, modes alone", "reduced body"}};
  for (const fem::StaticError& error : reduced.static_errors)
    lines.push_back({error.surface, fmt::format("{}", error.shapes), fmt::format("{:.3g} %", 100 * error.modes),
                     fmt::format("{:.3g} %", 100 * error.reduced)});
  fmt::print("{}", aligned(lines, 1));
}

void print(const fem::ElasticBody& body, const fem::ReducedBody& reduced, const std::filesystem::path& output) {
  fmt::print("nodes     {} ({} degrees of freedom), {:.6g} kg\n", body.node_count(), body.size(), body.mass);
  std::vector<std::vector<std::string>> lines = {{"frame", "connection", "nodes", "x, y, z [m]"}};
  for (const fem::InterfaceFrame& frame : reduced.frames)
    lines.push_back({frame.name, frame.connection == fem::Connection::rigid ? "rigid" : "average",
                     fmt::format("{}", frame.nodes.size()),
                     fmt::format("{:.6g}, {:.6g}, {:.6g}", frame.origin.x(), frame.origin.y(), frame.origin.z())});
  fmt::print("{}", aligned(lines, lines.front().size()));
  std::vector<std::string> frequencies;
  for (const double omega : reduced.internal_omega)
    frequencies.push_back(fmt::format("{:.5g}", omega / (2 * std::numbers::pi)));
  fmt::print("modes     {} with all frames fixed [Hz]: {}\n", frequencies.size(), fmt::join(frequencies, ", "));
  print_static_errors(reduced);
  fmt::print("reduced   {} coordinates: {}\n", reduced.size(), output.string());
}

}  // namespace

int reduce_command(const ReduceArguments& arguments) {
  if (arguments.modes > kMostModes)
    fail("--modes", fmt::format("{} modes", arguments.modes), fmt::format("at most {}", kMostModes),
         "a body of so many coordinates is computed as it is: `form: nodal` in a model");
  std::vector<std::filesystem::path> inputs{arguments.file};
  for (const std::filesystem::path& matrix : {arguments.stiffness, arguments.mass})
    if (!matrix.empty()) inputs.push_back(matrix);
  session::require_separate({{"--output", arguments.output}}, inputs);
  if (std::filesystem::exists(arguments.output) && !arguments.force)
    fail("--output", fmt::format("{} exists", arguments.output.string()), "a new file", "use --force to replace it");
  std::vector<Fault> warnings, material_faults;
  Mesh mesh =
      fem::read_mesh(arguments.file, length_unit(arguments.length_unit), &warnings, &material_faults, arguments.part);
  const fem::MeshQuality quality = fem::quality_of(mesh);
  for (const Fault& warning : fem::warnings_of(quality, arguments.file, parts_of(arguments.parts)))
    warnings.push_back(warning);
  warn(warnings);
  const std::vector<Fault> faults = fem::faults_of(quality, arguments.file, parts_of(arguments.parts));
  if (!faults.empty()) throw InputError(faults);
  std::vector<fem::InterfaceFrame> frames;
  for (const std::string& text : arguments.frames) frames.push_back(frame_of(mesh, text));
  const fem::ElasticBody body = body_of(std::move(mesh), arguments, material_faults);
  const fem::Reduction reduction = fem::reduce(body, frames, options_of(body.mesh, arguments));
  if (!reduction.solved()) throw std::runtime_error(reduction.message);
  fem::write_reduced_body(arguments.output, reduction.body);
  print(body, reduction.body, arguments.output);
  return kOk;
}

}  // namespace hersey::cli
