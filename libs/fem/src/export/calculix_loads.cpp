// Dhondt, CalculiX CrunchiX USER'S MANUAL 2.20: *DLOAD, *AMPLITUDE, *ELASTIC, *STEP, *HEAT TRANSFER,
// *FILM, *TEMPERATURE. Fields have at most 20 characters.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <stdexcept>

#include "element/element_kind.h"
#include "export/file_scale.h"
#include "hersey/core/write_file.h"

namespace hersey::fem {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t longest_name = 60;  // the program takes 80 characters, and adds to them

/// A name as the program takes it: letters, digits, - and _.
std::string calculix_name(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-') c = '_';
  return name.substr(0, longest_name);
}

/// Text of input files for one body.
class CalculixText {
 public:
  CalculixText(const LoadedBody& body, FileUnits units) : body_(body), scale_(scale_of(units)), units_(units) {}

  [[nodiscard]] std::string mesh() const {
    std::string text = heading("mesh");
    const Mesh& mesh = body_.mesh;
    text += "*NODE, NSET=NALL\n";
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Vector3 x = scale_.length * mesh.nodes[n];
      add(text, "{}, {:.12g}, {:.12g}, {:.12g}\n", mesh.node_labels[n], x.x(), x.y(), x.z());
    }
    add_elements(text);
    add_sets(text);
    for (const MeshTie& tie : mesh.ties) {
      add(text, "*EQUATION\n{}\n", tie.size());
      for (const TieTerm& term : tie)
        add(text, "{}, {}, {:.12g}\n", label_of(term.node), term.axis + 1, term.coefficient);
    }
    add_materials(text);
    if (!body_.fixed_dofs.empty()) {
      text += "*BOUNDARY\n";
      const std::set<int> fixed(body_.fixed_dofs.begin(), body_.fixed_dofs.end());
      for (const int dof : fixed) add(text, "{0}, {1}, {1}\n", label_of(dof / 3), dof % 3 + 1);
    }
    return text;
  }

  [[nodiscard]] std::string steps() const {
    std::string text = start("a static step for each instant");
    for (const LoadInstant& instant : body_.instants) {
      add(text, "** {}\n*STEP\n*STATIC\n", instant.name);
      if (is_strained_by_heat(body_)) text += "*TEMPERATURE\n" + include("temperatures");
      text += "*DLOAD, OP=NEW\n";
      for (std::size_t f = 0; f < body_.faces.size(); ++f)
        add(text, "{}, {:.12g}\n", load_on(f), scale_.pressure * instant.pressures[static_cast<Eigen::Index>(f)]);
      text += output;
    }
    return text;
  }

  [[nodiscard]] std::string history() const {
    std::string text = start("one step over the time, an amplitude for each face");
    const double begin = body_.instants.front().time, end = body_.instants.back().time;
    for (std::size_t f = 0; f < body_.faces.size(); ++f) {
      add(text, "*AMPLITUDE, NAME=FACE_{}", f + 1);
      for (std::size_t k = 0; k < body_.instants.size(); ++k) {
        const LoadInstant& instant = body_.instants[k];
        add(text, "{}{:.12g}, {:.12g}", k % 4 == 0 ? "\n" : ", ", instant.time - begin,
            scale_.pressure * instant.pressures[static_cast<Eigen::Index>(f)]);
      }
      text += '\n';
    }
    const auto intervals = static_cast<double>(std::max<std::size_t>(body_.instants.size() - 1, 1));
    const double length = end > begin ? end - begin : 1;
    if (is_strained_by_heat(body_)) add(text, "*AMPLITUDE, NAME=WARM\n0., 1., {:.12g}, 1.\n", length);
    add(text,
        "** Quasi-static: CalculiX takes a linear step in one go, one with NLGEOM by increments. For the body's own "
        "vibrations replace *STATIC, DIRECT by *DYNAMIC.\n"
        "** The time 0 is {:.12g} s of the run.\n"
        "*STEP, NLGEOM, INC=1000000\n*STATIC, DIRECT\n{:.12g}, {:.12g}\n",
        begin, length / intervals, length);
    if (is_strained_by_heat(body_)) text += "*TEMPERATURE, AMPLITUDE=WARM\n" + include("temperatures");
    for (std::size_t f = 0; f < body_.faces.size(); ++f)
      add(text, "*DLOAD, AMPLITUDE=FACE_{}\n{}, 1.\n", f + 1, load_on(f));
    return text + output;
  }

