// MSC Nastran Quick Reference Guide: large fields of 16 characters, PLOAD4, SPC1, MPC, MAT1, MAT9, PSOLID; of heat
// CHBDYG, CONV, MAT4, NLPARM, PCONV, SPC, SPOINT, TEMP, TEMPD.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

#include "element/element_kind.h"
#include "export/file_scale.h"
#include "hersey/core/write_file.h"
#include "hersey/fem/skin.h"

namespace hersey::fem {
namespace {

using Path = std::filesystem::path;
using Fields = std::vector<std::string>;

/// A number with ten digits, in 16 characters.
std::string real(double value) { return fmt::format("{:.9E}", value); }
std::string integer(long value) { return std::to_string(value); }

void add_card(std::string& text, const char* name, const Fields& fields, std::size_t per_line, std::size_t width) {
  const bool is_large = width > 8;
  for (std::size_t i = 0; i < fields.size(); i += per_line) {
    text += fmt::format("{:<8}", i > 0 ? (is_large ? "*" : "+") : name + std::string(is_large ? "*" : ""));
    for (std::size_t k = i; k < std::min(i + per_line, fields.size()); ++k)
      text += fmt::format("{:>{}}", fields[k], width);
    text += '\n';
  }
}

/// A card in fields of 8 characters: integers.
void add_small(std::string& text, const char* name, const Fields& fields) { add_card(text, name, fields, 8, 8); }
/// A card in fields of 16 characters. It has lines in pairs.
void add_large(std::string& text, const char* name, Fields fields) {
  while (fields.size() % 8 != 0) fields.emplace_back();
  add_card(text, name, fields, 4, 16);
}

/// Text of a bulk data file for one body.
class NastranText {
 public:
  NastranText(const LoadedBody& body, FileUnits units) : body_(body), scale_(scale_of(units)), units_(units) {}

  [[nodiscard]] std::string text() const {
    std::string text = case_control();
    add_nodes(text);
    add_elements(text);
    add_materials(text);
    add_supports(text);
    for (const MeshTie& tie : body_.mesh.ties) add_tie(text, tie);
    for (std::size_t k = 0; k < body_.instants.size(); ++k)
      add_loads(text, static_cast<long>(k) + 1, body_.instants[k]);
    if (is_strained_by_heat(body_)) add_temperatures(text);
    return text + "ENDDATA\n";
  }

  [[nodiscard]] std::string heat() const {
    std::string text = fmt::format(
        "$ Body {}: steady conduction of heat, temperatures in degC. Units: {}.\n"
        "$ Temperatures of grid points: {}.\n"
        "SOL 153\nCEND\nANALYSIS = HEAT\nTHERMAL = ALL\nFLUX = ALL\nSPCFORCES = ALL\nSPC = 1\nNLPARM = 1\n"
        "TEMPERATURE(INITIAL) = 2\nBEGIN BULK\n",
        body_.name, units_ == FileUnits::si ? "m, W, K" : "mm, mW, K", body_.heat->source);
    add_small(text, "NLPARM", {"1"});
    add_large(text, "TEMPD", {"2", real(in_celsius(body_.heat->T_reference))});
    add_nodes(text);
    add_elements(text);
    for (std::size_t m = 0; m < body_.materials.size(); ++m) {
      const std::string id = integer(static_cast<long>(m) + 1);
      add_small(text, "PSOLID", {id, id});
      add_large(text, "MAT4", {id, real(scale_.conductivity * body_.heat->material.conductivity)});
    }
    for (const auto& [node, T] : body_.heat->prescribed)
      add_large(text, "SPC", {"1", integer(label_of(node)), "", real(in_celsius(T))});
    add_cooling(text);
    return text + "ENDDATA\n";
  }

 private:
  [[nodiscard]] long label_of(int node) const { return body_.mesh.node_labels[static_cast<std::size_t>(node)]; }

