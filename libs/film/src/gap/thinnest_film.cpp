#include "gap/thinnest_film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "gap/feature_cover.h"
#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace {

// Number of points along each side of a feature's border.
constexpr int border_points = 64;

/// Smallest value of the parabola through (0, y0), (a, ya) and (b, yb) within [from, to], and its position.
struct Low {
  double offset = 0, value = 0;
};

Low lowest(double y0, double a, double ya, double b, double yb, double from, double to) {
  const double curvature = ((yb - y0) / b - (ya - y0) / a) / (b - a), slope = (ya - y0) / a - curvature * a;
  const auto at = [&](double x) { return y0 + x * (slope + x * curvature); };
  double x = at(from) < at(to) ? from : to;
  if (curvature > 0) x = std::clamp(-0.5 * slope / curvature, from, to);
  return {x, at(x)};
}

class Search {
 public:
  Search(const FilmModel& model, const GridGeometry& at, const Eigen::VectorXd& h, double phi_journal, int patch)
      : model_(model), grid_(model.grid), at_(at), h_(h), patch_(patch) {
    for (SurfaceFeature feature : model.features) {
      if (feature.depth == 0) continue;
      if (feature.surface == Surface::journal) feature.phi += phi_journal;
      deep_.push_back(without_border(feature, model, at));
      // A feature that reaches the bearing's edge is extended beyond it.
      if (deep_.back().length == feature.length) deep_.back().length *= 1 + 1e-6;
    }
    outside_.assign(static_cast<std::size_t>(grid_.size()), 1);
    for (int k = 0; k < grid_.size() && !deep_.empty(); ++k) {
      outside_[static_cast<std::size_t>(k)] = is_outside(at_.phi[k / grid_.n_z], at_.z[k % grid_.n_z]) ? 1 : 0;
    }
  }

  [[nodiscard]] Thinnest find() {
    Thinnest best{.value = std::numeric_limits<double>::infinity(),
                  .in_features = std::numeric_limits<double>::quiet_NaN()};
    for (int j = 0; j < grid_.n_z; ++j) search_row(j, best);
    for (const SurfaceFeature& feature : deep_) search_border(feature, best);
    best.in_the_middle = in_the_middle();
    const int node = node_in_features();
    if (node >= 0) best.in_features = with_depth(node);
    if (node >= 0 && !std::isfinite(best.value)) {
      // A groove that covers all of the bearing leaves no land.
      best.value = best.in_features, best.phi = at_.phi[node / grid_.n_z], best.z = at_.z[node % grid_.n_z];
    }
    return best;
  }

 private:
  [[nodiscard]] bool is_outside(double phi, double z) const {
    return std::none_of(deep_.begin(), deep_.end(), [&](const SurfaceFeature& f) { return contains(f, phi, z); });
  }

  [[nodiscard]] int wrapped(int i) const { return (i % grid_.n_phi + grid_.n_phi) % grid_.n_phi; }
  [[nodiscard]] bool is_looked_at(int line) const { return patch_ < 0 || grid_.patch_of(line) == patch_; }
  /// True if the line k further on belongs to the same patch.
  [[nodiscard]] bool is_patch_of(int i, int k) const {
    return grid_.closes() || (i + k >= 0 && i + k < grid_.n_phi && grid_.patch_of(i) == grid_.patch_of(i + k));
  }
  [[nodiscard]] double value(int i, int j) const { return h_[grid_.index(wrapped(i), j)]; }
  [[nodiscard]] bool outside(int i, int j) const {
    return outside_[static_cast<std::size_t>(grid_.index(wrapped(i), j))] != 0;
  }

  // Every dip of the row between nodes is searched: of two dips that are equally deep, round-off or the positions of
  // the nodes decide which has the lower node.
  void search_row(int j, Thinnest& best) const {
    for (int i = 0; i < grid_.n_phi; ++i) {
      if (is_looked_at(i) && outside(i, j)) search_dip(i, j, best);
    }
  }

