#pragma once

#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Values at every node or element: one column each, one row per component (1 scalar, 3 vector, 6 symmetric tensor in
/// the order xx, yy, zz, xy, yz, xz, by which the file names them).
struct VtuField {
  std::string name;
  Eigen::MatrixXd values;
};

/// Content of one .vtu file.
struct VtuFrame {
  Eigen::Matrix3Xd positions;         ///< positions of the nodes [m]; empty: those of the mesh
  std::vector<VtuField> node_fields;  ///< fields such as displacement or stress averaged at nodes
  std::vector<VtuField> element_fields;
};

/// Writes an unstructured grid of VTK's XML format, binary (raw, appended), with nodes' and elements' labels as the
/// integer fields `node` and `element`.
/// @throws std::runtime_error naming the file if it cannot be written. @pre columns as many as nodes or elements.
/// @see VTK File Formats (vtk.org), "XML File Formats". @verified_by vtu_file_test.cpp
void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const VtuFrame& frame);

/// Series of .vtu files over time that ParaView opens as one: a .pvd file and a folder of its name beside it.
class VtuSeries {
 public:
  /// Creates the folder; the .pvd file is complete after every `add`.
  explicit VtuSeries(std::filesystem::path pvd);
  /// Writes the next file, for this time [s]. @throws std::runtime_error naming the file if it cannot be written
  void add(double time, const Mesh& mesh, const VtuFrame& frame);

  /// Saves or restores the list of files; on restoring, files of later times are removed from the series.
  void persist(Archive& archive);

 private:
  [[nodiscard]] std::string name_of(std::size_t file) const;
  void write_index() const;

  std::filesystem::path pvd_;
  std::vector<std::pair<double, std::string>> files_;
};

}  // namespace hersey::fem
