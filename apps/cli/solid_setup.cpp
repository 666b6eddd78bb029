#include "solid_setup.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>
#include <system_error>

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "option_value.h"
#include "orthotropic_option.h"

namespace hersey::cli {
namespace {

[[noreturn]] void refuse(const char* option, std::string found, std::string expected, std::string suggestion = "") {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), std::move(suggestion)});
}

template <class Sets>
const typename Sets::mapped_type& named(const Sets& sets, const std::string& name, const char* option,
                                        const char* kind) {
  if (const auto found = sets.find(name); found != sets.end()) return found->second;
  std::vector<std::string> names;
  names.reserve(sets.size());
  for (const auto& [known, set] : sets) names.push_back(known);
  refuse(option, fmt::format("the mesh has no {} '{}'", kind, name),
         names.empty() ? fmt::format("a mesh with a {}", kind) : one_of(names), did_you_mean(name, names));
}

/// The option's value, else the file's, else a fault.
double constant(const char* option, const std::string& given, const char* unit, const std::optional<double>& of_file) {
  if (!given.empty()) return in_si(option, given, unit);
  if (of_file) return *of_file;
  refuse(option, "the mesh file does not say it for every material", fmt::format("a value in {}", *unit ? unit : "1"));
}

fem::SolidMaterial material_of(const SolidArguments& a, const fem::MeshMaterial& of_file, bool needs_mass) {
  if (!a.orthotropic.empty()) {
    const std::optional<double> rho = needs_mass || of_file.density ? of_file.density : std::optional<double>(0);
    return orthotropic_material(a.orthotropic, constant("--density", a.density, "kg/m^3", rho));
  }
  fem::ElasticMaterial material;
  material.youngs_modulus = constant("--youngs-modulus", a.young, "Pa", of_file.youngs_modulus);
  material.poisson_ratio = constant("--poisson-ratio", a.poisson, "1", of_file.poisson_ratio);
  const std::optional<double> density = needs_mass || of_file.density ? of_file.density : std::optional<double>(0);
  material.density = constant("--density", a.density, "kg/m^3", density);
  if (!(material.youngs_modulus > 0))
    refuse("--youngs-modulus", fmt::format("{} Pa", material.youngs_modulus), "a modulus > 0, such as 210 GPa");
  if (!(-1 < material.poisson_ratio && material.poisson_ratio < 0.5))
    refuse("--poisson-ratio", fmt::format("{}", material.poisson_ratio), "a ratio between -1 and 0.5, ends excluded");
  if (!(material.density >= 0) || (needs_mass && material.density == 0))
    refuse("--density", fmt::format("{} kg/m^3", material.density), "a density > 0, such as 7850 kg/m^3");
  return fem::isotropic(material);
}

/// All missing constants are reported at once.
void require_constants(const SolidArguments& a, const std::vector<fem::MeshMaterial>& materials, bool needs_mass) {
  std::vector<Fault> faults;
  const auto need = [&](const char* option, const std::string& given, const char* expected, auto member) {
    bool in_file = true;
    for (const fem::MeshMaterial& material : materials) in_file = in_file && (material.*member).has_value();
    if (given.empty() && !in_file)
      faults.push_back({{"", 0, 0}, option, "the mesh file does not say it", expected, "give it on the command line"});
  };
  if (a.orthotropic.empty()) {
    need("--youngs-modulus", a.young, "Young's modulus, such as 210GPa", &fem::MeshMaterial::youngs_modulus);
    need("--poisson-ratio", a.poisson, "Poisson's ratio, such as 0.3", &fem::MeshMaterial::poisson_ratio);
  }
  if (needs_mass) need("--density", a.density, "a density, such as 7850kg/m^3", &fem::MeshMaterial::density);
  if (!faults.empty()) throw InputError(std::move(faults));
}

Vector3 vector_of(const char* option, const std::string& text, const char* expected) {
  Vector3 v;
  const char *at = text.data(), *end = text.data() + text.size();
  for (int k = 0; k < 3; ++k) {
    const auto [next, error] = std::from_chars(at, end, v[k]);
    const bool last = k == 2;
    if (error != std::errc() || (last ? next != end : next == end || *next != ','))
      refuse(option, "'" + text + "'", expected);
    at = next + 1;
  }
  return v;
}

