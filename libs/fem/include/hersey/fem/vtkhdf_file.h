#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Cells of an unstructured grid as VTK has them.
struct VtkCells {
  Eigen::Matrix3Xd points;              ///< [m]
  std::vector<long long> connectivity;  ///< indices in `points`, cell after cell
  std::vector<long long> offsets{0};    ///< where each cell begins in `connectivity`, and the end of the last
  std::vector<std::uint8_t> types;
};

/// Returns the elements of a mesh as cells; the points are the mesh's nodes.
[[nodiscard]] VtkCells vtk_cells(const Mesh& mesh);

/// Returns faces as cells, with the nodes on them alone.
[[nodiscard]] VtkCells vtk_cells(const Mesh& mesh, const std::vector<ElementFace>& faces);

/// A field of a VTKHDF file.
struct VtkHdfField {
  std::string name;
  bool on_cells = false;     ///< else on points
  int components = 1;        ///< rows of its values
  bool is_constant = false;  ///< the same at all times, written once
};

/// Unstructured grid with fields over time, in one file of format VTKHDF 2.0, which ParaView 5.12 and later open with
/// their times. Its cells stay the same, its points may move. The file appears under its name with close(); until then
/// it is `<path>.new`.
/// @see VTKHDF File Format (docs.vtk.org). @verified_by loads_test.py, films_test.py
class VtkHdfFile {
 public:
  /// Writes grid and times; fields are filled by write(). @throws std::runtime_error naming the file
  /// @param moves  the points of each time are written by write_points()
  VtkHdfFile(std::filesystem::path path, const VtkCells& cells, std::vector<VtkHdfField> fields,
             const std::vector<double>& times, bool moves = false);
  VtkHdfFile(const VtkHdfFile&) = delete;
  VtkHdfFile& operator=(const VtkHdfFile&) = delete;
  ~VtkHdfFile();

  /// Writes values (components, points or cells) of field number `field` at time number `step`, 0 for a constant one.
  /// @throws std::runtime_error naming the file
  void write(std::size_t step, std::size_t field, const Eigen::MatrixXd& values);

  /// Writes the points of a grid that moves at time number `step` [m]. @throws std::runtime_error naming the file
  void write_points(std::size_t step, const Eigen::Matrix3Xd& points);

  /// Writes names, such as those of the parts that a field numbers, beside the grid: VTK passes over it.
  /// @throws std::runtime_error naming the file
  void write_names(const std::string& name, const std::vector<std::string>& texts);

  /// Completes the file. @throws std::runtime_error naming the file
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::fem