  void search_dip(int i, int j, Thinnest& best) const {
    const auto around_node = [&](int k) { return value(i + k, j); };
    const auto counts_around = [&](int k) { return is_patch_of(i, k) && outside(i + k, j); };
    if (!is_lowest(around_node, counts_around)) return;
    const Low around = between_nodes(
        around_node, [&](int k) { return at_.step(wrapped(i + (k < 0 ? k : k - 1)), j); }, counts_around);
    const auto in_row = [&](int k) { return j + k >= 0 && j + k < grid_.n_z && outside(i, j + k); };
    const Low along = between_nodes([&](int k) { return value(i, j + k); },
                                    [&](int k) { return at_.dz[k < 0 ? j + k : j + k - 1]; }, in_row);
    const double here = value(i, j), both = around.value + along.value - here;
    const double found = both > 0 ? both : here;
    if (found >= best.value) return;
    best.value = found, best.z = at_.z[j] + along.offset;
    best.phi = at_.reported_angle(at_.phi[i] + around.offset / (at_.R * at_.stretch[j]));
  }

  /// True if a node lies no higher than those beside it that count.
  template <class Value, class Counts>
  [[nodiscard]] static bool is_lowest(Value&& at, Counts&& counts) {
    const auto is_lower = [&](int k) { return counts(k) && at(k) < at(0); };
    return !is_lower(-1) && !is_lower(1);
  }

  // Two parabolas cover the interval between two nodes, one from either side. Where the film is smooth they agree; at a
  // kink the one that dips less is used. The functions return values, lengths of intervals (k < 0: from node k to k +
  // 1, else from k - 1 to k) and whether a node counts, all by the offset k from the node.
  template <class Value, class Length, class Counts>
  [[nodiscard]] static Low between_nodes(Value&& at, Length&& length, Counts&& counts) {
    const double here = at(0);
    const Low node{0, here};
    if (!counts(-1) || !counts(1)) return node;
    const double back = length(-1), ahead = length(1);
    const Low first = lowest(here, -back, at(-1), ahead, at(1), -0.5 * back, 0.5 * ahead);
    if (first.offset == 0) return node;
    const int way = first.offset > 0 ? 1 : -1;
    if (!counts(2 * way)) return first.value > 0 && first.value < here ? first : node;
    const double a = way * length(way), b = a + way * length(2 * way);
    const Low second = lowest(here, a, at(way), b, at(2 * way), std::min(0.0, 0.5 * a), std::max(0.0, 0.5 * a));
    const Low& believed = first.value > second.value ? first : second;
    return believed.value > 0 && believed.value < here ? believed : node;
  }

