#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "answers/kept.h"
#include "answers/repairs.h"
#include "answers/request.h"
#include "folder/folder.h"
#include "hersey/core/units.h"
#include "hersey/fem/gmsh_file.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/workbench/answers.h"
#include "hersey/workbench/mesh_document.h"
#include "runs/temporary_folder.h"

namespace hersey::workbench {
namespace {

double length_unit_of(const std::string& text) {
  try {
    const Quantity given = text.find_first_of("0123456789") == 0 ? split_quantity(text) : Quantity{1, text};
    return convert_to_si(given, "m");
  } catch (const QuantityError& error) {
    throw Refused(422, "The length unit is " + error.found + ".", "Give one such as mm.");
  }
}

/// A file of this program's own.
std::string whole_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::filesystem::file_size(file), '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw std::runtime_error("a temporary file cannot be read");
  return text;
}

Json as_list(const std::vector<Fault>& faults, const std::string& folder) {
  Json list = Json::array();
  for (const Fault& fault : faults) list.push_back(json_of(fault, "", nullptr, TextColumns(""), "", folder));
  return list;
}

}  // namespace

std::string Answers::mesh_info(std::string_view request) const {
  const Json given = request_object(request);
  const std::string path = text_in(given, "path"), file = kept_->file(path);
  const std::string unit = text_in(given, "length_unit", "m");
  const double length = length_unit_of(unit);
  try {
    std::vector<Fault> warnings, material_faults;
    const fem::Mesh mesh = fem::read_mesh(file, length, &warnings, &material_faults, "");
    const fem::MeshQuality quality = fem::quality_of(mesh);
    const std::vector<fem::FoundSurface> found = fem::find_surfaces(mesh);
    std::vector<fem::FoundSurface> named;
    for (const fem::FoundSurface& surface : found)
      if (mesh.surfaces.contains(surface.name)) named.push_back(surface);
    const std::string written_unit = unit.find_first_of("0123456789") == 0 ? unit : "1 " + unit;
    Json answer{{"file", path}, {"length_unit", written_unit}};
    answer["lines"] = model_lines(named, path, written_unit);
    answer["unnamed"] = found.size() - named.size();
    answer["warnings"] = as_list(warnings, kept_->folder());
    answer["material_faults"] = as_list(material_faults, kept_->folder());
    answer["faults"] = as_list(fem::faults_of(quality, path, fem::Parts::one), kept_->folder());
    std::string whole = dumped(answer);
    whole.back() = ',';
    whole += "\"uses\":" + uses_json(mesh, found, text_in(given, "body", "part")) + ",";
    if (given.contains("picture") && given["picture"] == true)
      whole += "\"picture\":" + picture_json(mesh, found) + ",";
    return whole + "\"found\":" + found_json(found) + ",\"mesh\":" + mesh_json(mesh, quality) + "}";
  } catch (const InputError& error) {
    refuse(error);
  }
}

std::string Answers::name_surfaces(std::string_view request) const {
  const Json given = request_object(request);
  const std::string file = kept_->file(text_in(given, "path")), output = text_in(given, "output");
  const std::filesystem::path to = kept_->file(output);
  if (to.extension() != ".msh")
    throw Refused(422, "The mesh is to be called '" + output + "'.", "Give a name that ends with .msh.");
  if (std::filesystem::exists(to) || std::filesystem::is_symlink(to))
    throw Refused(409, "There is a file '" + output + "' already.", "Choose another name.");
  const double length = length_unit_of(text_in(given, "length_unit", "m"));
  try {
    fem::Mesh mesh = fem::read_mesh(file, length);
    const bool has_beams = std::any_of(mesh.elements.begin(), mesh.elements.end(),
                                       [](const auto& element) { return element.type == fem::ElementType::beam2; });
    if (has_beams || !mesh.ties.empty())
      throw Refused(422, "The mesh has beams or ties, which the format that is written does not have.",
                    "Name the surfaces in the program that made the mesh.");
    fem::add_surfaces(mesh, fem::find_surfaces(mesh));
    // Whatever is put in its place meanwhile, a link perhaps, is neither followed nor replaced.
    const TemporaryFolder temporary;
    const std::filesystem::path made = temporary.file("named.msh");
    fem::write_gmsh(made, mesh);
    (void)Folder(kept_->folder()).create(output, whole_text(made));
    return dumped({{"path", output}});
  } catch (const InputError& error) {
    refuse(error);
  } catch (const ChangedFile&) {
    throw Refused(409, "There is a file '" + output + "' already.", "Choose another name.");
  } catch (const Refused&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Refused(507, error.what(), "The folder may be read-only, or the disk full.");
  }
}

}  // namespace hersey::workbench
