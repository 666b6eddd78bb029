#include "mesh/tie_rows.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace hersey::fem {
namespace {

constexpr double kVanishes = 1e-9;   // of the largest coefficient a row began with
constexpr double kGoodPivot = 1e-2;  // of the largest of a row: among those the rarest unknown is taken

class Elimination {
 public:
  Elimination(std::vector<TieRow> rows, const std::function<bool(int)>& may_pivot)
      : rows_(std::move(rows)), may_pivot_(may_pivot) {}

  EliminatedRows by_rows() {
    begin();
    for (int r = 0; r < static_cast<int>(rows_.size()); ++r)
      if (const int pivot = pivot_of(r); pivot >= 0) eliminate(r, pivot);
    return result();
  }

  EliminatedRows by_unknowns() {
    begin();
    std::vector<int> unknowns;
    for (const auto& [unknown, rows] : users_)
      if (may_pivot_(unknown)) unknowns.push_back(unknown);
    for (const int unknown : unknowns)
      if (const int r = best_row_of(unknown); r >= 0) eliminate(r, unknown);
    return result();
  }

 private:
  void begin() {
    for (int r = 0; r < static_cast<int>(rows_.size()); ++r) {
      normalise(row(r));
      for (const auto& [unknown, coefficient] : row(r)) users_[unknown].insert(r);
    }
    pivots_.assign(rows_.size(), -1);
  }

  int best_row_of(int unknown) {
    int best = -1;
    double largest = 0;
    for (const int r : users_[unknown]) {
      const double here = std::abs(row(r).at(unknown));
      if (pivots_[static_cast<std::size_t>(r)] >= 0 || here <= largest) continue;
      best = r;
      largest = here;
    }
    return best;
  }

  TieRow& row(int r) { return rows_[static_cast<std::size_t>(r)]; }

  static void normalise(TieRow& row) {
    double largest = 0;
    for (const auto& [unknown, coefficient] : row) largest = std::max(largest, std::abs(coefficient));
    if (!(largest > 0) || !std::isfinite(largest)) return row.clear();
    for (auto& [unknown, coefficient] : row) coefficient /= largest;
  }

  // A good coefficient, and of those the unknown that the fewest rows have: that fills the others least.
  int pivot_of(int r) {
    double largest = 0;
    for (const auto& [unknown, coefficient] : row(r))
      if (may_pivot_(unknown)) largest = std::max(largest, std::abs(coefficient));
    int best = -1;
    std::size_t fewest = 0;
    double most = 0;
    for (const auto& [unknown, coefficient] : row(r)) {
      if (!may_pivot_(unknown) || std::abs(coefficient) < kGoodPivot * largest) continue;
      const std::size_t users = users_[unknown].size();
      const double here = std::abs(coefficient);
      if (best >= 0 && users >= fewest && (users > fewest || here <= most)) continue;
      best = unknown;
      fewest = users;
      most = here;
    }
    return best;
  }

  void eliminate(int r, int pivot) {
    pivots_[static_cast<std::size_t>(r)] = pivot;
    const TieRow& from = row(r);
    const std::set<int> others = users_[pivot];
    for (const int other : others) {
      if (other == r) continue;
      TieRow& target = row(other);
      const double share = target.at(pivot) / from.at(pivot);
      for (const auto& [unknown, coefficient] : from) add(other, target, unknown, -share * coefficient);
      remove(other, target, pivot);
    }
  }

  void add(int r, TieRow& target, int unknown, double value) {
    const auto [at, is_new] = target.try_emplace(unknown, 0.0);
    at->second += value;
    if (is_new) users_[unknown].insert(r);
    if (std::abs(at->second) < kVanishes) remove(r, target, unknown);
  }

  void remove(int r, TieRow& target, int unknown) {
    target.erase(unknown);
    users_[unknown].erase(r);
  }

  EliminatedRows result() {
    EliminatedRows all;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (rows_[r].empty()) continue;
      if (pivots_[r] < 0) {
        all.rest.push_back(std::move(rows_[r]));
        continue;
      }
      all.rows.push_back(std::move(rows_[r]));
      all.pivots.push_back(pivots_[r]);
    }
    return all;
  }

  std::vector<TieRow> rows_;
  const std::function<bool(int)>& may_pivot_;
  std::vector<int> pivots_;
  std::map<int, std::set<int>> users_;  ///< rows that have an unknown
};

}  // namespace

EliminatedRows eliminated(std::vector<TieRow> rows, const std::function<bool(int)>& may_pivot) {
  return Elimination(std::move(rows), may_pivot).by_rows();
}

std::vector<TieRow> without_auxiliary(std::vector<TieRow> rows, const std::function<bool(int)>& is_auxiliary) {
  return Elimination(std::move(rows), is_auxiliary).by_unknowns().rest;
}

}  // namespace hersey::fem
