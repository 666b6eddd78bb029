#pragma once

#include <functional>
#include <map>
#include <vector>

namespace hersey::fem {

/// A linear equation sum coefficient x = 0, by the numbers of its unknowns.
using TieRow = std::map<int, double>;

struct EliminatedRows {
  std::vector<TieRow> rows;  ///< independent equations in which pivots stand once
  std::vector<int> pivots;   ///< for each row: an unknown that no other row has
  std::vector<TieRow> rest;  ///< equations that are left without an unknown that may be a pivot, and are not empty
};

/// Eliminates one unknown with each equation, so that every row can be solved for its own. Equations that follow from
/// others vanish. Cost: the number of coefficients times the rows that share an unknown.
/// @param may_pivot  unknowns that can be solved for
[[nodiscard]] EliminatedRows eliminated(std::vector<TieRow> rows, const std::function<bool(int)>& may_pivot);

/// The equations between the other unknowns that are left when the auxiliary ones may be any: each auxiliary unknown is
/// eliminated with the equation that has most of it.
[[nodiscard]] std::vector<TieRow> without_auxiliary(std::vector<TieRow> rows,
                                                    const std::function<bool(int)>& is_auxiliary);

}  // namespace hersey::fem
