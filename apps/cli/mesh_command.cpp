#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cad_mesh.h"
#include "commands.h"
#include "exit_code.h"
#include "fault_json.h"
#include "found_surfaces.h"
#include "hersey/core/input_error.h"
#include "hersey/fem/gmsh_file.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/skin.h"
#include "hersey/fem/vtu_file.h"
#include "hersey/session/output_file.h"
#include "hersey/workbench/mesh_document.h"
#include "option_value.h"
#include "standard_streams.h"
#include "table.h"

namespace hersey::cli {
namespace {

using fem::Mesh;
using fem::MeshQuality;

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

void print(const Mesh& mesh, const MeshQuality& quality, bool has_sets) {
  fmt::print("nodes     {} ({} degrees of freedom)\n", mesh.nodes.size(), 3 * mesh.nodes.size());
  fmt::print("{}", box_text(quality));
  fmt::print("volume    {:.6g} m^3\n", quality.volume);
  if (quality.mass)
    fmt::print("mass      {:.6g} kg\n", *quality.mass);
  else
    fmt::print("mass      unknown: the file does not say the density of every element (--density)\n");
  for (const fem::MeshMaterial& material : mesh.materials) fmt::print("{}", material_text(material));
  if (!mesh.ties.empty()) fmt::print("ties      {} equations between displacements\n", mesh.ties.size());
  fmt::print("\n{}\n", quality_text(quality));
  if (has_sets) fmt::print("{}\n", sets_text(mesh));
}

void write_picture(const Mesh& mesh, const std::filesystem::path& path) {
  fem::VtuField shape{"shape", Eigen::MatrixXd(1, static_cast<Eigen::Index>(mesh.elements.size()))};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    shape.values(0, static_cast<Eigen::Index>(e)) = fem::element_shape(mesh, mesh.elements[e]);
  fem::VtuFrame frame;
  frame.element_fields.push_back(std::move(shape));
  fem::write_vtu(path, mesh, frame);
}

[[noreturn]] void refuse_option(const char* option, std::string found, std::string expected,
                                std::string suggestion = {}) {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), std::move(suggestion)});
}

CadOptions cad_options(const MeshArguments& arguments) {
  CadOptions options;
  if (arguments.size.empty())
    refuse_option("--size", "none, and " + arguments.file + " is no mesh yet",
                  "how large elements are, such as --size 4mm");
  options.size = in_si("--size", arguments.size, "m");
  if (!(options.size > 0)) refuse_option("--size", arguments.size, "a length > 0, such as 4mm");
  options.order = arguments.order;
  options.around = arguments.around;
  options.time_limit = in_si("--time-limit", arguments.time_limit, "s");
  if (!(options.time_limit > 0)) refuse_option("--time-limit", arguments.time_limit, "a time > 0, such as 10min");
  if (!arguments.length_unit.empty() && !has_no_unit(arguments.file))
    refuse_option("--length-unit", arguments.length_unit, "nothing: STEP and IGES files say their unit themselves");
  options.length_unit = length_unit(arguments.length_unit.empty() ? "mm" : arguments.length_unit);
  return options;
}

void refuse_cad_options(const MeshArguments& arguments) {
  if (!arguments.size.empty())
    refuse_option("--size", arguments.size, "a CAD file (.step, .stp, .iges, .igs, .brep)",
                  arguments.file + " has its elements already");
}

/// Path of the mesh with its named surfaces: beside a CAD file; for a mesh, only on request.
std::filesystem::path output_of(const MeshArguments& arguments) {
  std::filesystem::path output = arguments.output;
  if (output.empty() && is_cad_file(arguments.file))
    output = std::filesystem::path(arguments.file).replace_extension(".msh");
  if (output.empty()) return output;
  if (fem::mesh_format_of(output) != fem::MeshFormat::gmsh)
    refuse_option("--output", output.string(), "a file that ends in .msh: it is written as Gmsh does");
  if (!arguments.force && std::filesystem::exists(output))
    refuse_option("--output", fmt::format("{} exists", output.string()), "a new file",
                  "use --force to replace it, or --output to write elsewhere");
  return output;
}

std::string cad_text(const MeshArguments& arguments, const CadOptions& options) {
  const bool is_brep = has_no_unit(arguments.file);
  const std::string stated = is_brep ? "" : unit_stated_in(arguments.file);
  std::string unit = "in the unit that it says";
  if (!stated.empty()) unit = "in " + stated;
  if (is_brep) unit = fmt::format("taken to be in {:.6g} mm (--length-unit)", 1e3 * options.length_unit);
  return fmt::format("meshed    by gmsh: {}, {}; elements of {:.6g} mm, order {}, {} or more around a circle\n",
                     arguments.file, unit, 1e3 * options.size, options.order, options.around);
}

