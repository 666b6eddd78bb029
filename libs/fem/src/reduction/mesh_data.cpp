// The mesh of a reduced body in its file: the data for loads on faces, pictures and stresses.
#include "reduction/mesh_data.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "element/element_kind.h"

namespace hersey::fem {
namespace {

using Integers = std::vector<long long>;

void require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error(what);
}

template <class Items, class Read>
Integers integers(const Items& items, Read&& read) {
  Integers values;
  values.reserve(items.size());
  for (const auto& item : items) values.push_back(read(item));
  return values;
}

void write_elements(Hdf5File& file, const Mesh& mesh) {
  file.write("mesh/element_types", integers(mesh.elements, [](const Element& e) { return static_cast<int>(e.type); }));
  file.write("mesh/element_labels", integers(mesh.elements, [](const Element& e) { return e.label; }));
  file.write("mesh/element_materials", integers(mesh.elements, [](const Element& e) { return e.material; }));
  file.write("mesh/connectivity", integers(mesh.connectivity, [](int n) { return n; }));
}

void write_sets(Hdf5File& file, const Mesh& mesh) {
  std::size_t index = 0;
  for (const auto& [name, nodes] : mesh.node_sets) {
    const std::string path = fmt::format("mesh/node_sets/{}/", index++);
    file.write_text(path + "name", name);
    file.write(path + "nodes", integers(nodes, [](int n) { return n; }));
  }
  index = 0;
  for (const auto& [name, faces] : mesh.surfaces) {
    const std::string path = fmt::format("mesh/surfaces/{}/", index++);
    file.write_text(path + "name", name);
    file.write(path + "elements", integers(faces, [](const ElementFace& f) { return f.element; }));
    file.write(path + "faces", integers(faces, [](const ElementFace& f) { return f.face; }));
  }
}

/// The integers of a data set, each at least `low` and less than `high`.
Integers read_within(const Hdf5File& file, const std::string& name, long long low, std::size_t high) {
  Integers values = file.read_integers(name);
  for (const long long value : values)
    require(value >= low && value < static_cast<long long>(high),
            fmt::format("data set '{}' has {}, not from {} to {}", name, value, low, static_cast<long long>(high) - 1));
  return values;
}

void read_elements(const Hdf5File& file, Mesh& mesh) {
  const Integers types = read_within(file, "mesh/element_types", 0, element_kinds().size());
  const Integers labels = file.read_integers("mesh/element_labels");
  const Integers materials = read_within(file, "mesh/element_materials", -1, std::numeric_limits<int>::max());
  const Integers nodes = read_within(file, "mesh/connectivity", 0, mesh.nodes.size());
  require(labels.size() == types.size() && materials.size() == types.size(),
          "data sets 'mesh/element_types', 'element_labels' and 'element_materials' differ in length");
  std::size_t first = 0;
  for (std::size_t e = 0; e < types.size(); ++e) {
    const auto type = static_cast<ElementType>(types[e]);
    require(kind_of(type).shape, "data set 'mesh/element_types' has a beam");
    mesh.elements.push_back(
        {type, static_cast<long>(labels[e]), static_cast<int>(first), static_cast<int>(materials[e])});
    first += static_cast<std::size_t>(node_count(type));
  }
  require(nodes.size() == first,
          fmt::format("data set 'mesh/connectivity' has {} nodes for elements of {}", nodes.size(), first));
  mesh.connectivity.assign(nodes.begin(), nodes.end());
}

void read_sets(const Hdf5File& file, Mesh& mesh) {
  for (std::size_t index = 0; file.has(fmt::format("mesh/node_sets/{}", index)); ++index) {
    const std::string path = fmt::format("mesh/node_sets/{}/", index);
    const Integers nodes = read_within(file, path + "nodes", 0, mesh.nodes.size());
    mesh.node_sets[file.read_text(path + "name")].assign(nodes.begin(), nodes.end());
  }
  for (std::size_t index = 0; file.has(fmt::format("mesh/surfaces/{}", index)); ++index) {
    const std::string path = fmt::format("mesh/surfaces/{}/", index);
    const Integers elements = read_within(file, path + "elements", 0, mesh.elements.size());
    const Integers faces = read_within(file, path + "faces", 0, 6);
    require(elements.size() == faces.size(), fmt::format("data sets of '{}' differ in length", path));
    std::vector<ElementFace>& surface = mesh.surfaces[file.read_text(path + "name")];
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const auto element = static_cast<std::size_t>(elements[i]);
      require(faces[i] < face_count(mesh.elements[element].type),
              fmt::format("data set '{}faces' has a face that its element has not", path));
      surface.push_back({static_cast<int>(elements[i]), static_cast<int>(faces[i])});
    }
  }
}

void read_materials(const Hdf5File& file, ReducedBody& body) {
  const Eigen::MatrixXd D = file.read_matrix("materials/D");
  const std::vector<double> density = file.read_numbers("materials/density");
  require(D.cols() == 6 && D.rows() == 6 * static_cast<Eigen::Index>(density.size()) && D.allFinite(),
          "data set 'materials/D' is not six rows of six finite numbers for each of 'materials/density'");
  for (const double rho : density)
    require(std::isfinite(rho) && rho >= 0,
            "data set 'materials/density' has a density that is negative or not finite");
  for (std::size_t m = 0; m < density.size(); ++m)
    body.materials.push_back({D.middleRows<6>(6 * static_cast<Eigen::Index>(m)), density[m]});
  for (const Element& element : body.mesh.elements)
    require(element.material >= -1 && element.material < static_cast<int>(density.size()),
            fmt::format("element {} has a material that is not in 'materials'", element.label));
}

}  // namespace

void write_mesh_data(Hdf5File& file, const ReducedBody& body) {
  const Mesh& mesh = body.mesh;
  if (mesh.elements.empty()) return;
  file.write("mesh/node_labels", integers(mesh.node_labels, [](long label) { return label; }));
  write_elements(file, mesh);
  write_sets(file, mesh);
  if (body.materials.empty()) return;
  Eigen::MatrixXd D(6 * static_cast<Eigen::Index>(body.materials.size()), 6);
  std::vector<double> density;
  density.reserve(body.materials.size());
  for (const SolidMaterial& material : body.materials) {
    D.middleRows<6>(6 * static_cast<Eigen::Index>(density.size())) = material.D;
    density.push_back(material.density);
  }
  file.write("materials/D", D);
  file.write("materials/density", density);
}

void read_mesh_data(const Hdf5File& file, ReducedBody& body) {
  Mesh& mesh = body.mesh;
  mesh.nodes = body.nodes;
  mesh.node_labels.resize(mesh.nodes.size());
  std::iota(mesh.node_labels.begin(), mesh.node_labels.end(), 1);
  if (!file.has("mesh/element_types")) return;
  if (file.has("mesh/node_labels")) {
    const Integers labels = file.read_integers("mesh/node_labels");
    require(labels.size() == mesh.nodes.size(), "data set 'mesh/node_labels' has not one number for each node");
    mesh.node_labels.assign(labels.begin(), labels.end());
  }
  read_elements(file, mesh);
  read_sets(file, mesh);
  if (file.has("materials/D")) read_materials(file, body);
}

}  // namespace hersey::fem
