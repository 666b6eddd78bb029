#include "strength/stored_motion.h"

#include <algorithm>
#include <cmath>

namespace hersey::run {

Vector3 vector_at(const results::Reader& results, const std::string& path, std::size_t row) {
  const results::Array values = results.read_rows(path, row, 1);
  return {values.values[0], values.values[1], values.values[2]};
}

Matrix3 orientation_at(const results::Reader& results, const std::string& body, std::size_t row) {
  const std::string path = "/bodies/" + body + "/orientation";
  if (!results.has(path)) return Matrix3::Identity();
  const std::vector<double> q = results.read_rows(path, row, 1).values;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

Vector3 origin_at(const results::Reader& results, const std::string& body, std::size_t row) {
  const std::string path = "/bodies/" + body + "/position";
  return results.has(path) ? vector_at(results, path, row) : Vector3(Vector3::Zero());
}

std::size_t row_at(const std::vector<double>& times, double time) {
  const auto next = std::lower_bound(times.begin(), times.end(), time);
  auto row = static_cast<std::size_t>(std::min(next - times.begin(), static_cast<std::ptrdiff_t>(times.size()) - 1));
  if (row > 0 && std::abs(times[row - 1] - time) < std::abs(times[row] - time)) --row;
  return row;
}

}  // namespace hersey::run