  /// Temperatures of all nodes, the lines of a *TEMPERATURE.
  [[nodiscard]] std::string temperatures() const {
    std::string text = heading("temperatures [degC] of its nodes, steady: " + body_.heat->source);
    for (std::size_t n = 0; n < body_.mesh.nodes.size(); ++n)
      add(text, "{}, {:.12g}\n", body_.mesh.node_labels[n], in_celsius(body_.heat->T[static_cast<Eigen::Index>(n)]));
    return text;
  }

  [[nodiscard]] std::string heat() const {
    const BodyTemperatures& heat = *body_.heat;
    std::string text = heading("steady conduction of heat, temperatures in degC, heat in " +
                               std::string(units_ == FileUnits::si ? "W" : "N.mm/s (mW)"));
    add(text, "** Temperatures of nodes: {}.\n", heat.source);
    text += include("mesh") + initial_temperature() + "*STEP\n*HEAT TRANSFER, STEADY STATE\n*BOUNDARY\n";
    for (const auto& [node, T] : heat.prescribed) add(text, "{}, 11, 11, {:.12g}\n", label_of(node), in_celsius(T));
    const std::vector<CooledFace> cooled = cooled_faces_once(heat.cooled);
    if (cooled.empty())
      text += "** No surface was named that cools: add *FILM here, or write the files with --cooling.\n";
    if (!cooled.empty()) text += "*FILM\n";
    for (const CooledFace& face : cooled)
      add(text, "{}, F{}, {:.12g}, {:.12g}\n", body_.mesh.elements[static_cast<std::size_t>(face.face.element)].label,
          face.face.face + 1, in_celsius(face.T_ambient), scale_.transfer * face.transfer);
    return text + "*NODE FILE\nNT, RFL\n*EL FILE\nHFL\n*END STEP\n";
  }

 private:
  static constexpr const char* output = "*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n";

  template <typename... Values>
  static void add(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
  }

  [[nodiscard]] std::string heading(const std::string& what) const {
    return fmt::format("** Body {}: {}. Units: {}.\n", body_.name, what,
                       units_ == FileUnits::si ? "m, N, kg, s, Pa" : "mm, N, t, s, MPa");
  }

  [[nodiscard]] std::string include(const char* part) const {
    return fmt::format("*INCLUDE, INPUT={}_{}.inp\n", calculix_name(body_.name), part);
  }

  [[nodiscard]] std::string initial_temperature() const {
    return fmt::format("*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, {:.12g}\n", in_celsius(body_.heat->T_reference));
  }

  [[nodiscard]] std::string start(const char* what) const {
    std::string text = heading(what) + include("mesh");
    if (is_strained_by_heat(body_)) text += initial_temperature();
    if (body_.fixed_dofs.empty())
      text += "** No support was named: add *BOUNDARY here, or write the files with --hold SET.\n";
    return text;
  }

  [[nodiscard]] long label_of(int node) const { return body_.mesh.node_labels[static_cast<std::size_t>(node)]; }

  /// "element, P face" of a face that carries pressure.
  [[nodiscard]] std::string load_on(std::size_t f) const {
    const ElementFace& face = body_.faces[f];
    return fmt::format("{}, P{}", body_.mesh.elements[static_cast<std::size_t>(face.element)].label, face.face + 1);
  }

  void add_elements(std::string& text) const {
    const Mesh& mesh = body_.mesh;
    std::set<ElementType> types;
    for (const Element& element : mesh.elements) types.insert(element.type);
    for (const ElementType type : types) {
      const ElementKind& kind = kind_of(type);
      if (type == ElementType::pyramid5 || type == ElementType::pyramid13)
        throw std::runtime_error(
            fmt::format("body {}: CalculiX has no pyramids ({}); mesh it with other elements", body_.name, kind.name));
      add(text, "*ELEMENT, TYPE={}, ELSET=EALL\n", kind.files.abaqus);
      for (const Element& element : mesh.elements) {
        if (element.type != type) continue;
        add(text, "{}", element.label);
        for (int a = 0; a < kind.nodes; ++a) {
          text += a == 10 ? ",\n" : ", ";  // 16 numbers on a line are the most
          add(text, "{}", label_of(mesh.nodes_of(element)[a]));
        }
        text += '\n';
      }
    }
  }

  template <typename Labels>
  static void add_list(std::string& text, const Labels& labels) {
    for (std::size_t i = 0; i < labels.size(); i += 8)
      add(text, "{}\n",
          fmt::join(labels.begin() + static_cast<std::ptrdiff_t>(i),
                    labels.begin() + static_cast<std::ptrdiff_t>(std::min(i + 8, labels.size())), ", "));
  }