  /// Smallest thickness along z = 0, where the rows on both sides are joined by straight lines.
  [[nodiscard]] double in_the_middle() const {
    int low = 0;
    while (low + 2 < grid_.n_z && at_.z[low + 1] <= 0) ++low;
    // A row within round-off of z = 0 is the middle itself: the one beside it may lie in a groove.
    const double position = -at_.z[low] / at_.dz[low],
                 t = std::abs(position - std::round(position)) < 1e-9 ? std::round(position) : position;
    const auto middle = [&](int i) { return (1 - t) * value(i, low) + t * value(i, low + 1); };
    const auto counts = [&](int i) { return (t == 1 || outside(i, low)) && (t == 0 || outside(i, low + 1)); };
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < grid_.n_phi; ++i) {
      if (!counts(i)) continue;
      const auto around = [&](int k) { return middle(i + k); };
      const auto counts_around = [&](int k) { return is_patch_of(i, k) && counts(i + k); };
      if (!is_lowest(around, counts_around)) continue;
      const auto step = [&](int k) { return at_.dx[wrapped(i + (k < 0 ? k : k - 1))]; };
      least = std::min(least, between_nodes(around, step, counts_around).value);
    }
    return std::isfinite(least) ? least : in_features();  // a groove covers all of it
  }

  void search_border(const SurfaceFeature& f, Thinnest& best) const {
    for (int k = 0; k < border_points; ++k) {
      const double s = (k + 0.5) / border_points * 2 - 1;
      std::visit([&](const auto& shape) { try_border(shape, f, s, best); }, f.shape);
    }
  }

  /// Tries the points on a border at s from -1 to 1.
  void try_border(const Rectangle& /*shape*/, const SurfaceFeature& f, double s, Thinnest& best) const {
    const double half_arc = 0.5 * f.arc, half_length = 0.5 * f.length;
    for (const double side : {-1.0, 1.0}) {
      try_point(f.phi + s * half_arc, f.z + side * half_length, best);
      if (f.arc < two_pi) try_point(f.phi + side * half_arc, f.z + s * half_length, best);
    }
  }

  void try_border(const Ellipse& /*shape*/, const SurfaceFeature& f, double s, Thinnest& best) const {
    const double angle = std::numbers::pi * s;
    try_point(f.phi + 0.5 * f.arc * std::cos(angle), f.z + 0.5 * f.length * std::sin(angle), best);
  }

  void try_point(double phi, double z, Thinnest& best) const {
    const double sliver = 1e-9;  // a border lies outside its own feature
    if (std::abs(z) > 0.5 * model_.L * (1 + sliver) || !is_on_land(phi, z)) return;
    if (!is_looked_at(at_.locate(phi).node)) return;
    const double value = between(phi, std::clamp(z, at_.z[0], at_.z[grid_.n_z - 1]));
    if (value >= best.value) return;
    best.value = value, best.phi = at_.reported_angle(phi), best.z = z;
  }

  [[nodiscard]] bool is_on_land(double phi, double z) const {
    return std::none_of(deep_.begin(), deep_.end(), [&](const SurfaceFeature& f) {
      SurfaceFeature inner = f;
      inner.arc *= 1 - 1e-6, inner.length *= 1 - 1e-6;
      return contains(inner, phi, z);
    });
  }

  /// Bilinear interpolation is used: the thickness itself has no step there.
  [[nodiscard]] double between(double phi, double z) const {
    const auto [i, t] = at_.locate(phi);
    int j = 0;
    while (j + 2 < grid_.n_z && at_.z[j + 1] <= z) ++j;
    const double s = (z - at_.z[j]) / at_.dz[j];
    return (1 - t) * ((1 - s) * value(i, j) + s * value(i, j + 1)) +
           t * ((1 - s) * value(i + 1, j) + s * value(i + 1, j + 1));
  }

  /// Thickness at a node, depth of features included.
  [[nodiscard]] double with_depth(int k) const {
    double depth = 0;
    for (const SurfaceFeature& f : deep_) {
      if (contains(f, at_.phi[k / grid_.n_z], at_.z[k % grid_.n_z])) depth += f.depth;
    }
    return h_[k] + depth;
  }

  /// Node over features where the film is thinnest; -1 where they cover none.
  [[nodiscard]] int node_in_features() const {
    int node = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < grid_.size() && !deep_.empty(); ++k) {
      if (outside_[static_cast<std::size_t>(k)] != 0 || !is_looked_at(k / grid_.n_z)) continue;
      const double h = with_depth(k);
      if (h < least) least = h, node = k;
    }
    return node;
  }

  [[nodiscard]] double in_features() const {
    const int node = node_in_features();
    return node < 0 ? std::numeric_limits<double>::quiet_NaN() : with_depth(node);
  }

  const FilmModel& model_;
  const Grid& grid_;
  const GridGeometry& at_;
  const Eigen::VectorXd& h_;
  int patch_;
  std::vector<SurfaceFeature> deep_;
  std::vector<char> outside_;
};

}  // namespace

Thinnest thinnest_film(const FilmModel& model, const GridGeometry& at, const Eigen::VectorXd& h, double phi_journal,
                       int patch) {
  return Search(model, at, h, phi_journal, patch).find();
}

}  // namespace hersey::film
