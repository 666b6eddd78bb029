#include "hersey/core/archive.h"

#include <algorithm>

#include "hersey/core/contract.h"

namespace hersey {

Archive::Group::Group(Archive& archive, std::string_view name) : archive_(archive), length_(archive.prefix_.size()) {
  std::string part(name);
  std::replace(part.begin(), part.end(), '/', '|');  // a name given by a user is one element of the path
  archive_.prefix_ += part + "/";
}

void Archive::misfit(std::string_view name) const { throw ArchiveError("'" + path(name) + "' has another shape"); }

const Archive::Numbers& Archive::stored(std::string_view name) {
  const auto found = content_.numbers.find(path(name));
  if (found == content_.numbers.end()) throw ArchiveError("there is no '" + path(name) + "'");
  read_.insert(found->first);
  return found->second;
}

std::pair<Eigen::Index, Eigen::Index> Archive::matrix_shape(std::string_view name) {
  const Numbers& numbers = stored(name);
  if (numbers.shape.size() != 2) misfit(name);
  return {static_cast<Eigen::Index>(numbers.shape[0]), static_cast<Eigen::Index>(numbers.shape[1])};
}

void Archive::io_numbers(std::string_view name, const std::vector<std::uint64_t>& shape, double* values,
                         std::size_t count) {
  if (!restores_) {
    const bool is_new =
        content_.numbers.emplace(path(name), Numbers{shape, std::vector<double>(values, values + count)}).second;
    HERSEY_REQUIRE(is_new, "'" + path(name) + "' is stored once");
    return;
  }
  const Numbers& numbers = stored(name);
  if (numbers.shape != shape || numbers.values.size() != count) misfit(name);
  std::copy_n(numbers.values.begin(), count, values);
}

void Archive::io(std::string_view name, std::vector<double>& values) {
  if (restores_) values.resize(stored(name).values.size());
  io_numbers(name, {values.size()}, values.data(), values.size());
}

void Archive::io(std::string_view name, std::string& text) {
  if (!restores_) {
    const bool is_new = content_.texts.emplace(path(name), text).second;
    HERSEY_REQUIRE(is_new, "'" + path(name) + "' is stored once");
    return;
  }
  const auto found = content_.texts.find(path(name));
  if (found == content_.texts.end()) throw ArchiveError("there is no '" + path(name) + "'");
  read_.insert(found->first);
  text = found->second;
}

std::vector<std::string> Archive::unread() const {
  std::vector<std::string> names;
  for (const auto& [name, numbers] : content_.numbers)
    if (!read_.contains(name)) names.push_back(name);
  for (const auto& [name, text] : content_.texts)
    if (!read_.contains(name)) names.push_back(name);
  return names;
}

}  // namespace hersey
