#pragma once

#include <hdf5.h>

#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

#include "hersey/core/hdf5_handle.h"

namespace hersey::fem {

/// An open HDF5 file with the few kinds of data of a body. Data sets are named by their path, "frames/0/origin"; groups
/// on the path are created. Nothing is printed: failures throw std::runtime_error with the data set's name. While the
/// object exists, its thread alone uses HDF5.
class Hdf5File {
 public:
  static Hdf5File create(const std::filesystem::path& path) { return {path, true}; }
  static Hdf5File open(const std::filesystem::path& path) { return {path, false}; }

  /// A matrix as (rows, columns), first index slowest.
  void write(const std::string& name, const Eigen::MatrixXd& values);
  void write(const std::string& name, const std::vector<double>& values);
  void write(const std::string& name, const std::vector<long long>& values);
  void write_text(const std::string& name, const std::string& text);

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] Eigen::MatrixXd read_matrix(const std::string& name) const;
  [[nodiscard]] std::vector<double> read_numbers(const std::string& name) const;
  [[nodiscard]] std::vector<long long> read_integers(const std::string& name) const;
  [[nodiscard]] std::string read_text(const std::string& name) const;

 private:
  Hdf5File(const std::filesystem::path& path, bool is_new);
  void write(const std::string& name, hid_t stored, hid_t type, const std::vector<hsize_t>& shape, const void* values);
  [[nodiscard]] std::vector<std::size_t> shape_of(const std::string& name) const;
  void read(const std::string& name, hid_t type, void* values) const;

  Hdf5Session session_;  // ends after the file is closed
  Hdf5Handle file_;
};

}  // namespace hersey::fem