void print_found(const Mesh& mesh, const std::vector<fem::FoundSurface>& found, const std::string& file,
                 const std::string& unit, const std::filesystem::path& output) {
  fmt::print("{}", found_text(found));
  std::string lines;
  if (!output.empty()) {
    fmt::print("\nwritten   {}: in metres (length_unit: 1 m), with these surfaces by their names\n", output.string());
    lines = workbench::model_lines(found, output.string(), "1 m");
  } else {
    std::vector<fem::FoundSurface> named;
    for (const fem::FoundSurface& surface : found)
      if (mesh.surfaces.contains(surface.name)) named.push_back(surface);
    lines = workbench::model_lines(named, file, unit.find_first_of("0123456789") == 0 ? unit : "1 " + unit);
    if (named.size() < found.size())
      fmt::print("  the file has no names for some of them; a mesh that has: --output FILE.msh\n");
  }
  if (!lines.empty()) fmt::print("\n{}", lines);
}

/// A mesh read from a file, with the messages of its reader.
struct Loaded {
  Mesh mesh;
  std::vector<Fault> warnings, material_faults;
};

// Beams have no faces to name, and Gmsh's format distinguishes them from marks by the absence of solids.
void write_named(Mesh mesh, const std::vector<fem::FoundSurface>& found, const std::filesystem::path& output,
                 std::vector<Fault>& warnings) {
  for (const fem::Element& element : mesh.elements)
    if (element.type == fem::ElementType::beam2)
      refuse_option("--output", fmt::format("element {} is a beam", element.label), "a mesh of solids alone");
  fem::add_surfaces(mesh, found);
  fem::write_gmsh(output, mesh);
  if (!mesh.ties.empty())
    warnings.push_back({{output.string(), 0, 0},
                        "",
                        "no ties",
                        "those of the mesh that was read",
                        "its format has none: compute with the file that was read"});
  if (!mesh.materials.empty())
    warnings.push_back({{output.string(), 0, 0},
                        "",
                        "no materials",
                        "those of the mesh that was read",
                        "its format has none: give the material in the model"});
}

}  // namespace

int mesh_command(const MeshArguments& arguments) {
  const bool is_cad = is_cad_file(arguments.file);
  const std::filesystem::path output = output_of(arguments);
  session::require_separate({{"--output", output}, {"--vtu", arguments.vtu}}, {arguments.file});
  Loaded loaded;
  std::string unit = arguments.length_unit.empty() ? "m" : arguments.length_unit, made;
  if (is_cad) {
    const CadOptions options = cad_options(arguments);
    std::optional<Mesh> mesh = mesh_of_cad(arguments.file, options);
    if (!mesh) {
      say("hersey: stopped on request; nothing was written\n");
      return kInterrupted;
    }
    loaded.mesh = std::move(*mesh);
    made = cad_text(arguments, options);
  } else {
    refuse_cad_options(arguments);
    loaded.mesh =
        fem::read_mesh(arguments.file, length_unit(unit), &loaded.warnings, &loaded.material_faults, arguments.part);
  }
  Mesh& mesh = loaded.mesh;
  std::vector<Fault>& warnings = loaded.warnings;
  MeshQuality quality = fem::quality_of(mesh);
  if (!arguments.density.empty()) quality.mass = in_si("--density", arguments.density, "kg/m^3") * quality.volume;
  for (const Fault& warning : fem::warnings_of(quality, arguments.file, parts_of(arguments.parts)))
    warnings.push_back(warning);
  warnings.insert(warnings.end(), loaded.material_faults.begin(), loaded.material_faults.end());
  const std::vector<Fault> faults = fem::faults_of(quality, arguments.file, parts_of(arguments.parts));
  const std::vector<fem::FoundSurface> found = fem::find_surfaces(mesh);
  if (is_cad) fem::add_surfaces(mesh, found);
  if (!output.empty() && faults.empty()) write_named(mesh, found, output, warnings);
  if (!arguments.vtu.empty()) write_picture(mesh, arguments.vtu);
  if (arguments.json) {
    nlohmann::json document = nlohmann::json::parse(workbench::mesh_json(mesh, quality));
    document["file"] = arguments.file;
    if (!output.empty() && faults.empty()) document["output"] = output.string();
    document["found"] = nlohmann::json::parse(workbench::found_json(found));
    document["faults"] = nlohmann::json::array();
    document["warnings"] = nlohmann::json::array();
    for (const Fault& fault : faults) document["faults"].push_back(fault_json(fault));
    for (const Fault& warning : warnings) document["warnings"].push_back(fault_json(warning));
    fmt::print("{}\n", document.dump(2));
    return faults.empty() ? kOk : kWrongInput;
  }
  fmt::print("{}", made);
  print(mesh, quality, !is_cad);
  print_found(mesh, found, arguments.file, unit, faults.empty() ? output : "");
  warn(warnings);
  if (!faults.empty()) throw InputError(faults);
  return kOk;
}

}  // namespace hersey::cli