/// Nodal forces of "20MPa" or, as a pin pressed that way does it, "20MPa:0,1,0" on a surface or the faces of a set.
Eigen::VectorXd pressure_of(const fem::Mesh& mesh, const std::string& name, const std::string& text) {
  const std::size_t colon = text.find(':');
  const double pressure = in_si("--pressure", text.substr(0, colon), "Pa");
  std::vector<fem::ElementFace> faces = fem::faces_called(mesh, name);
  if (faces.empty()) faces = named(mesh.surfaces, name, "--pressure", "surface");
  if (colon == std::string::npos) return fem::pressure_load(mesh, faces, pressure);
  const Vector3 towards =
      vector_of("--pressure", text.substr(colon + 1), "three numbers behind the colon, such as 0,1,0");
  if (!(towards.norm() > 0)) refuse("--pressure", "'" + text + "'", "a direction of some length");
  return pressure * fem::cosine_pressure_load(mesh, faces, towards.normalized());
}

}  // namespace

fem::ElasticBody solid_of(const SolidArguments& arguments, bool needs_mass) {
  std::vector<Fault> warnings, material_faults;
  fem::Mesh mesh =
      fem::read_mesh(arguments.file, length_unit(arguments.length_unit), &warnings, &material_faults, arguments.part);
  const fem::MeshQuality quality = fem::quality_of(mesh);
  if (std::vector<Fault> faults = fem::faults_of(quality, arguments.file, parts_of(arguments.parts)); !faults.empty())
    throw InputError(std::move(faults));
  for (const Fault& warning : fem::warnings_of(quality, arguments.file, parts_of(arguments.parts)))
    warnings.push_back(warning);
  warn(warnings);
  const bool is_of_file = (arguments.orthotropic.empty() && (arguments.young.empty() || arguments.poisson.empty())) ||
                          (needs_mass && arguments.density.empty());
  if (is_of_file && !material_faults.empty()) throw InputError(material_faults);
  std::vector<fem::MeshMaterial> of_file = mesh.materials;
  if (of_file.empty()) of_file.emplace_back();
  require_constants(arguments, of_file, needs_mass);
  std::vector<fem::SolidMaterial> materials;
  materials.reserve(of_file.size());
  for (const fem::MeshMaterial& material : of_file) materials.push_back(material_of(arguments, material, needs_mass));
  return fem::assemble(std::move(mesh), std::move(materials));
}

std::vector<int> fixed_dofs_of(const SolidArguments& arguments, const fem::Mesh& mesh) {
  std::vector<int> fixed;
  for (const std::string& text : arguments.hold) {
    const std::size_t colon = mesh.node_sets.count(text) ? std::string::npos : text.rfind(':');
    std::array<bool, 3> axes = {true, true, true};
    if (colon != std::string::npos) {
      axes.fill(false);
      for (const char axis : text.substr(colon + 1)) {
        if (axis < 'x' || axis > 'z') refuse("--hold", "'" + text + "'", "letters x, y and z behind the colon");
        axes[static_cast<std::size_t>(axis - 'x')] = true;
      }
    }
    const std::vector<int>& nodes = named(mesh.node_sets, text.substr(0, colon), "--hold", "set of nodes");
    const std::vector<int> dofs = fem::dofs_of(nodes, axes);
    fixed.insert(fixed.end(), dofs.begin(), dofs.end());
  }
  return fixed;
}

Eigen::VectorXd loads_of(const SolidArguments& arguments, const fem::ElasticBody& body) {
  const bool is_warmed = !arguments.temperature.empty() || !arguments.cooling.empty() || !arguments.heat.empty();
  if (arguments.pressure.empty() && arguments.gravity.empty() && !is_warmed)
    refuse("--pressure", "nothing loads the body",
           "--pressure SURFACE=20MPa, --gravity 0,0,-9.81, --temperature 80degC, or several");
  Eigen::VectorXd f = Eigen::VectorXd::Zero(body.size());
  for (const std::string& text : arguments.pressure) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) refuse("--pressure", "'" + text + "'", "a surface and a value, SURFACE=20MPa");
    f += pressure_of(body.mesh, text.substr(0, equals), text.substr(equals + 1));
  }
  if (!arguments.gravity.empty())
    f +=
        fem::gravity_load(body, vector_of("--gravity", arguments.gravity, "three numbers in m/s^2, such as 0,0,-9.81"));
  return f;
}

}  // namespace hersey::cli
