#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::model {

/// Numbers and names in a row.
class Fingerprint {
 public:
  void add(double value) { bytes(&value, sizeof value); }
  void add(int value) { bytes(&value, sizeof value); }
  void add(const std::string& text) {
    add(static_cast<int>(text.size()));
    text_ += text;
  }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& A) {
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (Eigen::Index i = 0; i < A.rows(); ++i) add(static_cast<double>(A(i, j)));
  }
  void add(const std::vector<int>& list) {
    add(static_cast<int>(list.size()));
    for (const int value : list) add(value);
  }
  void add(const std::vector<fem::ElementFace>& faces) {
    add(static_cast<int>(faces.size()));
    for (const fem::ElementFace& face : faces) add(face.element), add(face.face);
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void bytes(const void* data, std::size_t size) { text_.append(static_cast<const char*>(data), size); }
  std::string text_;
};

/// Everything of a mesh.
inline void add_mesh(const fem::Mesh& mesh, Fingerprint& print) {
  for (const Vector3& node : mesh.nodes) print.add(node);
  print.add(mesh.connectivity);
  for (const fem::Element& element : mesh.elements)
    print.add(static_cast<int>(element.type)), print.add(element.material);
  for (const auto& [name, nodes] : mesh.node_sets) print.add(name), print.add(nodes);
  for (const auto& [name, faces] : mesh.surfaces) print.add(name), print.add(faces);
  for (const fem::MeshTie& tie : mesh.ties) {
    print.add(static_cast<int>(tie.size()));
    for (const fem::TieTerm& term : tie) print.add(3 * term.node + term.axis), print.add(term.coefficient);
  }
}

}  // namespace hersey::model