  [[nodiscard]] std::string case_control() const {
    std::string text = fmt::format("$ Body {}: a subcase for each instant. Units: {}.\nSOL 101\nCEND\n", body_.name,
                                   units_ == FileUnits::si ? "m, N, kg, s, Pa" : "mm, N, t, s, MPa");
    if (body_.fixed_dofs.empty())
      text += "$ No support was named: add SPC here, or write the file with --hold SET.\n";
    else
      text += "SPC = 1\n";
    if (!body_.mesh.ties.empty()) text += "MPC = 1\n";
    if (is_strained_by_heat(body_))
      text += fmt::format("$ Temperatures [degC], steady: {}.\nTEMPERATURE(LOAD) = {}\n", body_.heat->source,
                          temperature_set());
    text += "DISPLACEMENT = ALL\nSTRESS = ALL\n";
    for (std::size_t k = 0; k < body_.instants.size(); ++k)
      text += fmt::format("SUBCASE {0}\n  LABEL = {1}\n  LOAD = {0}\n", k + 1, body_.instants[k].name);
    return text + "BEGIN BULK\n";
  }

  void add_nodes(std::string& text) const {
    for (std::size_t n = 0; n < body_.mesh.nodes.size(); ++n) {
      const Vector3 x = scale_.length * body_.mesh.nodes[n];
      add_large(text, "GRID", {integer(body_.mesh.node_labels[n]), "", real(x.x()), real(x.y()), real(x.z())});
    }
  }

  void add_elements(std::string& text) const {
    for (const Element& element : body_.mesh.elements) {
      const ElementKind& kind = kind_of(element.type);
      Fields fields(static_cast<std::size_t>(kind.nodes) + 2);
      fields[0] = integer(element.label);
      fields[1] = integer(std::max(element.material, 0) + 1);
      for (int a = 0; a < kind.nodes; ++a) {
        const auto k = static_cast<std::size_t>(a);
        const std::size_t at = kind.files.nastran_order.empty() ? k : kind.files.nastran_order[k];
        fields[2 + at] = integer(label_of(body_.mesh.nodes_of(element)[a]));
      }
      add_small(text, kind.files.nastran, fields);
    }
  }

  void add_materials(std::string& text) const {
    for (std::size_t m = 0; m < body_.materials.size(); ++m) {
      const SolidMaterial& material = body_.materials[m];
      const std::string id = integer(static_cast<long>(m) + 1);
      add_small(text, "PSOLID", {id, id});
      const std::string density = material.density > 0 ? real(scale_.density * material.density) : "";
      if (const auto constants = as_isotropic(material)) {
        Fields fields{id, real(scale_.pressure * constants->youngs_modulus), "", real(constants->poisson_ratio),
                      density};
        if (is_strained_by_heat(body_))
          fields.insert(fields.end(),
                        {real(body_.heat->material.expansion), real(in_celsius(body_.heat->T_reference))});
        add_large(text, "MAT1", fields);
        continue;
      }
      Fields fields{id};  // xx, yy, zz, xy, yz, zx as here
      for (int row = 0; row < 6; ++row)
        for (int column = row; column < 6; ++column) fields.push_back(real(scale_.pressure * material.D(row, column)));
      fields.push_back(density);
      if (is_strained_by_heat(body_)) {
        for (const bool along : {true, true, true, false, false, false})
          fields.push_back(along ? real(body_.heat->material.expansion) : "");
        fields.push_back(real(in_celsius(body_.heat->T_reference)));
      }
      add_large(text, "MAT9", fields);
    }
  }

  void add_supports(std::string& text) const {
    std::map<int, std::string> components;  // of each node
    const std::set<int> fixed(body_.fixed_dofs.begin(), body_.fixed_dofs.end());
    for (const int dof : fixed) components[dof / 3] += integer(dof % 3 + 1);
    for (const auto& [node, axes] : components) add_small(text, "SPC1", {"1", axes, integer(label_of(node))});
  }

  void add_tie(std::string& text, const MeshTie& tie) const {
    Fields fields{"1"};
    for (std::size_t k = 0; k < tie.size(); ++k) {
      if (k > 0 && k % 2 == 0)
        fields.insert(fields.end(), {"", ""});  // the last field of a line and the first of the next
      for (std::string& field :
           Fields{integer(label_of(tie[k].node)), integer(tie[k].axis + 1), real(tie[k].coefficient)})
        fields.push_back(std::move(field));
    }
    add_large(text, "MPC", fields);
  }

  void add_loads(std::string& text, long id, const LoadInstant& instant) const {
    for (std::size_t f = 0; f < body_.faces.size(); ++f) {
      const ElementFace& face = body_.faces[f];
      const Element& element = body_.mesh.elements[static_cast<std::size_t>(face.element)];
      const auto [first, second] = grid_points(element, face.face);
      add_large(text, "PLOAD4",
                {integer(id), integer(element.label),
                 real(scale_.pressure * instant.pressures[static_cast<Eigen::Index>(f)]), "", "", "", first, second});
    }
  }

