#include "hersey/fem/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "hersey/core/contract.h"
#include "mesh_readers.h"

namespace hersey::fem {
namespace {

std::optional<std::string> content_of(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string content;
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  if (size < 0) return std::nullopt;
  content.resize(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(content.data(), static_cast<std::streamsize>(size));
  if (!file) return std::nullopt;
  return content;
}

RawMesh read_raw(std::string_view text, MeshFormat format, const std::string& name, const IncludeLoader& include) {
  switch (format) {
    case MeshFormat::gmsh:
      return read_gmsh(text, name);
    case MeshFormat::abaqus:
      return read_abaqus(text, name, include);
    case MeshFormat::nastran:
      return read_nastran(text, name, include);
  }
  HERSEY_REQUIRE(false, "a format of the enumeration");
  return {};
}

}  // namespace

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".msh") return MeshFormat::gmsh;
  if (ending == ".inp") return MeshFormat::abaqus;
  if (ending == ".bdf" || ending == ".nas" || ending == ".dat") return MeshFormat::nastran;
  return std::nullopt;
}

Mesh read_mesh(const std::filesystem::path& path, double length_unit, std::vector<Fault>* warnings,
               std::vector<Fault>* material_faults) {
  const std::optional<MeshFormat> format = mesh_format_of(path);
  const SourcePosition position{path.string(), 0, 0};
  if (!format)
    throw InputError(Fault{position, "", fmt::format("a file ending in '{}'", path.extension().string()),
                           "a mesh: .msh (Gmsh), .inp (Abaqus, CalculiX) or .bdf, .nas, .dat (Nastran)", ""});
  const std::optional<std::string> text = content_of(path);
  if (!text) throw InputError(Fault{position, "", "no file that can be read", "a mesh file", "check its path"});
  const auto include = [&path](const std::string& name) { return content_of(path.parent_path() / name); };
  return parse_mesh(*text, *format, path.string(), length_unit, warnings, include, material_faults);
}

Mesh parse_mesh(std::string_view text, MeshFormat format, const std::string& name, double length_unit,
                std::vector<Fault>* warnings, const IncludeLoader& include, std::vector<Fault>* material_faults) {
  HERSEY_REQUIRE(length_unit > 0, "a unit of length");
  RawMesh raw = read_raw(text, format, name, include);
  Mesh mesh = finished(raw, length_unit);
  if (warnings != nullptr) warnings->insert(warnings->end(), raw.warnings.begin(), raw.warnings.end());
  if (material_faults != nullptr)
    material_faults->insert(material_faults->end(), raw.material_faults.begin(), raw.material_faults.end());
  return mesh;
}

}  // namespace hersey::fem
