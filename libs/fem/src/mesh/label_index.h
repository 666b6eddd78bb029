#pragma once

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace hersey::fem {

/// Map from the labels of a file to indices in an array: a table where labels are dense, as they usually are, else a
/// map.
class LabelIndex {
 public:
  explicit LabelIndex(const std::vector<long>& labels) {
    long last = 0;
    bool is_positive = true;
    for (const long label : labels) {
      last = std::max(last, label);
      is_positive = is_positive && label >= 0;
    }
    is_dense_ = is_positive && static_cast<std::size_t>(last) < 8 * labels.size() + 1024;
    if (is_dense_)
      table_.assign(static_cast<std::size_t>(last) + 1, -1);
    else
      map_.reserve(labels.size());
    for (std::size_t k = 0; k < labels.size(); ++k) add(labels[k], static_cast<int>(k));
  }

  /// Returns the first index with this label; -1: none.
  [[nodiscard]] int find(long label) const {
    if (is_dense_) {
      const bool is_inside = label >= 0 && static_cast<std::size_t>(label) < table_.size();
      return is_inside ? table_[static_cast<std::size_t>(label)] : -1;
    }
    const auto entry = map_.find(label);
    return entry == map_.end() ? -1 : entry->second;
  }

 private:
  void add(long label, int index) {
    if (!is_dense_)
      map_.try_emplace(label, index);
    else if (table_[static_cast<std::size_t>(label)] < 0)
      table_[static_cast<std::size_t>(label)] = index;
  }

  bool is_dense_ = true;
  std::vector<int> table_;
  std::unordered_map<long, int> map_;
};

}  // namespace hersey::fem
