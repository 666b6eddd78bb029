#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "fault_json.h"
#include "hersey/core/input_error.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/skin.h"
#include "hersey/fem/vtu_file.h"
#include "option_value.h"
#include "output_file.h"
#include "table.h"

namespace hersey::cli {
namespace {

using fem::Mesh;
using fem::MeshQuality;

nlohmann::json json_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::json sets_json(const Mesh& mesh) {
  nlohmann::json sets = {{"nodes", nlohmann::json::object()},
                         {"elements", nlohmann::json::object()},
                         {"surfaces", nlohmann::json::object()}};
  for (const auto& [name, set] : mesh.node_sets) sets["nodes"][name] = set.size();
  for (const auto& [name, set] : mesh.element_sets) sets["elements"][name] = set.size();
  for (const auto& [name, set] : mesh.surfaces) sets["surfaces"][name] = set.size();
  return sets;
}

nlohmann::json quality_json(const MeshQuality& quality) {
  nlohmann::json types = nlohmann::json::object();
  for (const auto& [type, of_type] : quality.types) {
    nlohmann::json entry = {{"count", of_type.count}};
    if (type != fem::ElementType::beam2) {
      entry["smallest_shape"] = of_type.smallest_shape;
      entry["mean_shape"] = of_type.mean_shape;
      entry["label_of_smallest_shape"] = of_type.label_of_smallest;
      entry["largest_aspect"] = of_type.largest_aspect;
    }
    types[fem::name_of(type)] = std::move(entry);
  }
  return types;
}

nlohmann::json document_of(const Mesh& mesh, const MeshQuality& quality) {
  nlohmann::json materials = nlohmann::json::array();
  for (const fem::MeshMaterial& material : mesh.materials) {
    nlohmann::json entry = {{"name", material.name}};
    if (material.youngs_modulus) entry["youngs_modulus"] = *material.youngs_modulus;
    if (material.poisson_ratio) entry["poisson_ratio"] = *material.poisson_ratio;
    if (material.density) entry["density"] = *material.density;
    materials.push_back(std::move(entry));
  }
  nlohmann::json document = {{"nodes", mesh.nodes.size()},
                             {"degrees_of_freedom", 3 * mesh.nodes.size()},
                             {"elements", quality_json(quality)},
                             {"box", {{"lower", json_of(quality.lower)}, {"upper", json_of(quality.upper)}}},
                             {"volume", quality.volume},
                             {"outer_faces", fem::outer_faces(mesh).size()},
                             {"materials", std::move(materials)},
                             {"sets", sets_json(mesh)}};
  document["mass"] = quality.mass ? nlohmann::json(*quality.mass) : nlohmann::json();
  document["units"] = {
      {"box", "m"}, {"volume", "m^3"}, {"mass", "kg"}, {"youngs_modulus", "Pa"}, {"density", "kg/m^3"}};
  return document;
}

std::string box_text(const MeshQuality& quality) {
  const Vector3 size = quality.upper - quality.lower;
  return fmt::format("box       {:.5g} x {:.5g} x {:.5g} m, from ({:.5g}, {:.5g}, {:.5g})\n", size.x(), size.y(),
                     size.z(), quality.lower.x(), quality.lower.y(), quality.lower.z());
}

std::string quality_text(const MeshQuality& quality) {
  std::vector<std::vector<std::string>> lines = {
      {"elements", "count", "smallest shape", "of element", "mean shape", "largest aspect"}};
  for (const auto& [type, of_type] : quality.types) {
    const std::string name = fem::name_of(type), count = fmt::format("{}", of_type.count);
    if (type == fem::ElementType::beam2) {
      lines.push_back({name, count});
      continue;
    }
    lines.push_back({name, count, fmt::format("{:.3f}", of_type.smallest_shape),
                     fmt::format("{}", of_type.label_of_smallest), fmt::format("{:.3f}", of_type.mean_shape),
                     fmt::format("{:.2f}", of_type.largest_aspect)});
  }
  return aligned(lines, lines.front().size());
}

std::string sets_text(const Mesh& mesh) {
  std::vector<std::vector<std::string>> lines = {{"set", "nodes", "elements", "faces"}};
  for (const auto& [name, nodes] : mesh.node_sets) {
    const auto elements = mesh.element_sets.find(name);
    const auto faces = mesh.surfaces.find(name);
    lines.push_back({name, fmt::format("{}", nodes.size()),
                     elements == mesh.element_sets.end() ? "-" : fmt::format("{}", elements->second.size()),
                     faces == mesh.surfaces.end() ? "-" : fmt::format("{}", faces->second.size())});
  }
  return lines.size() > 1 ? aligned(lines, lines.front().size()) : "  no sets\n";
}

std::string material_text(const fem::MeshMaterial& material) {
  const auto value = [](const char* symbol, const std::optional<double>& number, const char* unit) {
    return number ? fmt::format("{} = {:.5g}{}", symbol, *number, unit) : fmt::format("no {}", symbol);
  };
  return fmt::format("material  {}: {}, {}, {}\n", material.name, value("E", material.youngs_modulus, " Pa"),
                     value("nu", material.poisson_ratio, ""), value("rho", material.density, " kg/m^3"));
}

void print(const Mesh& mesh, const MeshQuality& quality) {
  fmt::print("nodes     {} ({} degrees of freedom)\n", mesh.nodes.size(), 3 * mesh.nodes.size());
  fmt::print("{}", box_text(quality));
  fmt::print("volume    {:.6g} m^3\n", quality.volume);
  if (quality.mass)
    fmt::print("mass      {:.6g} kg\n", *quality.mass);
  else
    fmt::print("mass      unknown: the file does not say the density of every element (--density)\n");
  for (const fem::MeshMaterial& material : mesh.materials) fmt::print("{}", material_text(material));
  fmt::print("\n{}\n{}", quality_text(quality), sets_text(mesh));
}

void write_picture(const Mesh& mesh, const std::filesystem::path& path) {
  fem::VtuField shape{"shape", Eigen::MatrixXd(1, static_cast<Eigen::Index>(mesh.elements.size()))};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    shape.values(0, static_cast<Eigen::Index>(e)) = fem::element_shape(mesh, mesh.elements[e]);
  fem::VtuFrame frame;
  frame.element_fields.push_back(std::move(shape));
  fem::write_vtu(path, mesh, frame);
}

}  // namespace

int mesh_command(const MeshArguments& arguments) {
  require_separate({{"--vtu", arguments.vtu}}, {arguments.file});
  std::vector<Fault> warnings, material_faults;
  const Mesh mesh = fem::read_mesh(arguments.file, length_unit(arguments.length_unit), &warnings, &material_faults);
  MeshQuality quality = fem::quality_of(mesh);
  if (!arguments.density.empty()) quality.mass = in_si("--density", arguments.density, "kg/m^3") * quality.volume;
  for (const Fault& warning : fem::warnings_of(quality, arguments.file)) warnings.push_back(warning);
  warnings.insert(warnings.end(), material_faults.begin(), material_faults.end());
  const std::vector<Fault> faults = fem::faults_of(quality, arguments.file);
  if (!arguments.vtu.empty()) write_picture(mesh, arguments.vtu);
  if (arguments.json) {
    nlohmann::json document = document_of(mesh, quality);
    document["file"] = arguments.file;
    document["faults"] = nlohmann::json::array();
    document["warnings"] = nlohmann::json::array();
    for (const Fault& fault : faults) document["faults"].push_back(fault_json(fault));
    for (const Fault& warning : warnings) document["warnings"].push_back(fault_json(warning));
    fmt::print("{}\n", document.dump(2));
    return faults.empty() ? kOk : kWrongInput;
  }
  print(mesh, quality);
  warn(warnings);
  if (!faults.empty()) throw InputError(faults);
  return kOk;
}

}  // namespace hersey::cli
