#pragma once

#include <hdf5.h>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hersey::results {

/// Attribute of a dimension scale that has several names: the first of them.
inline constexpr const char* scale_path = "path";

/// The group whose datasets grow together with the one at `path`: the nearest group named `fields`, else the root.
[[nodiscard]] std::string growth_group(const std::string& path);

/// Names the dimensions of datasets: dimension scales as HDF5's high-level library defines them, without the lists in
/// the scales of who uses them. A scale gets a link in each group that uses it, for readers look there.
class DimensionScales {
 public:
  explicit DimensionScales(hid_t file) : file_(file) {}

  /// Makes the dataset at `path` a dimension. False if HDF5 refuses.
  /// @param name  of the dimension; empty: the last part of the path
  [[nodiscard]] bool make_scale(hid_t dataset, const std::string& path, const std::string& name = {});

  /// Names the dimensions of a dataset by scales made before, one for each. False if HDF5 refuses.
  [[nodiscard]] bool attach(hid_t dataset, const std::string& path, const std::vector<std::string>& scales);

  /// The scale of the rows of datasets that grow with the one at `path`; that dataset itself if it is the first.
  [[nodiscard]] std::string of_rows(const std::string& path);

  [[nodiscard]] bool has(const std::string& scale) const { return references_.contains(scale); }

  /// Gives a dataset its name in another group, too; "" is the root. False if HDF5 refuses.
  [[nodiscard]] bool link(const std::string& dataset, const std::string& group);

 private:
  hid_t file_;
  std::map<std::string, hobj_ref_t> references_;
  std::map<std::string, std::string> rows_;  ///< of each growth group
  std::set<std::string> links_;
};

}  // namespace hersey::results
