#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace hersey::mbd::test {

/// Error of each figure: the root mean square of the errors that were counted, each with its weight.
class Errors {
 public:
  void add(const std::string& figure, double error, double weight = 1) {
    Sum& sum = sums_[figure];
    sum.squares += weight * error * error;
    sum.weight += weight;
  }
  [[nodiscard]] std::map<std::string, double> figures() const {
    std::map<std::string, double> all;
    for (const auto& [figure, sum] : sums_) all[figure] = std::sqrt(sum.squares / sum.weight);
    return all;
  }

 private:
  struct Sum {
    double squares = 0, weight = 0;
  };
  std::map<std::string, Sum> sums_;
};

/// Every figure has the order `expected`, from both sides: on three grids, each `ratio` times as fine as the one
/// before, between the last two. What the next order leaves is halved with the grid; `margin` is what may be left here.
/// A figure that is met on every grid has none. Where `main` names one, the others may be better.
inline void check_orders(const std::vector<Errors>& on, double expected, double margin, double ratio = 2,
                         const std::string& main = "") {
  REQUIRE(on.size() == 3);
  constexpr double exact = 1e-12;  // round-off of numbers of size one
  const auto coarse = on[0].figures(), middle = on[1].figures(), last = on[2].figures();
  for (const auto& [figure, fine] : last) {
    const double order = std::log(middle.at(figure) / fine) / std::log(ratio);
    const std::string what = figure;  // clang 14 captures no structured binding
    MESSAGE(what, ": ", coarse.at(what), ", ", middle.at(what), ", ", fine, ", order ", order);
    const bool is_met = std::max({coarse.at(what), middle.at(what), fine}) < exact;
    const bool may_be_better = !main.empty() && what != main;
    CHECK_MESSAGE((is_met || std::abs(order - expected) < margin || (may_be_better && order > expected)), what);
  }
}

}  // namespace hersey::mbd::test
