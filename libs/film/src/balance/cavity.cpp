#include "balance/cavity.h"

#include <algorithm>
#include <cmath>

namespace hersey::film {
namespace {

/// The unknowns of the row nearest to mid-width.
class MiddleRow {
 public:
  MiddleRow(const FlowBalance& balance, const Eigen::VectorXd& u)
      : balance_(balance), u_(u), at_(balance.geometry()), n_(balance.model().grid.n_phi) {
    const Eigen::Index rows = balance.model().grid.n_z;
    for (Eigen::Index j = 1; j < rows; ++j) {
      if (std::abs(at_.z[j]) < std::abs(at_.z[row_]) - 1e-9 * balance.model().L) row_ = static_cast<int>(j);
    }
  }

  [[nodiscard]] int size() const { return n_; }
  [[nodiscard]] bool is_cavity(int i) const {
    if (cavitation_law(balance_.model()).bears_tension()) return false;
    return value(i) < -1e-9 * fill_scale(balance_.model()) && !balance_.is_flooded(node(i));
  }
  /// True if an edge lies between node i and the next one.
  [[nodiscard]] bool ends(int i) const { return balance_.model().grid.next(wrapped(i)) < 0; }
  /// Angle from node i to the next one [rad].
  [[nodiscard]] double step(int i) const { return at_.dphi(wrapped(i)); }
  [[nodiscard]] double angle(int i) const { return at_.phi[wrapped(i)]; }

  /// Distance from the last node i of the film to its end, which lies before the next node in the direction of `sense`
  /// or in its volume [rad]. Where a film without tension ruptures or loses oil, a fraction of the next volume is full
  /// (film.61, film.62); elsewhere the pressure falls linearly. A node of prescribed pressure is the film's end itself.
  [[nodiscard]] double reach(int i, int sense, bool is_rupture) const {
    if (balance_.balance_weight(node(i)) < 1 || ends(sense > 0 ? i - 1 : i)) return 0;
    const int cavitated = i + sense;
    const double gap = step(sense > 0 ? i : i - 1), back = step(sense > 0 ? i - 1 : i);
    const double last = std::max(value(i), 0.0), before = std::max(value(i - sense), 0.0);
    const CavitationLaw& law = cavitation_law(balance_.model());
    if (law.has_tension()) return gap * last / (last - value(cavitated));
    if (is_rupture || law.loses_oil()) {
      const double volume = 0.5 * (step(cavitated - 1) + step(cavitated));
      return 0.5 * gap + (1 - balance_.cavitated_fraction(node(cavitated))) * volume;
    }
    const double rise = before / std::max(last, 1e-300) - 1;
    return rise > 0 ? std::min(back / rise, gap) : gap;
  }

 private:
  [[nodiscard]] int wrapped(int i) const { return ((i % n_) + n_) % n_; }
  [[nodiscard]] int node(int i) const { return balance_.model().grid.index(wrapped(i), row_); }
  [[nodiscard]] double value(int i) const { return u_[node(i)]; }

  const FlowBalance& balance_;
  const Eigen::VectorXd& u_;
  const GridGeometry& at_;
  int n_, row_ = 0;
};

}  // namespace

Cavity widest_cavity(const FlowBalance& balance, const Eigen::VectorXd& u, bool backwards) {
  const MiddleRow row(balance, u);
  double widest = 0;
  Cavity cavity;
  for (int first = 0; first < row.size(); ++first) {
    // A cavity begins here, or all of the row is cavitated.
    if (!row.is_cavity(first) || (!row.ends(first - 1) && row.is_cavity(first - 1))) continue;
    int last = first;
    double width = row.step(first - 1);
    for (; !row.ends(last) && row.is_cavity(last + 1); ++last) width += row.step(last);
    width += row.step(last);
    if (width <= widest) continue;
    widest = width;
    // A cavity that reaches the end of a patch ends there.
    const double low =
        row.ends(first - 1) ? row.angle(first) : row.angle(first - 1) + row.reach(first - 1, +1, !backwards);
    const double high = row.ends(last) ? row.angle(last) : row.angle(last + 1) - row.reach(last + 1, -1, backwards);
    cavity.rupture = balance.geometry().reported_angle(backwards ? high : low);
    cavity.reformation = balance.geometry().reported_angle(backwards ? low : high);
  }
  return cavity;
}

}  // namespace hersey::film
