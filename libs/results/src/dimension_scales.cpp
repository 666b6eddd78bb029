#include "dimension_scales.h"

#include <cstring>

#include "hdf5_handle.h"

namespace hersey::results {
namespace {

constexpr char scale_class[] = "DIMENSION_SCALE";

/// The high-level library wants these as fixed, terminated text.
bool set_fixed_text(hid_t object, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1)), scalar(H5Screate(H5S_SCALAR));
  H5Tset_size(type.get(), text.size() + 1);
  const Handle attribute(H5Acreate2(object, name, type.get(), scalar.get(), H5P_DEFAULT, H5P_DEFAULT));
  return attribute.valid() && H5Awrite(attribute.get(), type.get(), text.c_str()) >= 0;
}

std::string group_of(const std::string& path) { return path.substr(0, path.rfind('/')); }
std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

std::string growth_group(const std::string& path) {
  const std::string marker = "/fields/";
  const auto at = path.rfind(marker);
  return at == std::string::npos ? "/" : path.substr(0, at + marker.size() - 1);
}

bool DimensionScales::make_scale(hid_t dataset, const std::string& path, const std::string& name) {
  hobj_ref_t reference{};
  if (H5Rcreate(&reference, file_, path.c_str(), H5R_OBJECT, H5I_INVALID_HID) < 0) return false;
  references_[path] = reference;
  links_.insert(path);
  return set_fixed_text(dataset, "CLASS", scale_class) &&
         set_fixed_text(dataset, "NAME", name.empty() ? name_of(path) : name) &&
         set_fixed_text(dataset, scale_path, path);
}

bool DimensionScales::attach(hid_t dataset, const std::string& path, const std::vector<std::string>& scales) {
  std::vector<hvl_t> lists;
  for (const std::string& scale : scales) {
    if (!link(scale, group_of(path))) return false;
    lists.push_back({1, &references_.at(scale)});
  }
  const hsize_t rank = scales.size();
  const Handle type(H5Tvlen_create(H5T_STD_REF_OBJ)), space(H5Screate_simple(1, &rank, nullptr));
  const Handle attribute(H5Acreate2(dataset, "DIMENSION_LIST", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
  return attribute.valid() && H5Awrite(attribute.get(), type.get(), lists.data()) >= 0;
}

std::string DimensionScales::of_rows(const std::string& path) {
  return rows_.try_emplace(growth_group(path), path).first->second;
}

bool DimensionScales::link(const std::string& dataset, const std::string& group) {
  const std::string path = group + "/" + name_of(dataset);
  if (path == dataset || !links_.insert(path).second) return true;
  return H5Lcreate_hard(file_, dataset.c_str(), file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0;
}

}  // namespace hersey::results