  /// Set of the temperatures, beside those of the loads.
  [[nodiscard]] std::size_t temperature_set() const { return body_.instants.size() + 1; }

  void add_temperatures(std::string& text) const {
    for (std::size_t n = 0; n < body_.mesh.nodes.size(); ++n)
      add_large(text, "TEMP",
                {std::to_string(temperature_set()), integer(body_.mesh.node_labels[n]),
                 real(in_celsius(body_.heat->T[static_cast<Eigen::Index>(n)]))});
  }

  /// A surface element and its convection for each cooled face, a scalar point for each temperature of surroundings.
  void add_cooling(std::string& text) const {
    const Mesh& mesh = body_.mesh;
    std::map<double, long> materials, points;  // of coefficients and of surroundings' temperatures
    long element = 0;
    for (const Element& other : mesh.elements) element = std::max(element, other.label);
    const long last_node = *std::max_element(mesh.node_labels.begin(), mesh.node_labels.end());
    const std::vector<CooledFace> cooled = cooled_faces_once(body_.heat->cooled);
    if (cooled.empty())
      text += "$ No surface was named that cools: add CONV here, or write the files with --cooling.\n";
    for (const CooledFace& face : cooled) {
      const auto number = [](std::map<double, long>& of, double value, long before) {
        return of.try_emplace(value, before + static_cast<long>(of.size()) + 1);
      };
      const auto [material, is_new_material] =
          number(materials, face.transfer, static_cast<long>(body_.materials.size()));
      const auto [point, is_new_point] = number(points, face.T_ambient, last_node);
      const std::string id = integer(material->second), ambient = integer(point->second);
      if (is_new_material) {
        add_large(text, "MAT4", {id, "", "", "", real(scale_.transfer * face.transfer)});
        add_small(text, "PCONV", {id, id});
      }
      if (is_new_point) {
        add_small(text, "SPOINT", {ambient});
        add_large(text, "SPC", {"1", ambient, "", real(in_celsius(face.T_ambient))});
      }
      const std::vector<int> nodes = nodes_of(mesh, face.face);
      Fields fields{integer(++element), "", fmt::format("AREA{}", nodes.size()), "", "", "", "", ""};
      for (const int node : nodes) fields.push_back(integer(label_of(node)));
      add_small(text, "CHBDYG", fields);
      add_small(text, "CONV", {integer(element), id, "", "", ambient});
    }
  }

  /// What names a face: of a quadrilateral two opposite corners, of a tetrahedron a corner and the one that is not on
  /// it, of a wedge's triangle a corner.
  [[nodiscard]] std::pair<std::string, std::string> grid_points(const Element& element, int face) const {
    const std::vector<int>& nodes = face_nodes(element.type, face);
    const int* all = body_.mesh.nodes_of(element);
    const std::string first = integer(label_of(all[nodes[0]]));
    switch (element.type) {
      case ElementType::tet4:
      case ElementType::tet10: {
        const int opposite = 6 - nodes[0] - nodes[1] - nodes[2];  // the corners are 0 to 3
        return {first, integer(label_of(all[opposite]))};
      }
      case ElementType::pyramid5:
      case ElementType::pyramid13:
        throw std::runtime_error(
            fmt::format("body {}: a film lies on pyramids, whose faces programs name in different ways in PLOAD4; mesh "
                        "the film's surface with other elements",
                        body_.name));
      default: {
        const bool is_triangle = nodes.size() == 3 || nodes.size() == 6;
        return {first, is_triangle ? std::string() : integer(label_of(all[nodes[2]]))};
      }
    }
  }

  const LoadedBody& body_;
  FileScale scale_;
  FileUnits units_;
};

}  // namespace

void write_nastran_loads(const Path& folder, const LoadedBody& body, FileUnits units) {
  const NastranText text(body, units);
  std::vector<std::pair<Path, std::string>> files{{folder / (body.name + ".bdf"), text.text()}};
  if (body.heat) files.emplace_back(folder / (body.name + "_heat.bdf"), text.heat());
  for (const auto& [path, content] : files) {
    try {
      write_file(path, {content});
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
    }
  }
}

}  // namespace hersey::fem
