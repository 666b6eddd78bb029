#include "balance/active_set_changes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

// Nodes that cavitate and fill in groups, of which only a part may do so at once.
namespace hersey::film {
namespace active_set_changes_test {

/// A film of which every second node would cavitate and every other one fill.
struct Groups {
  explicit Groups(Cavitation cavitation) : model{.cavitation = cavitation} {
    before.resize(model.grid.size());
    for (Eigen::Index node = 0; node < before.size(); ++node) before[node] = node % 2 == 0 ? 1e6 : -1e6;
    after = -before;
    after.tail(before.size() / 4) = before.tail(before.size() / 4);  // these stay
  }

  /// Nodes that have changed sides, and all unknowns after the iteration.
  struct Iterate {
    std::vector<bool> changed;
    Eigen::VectorXd u;
  };
  [[nodiscard]] Iterate at(int iteration) const {
    Iterate observed{.u = after};
    limit_active_set_changes(model, before, iteration, observed.u);
    for (Eigen::Index node = 0; node < observed.u.size(); ++node)
      observed.changed.push_back((observed.u[node] < 0) != (before[node] < 0));
    return observed;
  }

  FilmModel model;
  Eigen::VectorXd before, after;
};

TEST_CASE("AntiCycling_ChangesAboutHalfOfTheNodesInEachIteration") {
  const Groups groups(Cavitation::mass_conserving);
  const auto would = 3 * groups.before.size() / 4;
  std::vector<bool> ever(static_cast<std::size_t>(groups.before.size()), false), always(ever.size(), true);
  constexpr int iterations = 24;
  for (int iteration = 7; iteration < 7 + iterations; ++iteration) {
    const Groups::Iterate observed = groups.at(iteration);
    const auto changed = std::count(observed.changed.begin(), observed.changed.end(), true);
    CHECK(std::abs(static_cast<double>(changed) / static_cast<double>(would) - 0.5) < 0.1);  // four standard deviations
    for (std::size_t node = 0; node < ever.size(); ++node) {
      ever[node] = ever[node] || observed.changed[node];
      always[node] = always[node] && observed.changed[node];
    }
    CHECK(observed.u == groups.at(iteration).u);  // the same for each evaluation
  }
  CHECK(std::count(ever.begin(), ever.end(), true) == would);
  CHECK(std::count(always.begin(), always.end(), true) == 0);
}

TEST_CASE("AntiCycling_LeavesNodesAtTheBorder") {
  const Groups groups(Cavitation::mass_conserving);
  const Groups::Iterate observed = groups.at(7);
  for (Eigen::Index node = 0; node < observed.u.size(); ++node) {
    const bool would = (groups.after[node] < 0) != (groups.before[node] < 0);
    if (would && !observed.changed[static_cast<std::size_t>(node)])
      CHECK(std::abs(observed.u[node]) <= 1e-9 * fill_scale(groups.model));  // what keeps it on its side
    else
      CHECK(observed.u[node] == groups.after[node]);
  }
}

TEST_CASE("FilmsThatRetainNoOil_ChangeAtOnce") {
  const Groups groups(Cavitation::guembel);
  CHECK(groups.at(7).u == groups.after);
}

}  // namespace active_set_changes_test
}  // namespace hersey::film
