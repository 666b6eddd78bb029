#include "elimination.h"

#include <algorithm>

#include "hersey/core/contract.h"
#include "product_tiles.h"

namespace hersey::solver {
namespace {

/// A stretch of memory that no complement uses.
struct Gap {
  std::size_t first = 0, length = 0;
};

/// Lays stretches of memory, each as far in front as one fits.
class Stretches {
 public:
  std::size_t take(std::size_t length) {
    for (Gap& gap : gaps_) {
      if (gap.length < length) continue;
      const std::size_t first = gap.first;
      gap.first += length, gap.length -= length;
      return first;
    }
    const bool ends_free = !gaps_.empty() && gaps_.back().first + gaps_.back().length == room_;
    const std::size_t first = ends_free ? gaps_.back().first : room_;
    if (ends_free) gaps_.pop_back();
    room_ = first + length;
    return first;
  }

  void give_back(Gap freed) {
    const auto after = std::find_if(gaps_.begin(), gaps_.end(), [&](const Gap& g) { return g.first > freed.first; });
    auto at = gaps_.insert(after, freed);
    if (const auto next = at + 1; next != gaps_.end() && at->first + at->length == next->first) {
      at->length += next->length;
      gaps_.erase(next);
    }
    if (at == gaps_.begin()) return;
    if (const auto before = at - 1; before->first + before->length == at->first) {
      before->length += at->length;
      gaps_.erase(at);
    }
  }

  [[nodiscard]] std::size_t room() const { return room_; }

 private:
  std::vector<Gap> gaps_;  // ascending
  std::size_t room_ = 0;
};

// Column of a position in the upper block of a front.
int column_of(const Elimination::Front& front, int position) {
  const auto at = std::lower_bound(front.positions.begin(), front.positions.end(), position);
  const int place = static_cast<int>(at - front.positions.begin());
  return place < front.own ? place : padded(front.own) + place - front.own;
}

}  // namespace

Elimination::Elimination(int n, std::span<const int> column_start, std::span<const int> row_index,
                         std::span<const std::vector<int>> groups) {
  HERSEY_REQUIRE(n >= 0 && column_start.size() == static_cast<std::size_t>(n) + 1, "one start per column and an end");
  HERSEY_REQUIRE(row_index.size() == static_cast<std::size_t>(column_start[n]), "one row per entry");
  entries = static_cast<int>(row_index.size());
  find_known(n, column_start, row_index);
  place_groups(n, groups);
  find_fronts(column_start, row_index);
  place_entries(column_start, row_index);
  place_complements();
}

void Elimination::find_known(int n, std::span<const int> column_start, std::span<const int> row_index) {
  std::vector<int> in_row(static_cast<std::size_t>(n), 0);
  for (const int row : row_index) ++in_row[row];
  position_of_.assign(static_cast<std::size_t>(n), 0);
  for (int column = 0; column < n; ++column) {
    for (int k = column_start[column]; k < column_start[column + 1]; ++k) {
      if (row_index[k] != column || in_row[column] != 1) continue;
      known.push_back({column, static_cast<std::size_t>(k)});
      position_of_[column] = -1;
    }
  }
  for (const Known& each : known) {
    for (int k = column_start[each.unknown]; k < column_start[each.unknown + 1]; ++k)
      if (row_index[k] != each.unknown) from_known.push_back({row_index[k], each.unknown, static_cast<std::size_t>(k)});
  }
}

void Elimination::place_groups(int n, std::span<const std::vector<int>> groups) {
  for (const std::vector<int>& group : groups) {
    Front front;
    for (const int unknown : group) {
      if (position_of_[unknown] < 0) continue;
      position_of_[unknown] = eliminated();
      front.positions.push_back(eliminated());
      group_of_.push_back(static_cast<int>(fronts.size()));
      unknown_at.push_back(unknown);
    }
    front.own = front.size();
    if (front.own > 0) fronts.push_back(std::move(front));
  }
  HERSEY_REQUIRE(static_cast<std::size_t>(eliminated()) + known.size() == static_cast<std::size_t>(n),
                 "each unknown in one group");
}

// The border of a front: later unknowns that entries of the group's rows or columns couple, and the borders of its
// children. Its complement goes to the front that eliminates the first of them.
void Elimination::find_fronts(std::span<const int> column_start, std::span<const int> row_index) {
  for (std::size_t column = 0; column + 1 < column_start.size(); ++column) {
    for (int k = column_start[column]; k < column_start[column + 1]; ++k) {
      const int a = position_of_[column], b = position_of_[row_index[k]];
      if (a < 0 || b < 0) continue;
      const auto [first, second] = std::minmax(a, b);
      if (group_of_[first] != group_of_[second]) fronts[group_of_[first]].positions.push_back(second);
    }
  }
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    std::vector<int>& positions = fronts[f].positions;
    std::sort(positions.begin() + fronts[f].own, positions.end());
    positions.erase(std::unique(positions.begin() + fronts[f].own, positions.end()), positions.end());
    if (fronts[f].size() > fronts[f].own) adopt(static_cast<int>(f));
  }
  for (const Front& front : fronts) {
    for (const int child : front.children) {
      Front& of = fronts[child];
      for (auto at = of.positions.begin() + of.own; at != of.positions.end(); ++at) {
        const int column = column_of(front, *at);
        of.place_in_parent.push_back(column);
        if (column < front.own) ++of.in_parents_group;
      }
    }
  }
}

void Elimination::adopt(int child) {
  const Front& front = fronts[child];
  const int to = group_of_[front.positions[front.own]];
  Front& parent = fronts[to];
  parent.children.push_back(child);
  for (auto at = front.positions.begin() + front.own; at != front.positions.end(); ++at)
    if (group_of_[*at] != to) parent.positions.push_back(*at);
}

void Elimination::place_entries(std::span<const int> column_start, std::span<const int> row_index) {
  for (std::size_t column = 0; column + 1 < column_start.size(); ++column) {
    for (int k = column_start[column]; k < column_start[column + 1]; ++k) {
      const int across = position_of_[column], down = position_of_[row_index[k]];
      if (across < 0 || down < 0) continue;
      Front& front = fronts[group_of_[std::min(across, down)]];
      const std::ptrdiff_t at = column_of(front, across), own_columns = padded(front.own);
      if (const std::ptrdiff_t row = column_of(front, down); row < front.own)
        front.upper.push_back({k, row * (own_columns + padded(front.outside())) + at});
      else
        front.lower.push_back({k, (row - own_columns) * own_columns + at});
    }
  }
}

void Elimination::place_complements() {
  Stretches stretches;
  for (Front& front : fronts) {
    const auto outside = static_cast<std::size_t>(front.outside());
    front.complement_length = outside * static_cast<std::size_t>(padded(front.outside()));
    if (outside > 0) front.complement = stretches.take(front.complement_length);
    // The complement is summed there while those of the children are still in use.
    for (const int child : front.children)
      stretches.give_back({fronts[child].complement, fronts[child].complement_length});
  }
  complement_room = stretches.room();
}

}  // namespace hersey::solver