  [[nodiscard]] std::vector<long> labels_of_elements(const std::vector<int>& elements) const {
    std::vector<long> labels;
    labels.reserve(elements.size());
    for (const int e : elements) labels.push_back(body_.mesh.elements[static_cast<std::size_t>(e)].label);
    return labels;
  }

  void add_surface(std::string& text, const std::string& name, const std::vector<ElementFace>& faces) const {
    if (faces.empty()) return;
    add(text, "*SURFACE, NAME={}, TYPE=ELEMENT\n", calculix_name(name));
    for (const ElementFace& face : faces)
      add(text, "{}, S{}\n", body_.mesh.elements[static_cast<std::size_t>(face.element)].label, face.face + 1);
  }

  void add_sets(std::string& text) const {
    for (const auto& [name, nodes] : body_.mesh.node_sets) {
      if (nodes.empty()) continue;
      std::vector<long> labels;
      labels.reserve(nodes.size());
      for (const int node : nodes) labels.push_back(label_of(node));
      add(text, "*NSET, NSET={}\n", calculix_name(name));
      add_list(text, labels);
    }
    for (const auto& [name, elements] : body_.mesh.element_sets) {
      if (elements.empty()) continue;
      add(text, "*ELSET, ELSET={}\n", calculix_name(name));
      add_list(text, labels_of_elements(elements));
    }
    for (const auto& [name, faces] : body_.mesh.surfaces) add_surface(text, name, faces);
    for (const auto& [name, faces] : body_.films) add_surface(text, name, faces);
  }

  void add_materials(std::string& text) const {
    const std::vector<std::vector<int>> elements = elements_by_material(body_);
    for (std::size_t m = 0; m < body_.materials.size(); ++m) {
      if (elements[m].empty()) continue;
      const SolidMaterial& material = body_.materials[m];
      add(text, "*MATERIAL, NAME=MATERIAL_{}\n", m + 1);
      if (const auto constants = as_isotropic(material)) {
        add(text, "*ELASTIC\n{:.12g}, {:.12g}\n", scale_.pressure * constants->youngs_modulus,
            constants->poisson_ratio);
      } else {
        text += "*ELASTIC, TYPE=ANISO\n";
        constexpr std::array<int, 6> order{0, 1, 2, 3, 5, 4};  // 11, 22, 33, 12, 13, 23
        int count = 0;
        for (std::size_t column = 0; column < 6; ++column)
          for (std::size_t row = 0; row <= column; ++row, ++count)
            add(text, "{}{:.12g}",
                count == 0       ? ""
                : count % 8 == 0 ? ",\n"
                                 : ", ",
                scale_.pressure * material.D(order[row], order[column]));
        text += '\n';
      }
      if (material.density > 0) add(text, "*DENSITY\n{:.12g}\n", scale_.density * material.density);
      if (body_.heat) add(text, "*CONDUCTIVITY\n{:.12g}\n", scale_.conductivity * body_.heat->material.conductivity);
      if (is_strained_by_heat(body_))
        add(text, "*EXPANSION, ZERO={:.12g}\n{:.12g}\n", in_celsius(body_.heat->T_reference),
            body_.heat->material.expansion);
      add(text, "*ELSET, ELSET=OF_MATERIAL_{}\n", m + 1);
      add_list(text, labels_of_elements(elements[m]));
      add(text, "*SOLID SECTION, ELSET=OF_MATERIAL_{0}, MATERIAL=MATERIAL_{0}\n", m + 1);
    }
  }

  const LoadedBody& body_;
  FileScale scale_;
  FileUnits units_;
};

}  // namespace

void write_calculix_loads(const Path& folder, const LoadedBody& body, FileUnits units) {
  const CalculixText text(body, units);
  const std::string name = calculix_name(body.name);
  std::vector<std::pair<Path, std::string>> files{{folder / (name + "_mesh.inp"), text.mesh()}};
  if (!body.instants.empty()) {
    files.emplace_back(folder / (name + "_steps.inp"), text.steps());
    files.emplace_back(folder / (name + "_history.inp"), text.history());
  }
  if (body.heat) {
    files.emplace_back(folder / (name + "_heat.inp"), text.heat());
    files.emplace_back(folder / (name + "_temperatures.inp"), text.temperatures());
  }
  for (const auto& [path, content] : files) {
    try {
      write_file(path, {content});
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
    }
  }
}

}  // namespace hersey::fem
