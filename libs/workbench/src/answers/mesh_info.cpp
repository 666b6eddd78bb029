#include <fmt/format.h>

#include "answers/kept.h"
#include "answers/repairs.h"
#include "answers/request.h"
#include "hersey/core/units.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/workbench/answers.h"
#include "hersey/workbench/mesh_document.h"

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

}  // namespace hersey::workbench
