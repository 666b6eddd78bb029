#include "hersey/fem/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/input_file.h"
#include "mesh/mesh_readers.h"

namespace hersey::fem {
namespace {

constexpr const char* kIncludeAnywhere = "HERSEY_INCLUDE_ANYWHERE";
constexpr int kDeepestInclude = 8;
constexpr int kMostIncludes = 1000;

/// True if a name leads out of a folder, by its own path or by a link.
bool leads_out_of(const std::filesystem::path& folder, const std::filesystem::path& name) {
  std::error_code error;
  const std::filesystem::path inside = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error);
  const std::filesystem::path target = std::filesystem::weakly_canonical(inside / name, error);
  if (error) return true;
  const std::filesystem::path from_there = target.lexically_relative(inside);
  return from_there.empty() || *from_there.begin() == "..";
}

bool may_include_anywhere() {
  const char* const allowed = std::getenv(kIncludeAnywhere);
  return allowed != nullptr && std::string_view(allowed) == "1";
}

/// Loads the files that a mesh file includes, up to a limit: files that include each other repeatedly multiply.
class FolderIncludes {
 public:
  explicit FolderIncludes(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::string operator()(const std::string& name) {
    // A mesh comes from elsewhere: it does not choose which files of this machine are read and shown in faults.
    if (leads_out_of(folder_, name) && !may_include_anywhere())
      throw std::runtime_error(
          fmt::format("not in the mesh's folder; {}=1 in the environment allows that", kIncludeAnywhere));
    InputFile file = read_input_file(folder_ / name, kLargestTextFile - bytes_);
    if (!file.fault.empty()) throw std::runtime_error(file.fault);
    bytes_ += file.content.size();
    if (++files_ > kMostIncludes) throw std::runtime_error(fmt::format("one more than {} files", kMostIncludes));
    return std::move(file.content);
  }

 private:
  std::filesystem::path folder_;
  std::uintmax_t bytes_ = 0;
  int files_ = 0;
};

RawMesh read_raw(std::string_view text, MeshFormat format, const std::string& name, const IncludeLoader& include,
                 const std::string& part) {
  if (!part.empty() && format != MeshFormat::abaqus)
    throw InputError(
        Fault{{name, 0, 0}, "", fmt::format("part '{}'", part), "a file of Abaqus: others have no parts", ""});
  switch (format) {
    case MeshFormat::gmsh:
      return read_gmsh(text, name);
    case MeshFormat::abaqus:
      return read_abaqus(text, name, include, part);
    case MeshFormat::nastran:
      return read_nastran(text, name, include);
  }
  HERSEY_REQUIRE(false, "a format of the enumeration");
  return {};
}

}  // namespace

std::string included_text(const IncludeLoader& include, const std::string& name, int depth) {
  if (depth >= kDeepestInclude) throw std::runtime_error("included too deep");
  if (!include) throw std::runtime_error("no readable file");
  return include(name);
}

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".msh") return MeshFormat::gmsh;
  if (ending == ".inp") return MeshFormat::abaqus;
  if (ending == ".bdf" || ending == ".nas" || ending == ".dat") return MeshFormat::nastran;
  return std::nullopt;
}

Mesh read_mesh(const std::filesystem::path& path, double length_unit, std::vector<Fault>* warnings,
               std::vector<Fault>* material_faults, const std::string& part) {
  const std::optional<MeshFormat> format = mesh_format_of(path);
  const SourcePosition position{path.string(), 0, 0};
  if (!format)
    throw InputError(Fault{position, "", fmt::format("a file ending in '{}'", path.extension().string()),
                           "a mesh: .msh (Gmsh), .inp (Abaqus, CalculiX) or .bdf, .nas, .dat (Nastran)", ""});
  const InputFile file = read_input_file(path);
  if (!file.fault.empty()) throw InputError(Fault{position, "", file.fault, "a mesh file", "check its path"});
  return parse_mesh(file.content, *format, path.string(), length_unit, warnings, FolderIncludes(path.parent_path()),
                    material_faults, part);
}

Mesh parse_mesh(std::string_view text, MeshFormat format, const std::string& name, double length_unit,
                std::vector<Fault>* warnings, const IncludeLoader& include, std::vector<Fault>* material_faults,
                const std::string& part) {
  HERSEY_REQUIRE(length_unit > 0, "a unit of length");
  RawMesh raw = read_raw(text, format, name, include, part);
  Mesh mesh = finished(raw, length_unit);
  if (warnings != nullptr) warnings->insert(warnings->end(), raw.warnings.begin(), raw.warnings.end());
  if (material_faults != nullptr)
    material_faults->insert(material_faults->end(), raw.material_faults.begin(), raw.material_faults.end());
  return mesh;
}

}  // namespace hersey::fem
