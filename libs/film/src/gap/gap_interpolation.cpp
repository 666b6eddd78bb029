#include "gap/gap_interpolation.h"

#include <algorithm>
#include <cmath>

namespace hersey::film {
namespace {

/// Functions for which the interpolation is exact, at an angle and as means between two angles: 1, 1 - cos, sin and sin
/// of twice the angle, or powers of the angle. As many of them are used as there are weights.
struct Exact {
  bool is_round = true;

  [[nodiscard]] Eigen::VectorXd at(double angle, int count) const {
    if (is_round) return Eigen::Vector4d(1, 1 - std::cos(angle), std::sin(angle), std::sin(2 * angle)).head(count);
    return Eigen::Vector4d(1, angle, angle * angle, angle * angle * angle).head(count);
  }

  [[nodiscard]] Eigen::Vector3d mean(double from, double to) const {
    const double width = to - from;
    if (is_round) return {1, 1 - (std::sin(to) - std::sin(from)) / width, (std::cos(from) - std::cos(to)) / width};
    return {1, 0.5 * (from + to), (from * from + from * to + to * to) / 3};
  }

  /// Returns the weights of values at these angles that reproduce `wanted` for all functions.
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> weights(const std::array<double, N>& angle, const Eigen::VectorXd& wanted) const {
    constexpr int n = static_cast<int>(N);
    Eigen::Matrix<double, n, n> basis;  // a column per node
    // Powers of angles are taken in a unit of their own; small angles would make the matrix badly scaled.
    const double unit = is_round ? 1 : *std::max_element(angle.begin(), angle.end()) - angle[0];
    Eigen::Matrix<double, n, 1> right = wanted.head(n);
    for (int k = 0; k < n; ++k) basis.col(k) = at(angle[static_cast<std::size_t>(k)] / unit, n);
    for (int k = 0; k < n && !is_round; ++k) right[k] /= std::pow(unit, k);
    const Eigen::Matrix<double, n, 1> w = basis.fullPivLu().solve(right);
    std::array<double, N> weights;
    std::copy(w.begin(), w.end(), weights.begin());
    return weights;
  }
};

/// Returns the first of `count` consecutive lines about line i, `before` of them before it where its patch has so many.
int first_of(const Grid& grid, int i, int before, int count) {
  if (grid.closes()) return i - before;
  const auto patch = static_cast<std::size_t>(grid.patch_of(i));
  return std::clamp(i - before, grid.patches[patch], end_of_patch(grid, patch) - count);
}

}  // namespace

GapInterpolation::GapInterpolation(const Grid& grid, const GridGeometry& geometry) : n_z_(grid.n_z) {
  const int n = grid.n_phi;
  const Exact exact{is_round(geometry.surface)};
  const auto wrapped = [n](int i) { return (i + n) % n; };
  // Returns the angles of consecutive lines, counted from the position `origin` beyond line i.
  const auto angles_of_lines = [&]<std::size_t N>(int i, int first, double origin, std::array<int, N>& lines) {
    std::array<double, N> angle;
    for (std::size_t k = 0; k < N; ++k) {
      const int line = first + static_cast<int>(k);
      double at = -origin;
      for (int l = i; l < line; ++l) at += geometry.dphi(wrapped(l));
      for (int l = line; l < i; ++l) at -= geometry.dphi(wrapped(l));
      lines[k] = wrapped(line), angle[k] = at;
    }
    return angle;
  };
  for (int i = 0; i < n; ++i) {
    const int next = grid.next(i), before = grid.before(i);
    Lines<4> face{.line = {i, i, i, i}};
    if (next >= 0) {
      const auto angle = angles_of_lines(i, first_of(grid, i, 1, 4), 0.5 * geometry.dphi(i), face.line);
      face.weight = exact.weights(angle, exact.at(0, 4));
      for (std::size_t k = 0; k < 4; ++k)
        if (face.line[k] == i || face.line[k] == next) face.weight[k] -= 0.5;
    }
    face_.push_back(face);
    Lines<3> cell;
    const auto angle = angles_of_lines(i, first_of(grid, i, 1, 3), 0, cell.line);
    const double back = before < 0 ? 0 : 0.5 * geometry.dphi(before), ahead = 0.5 * geometry.dphi(i);
    cell.weight = exact.weights(angle, exact.mean(-back, ahead));
    for (std::size_t k = 0; k < 3; ++k)
      if (cell.line[k] == i) cell.weight[k] -= 1;
    cell_.push_back(cell);
  }
}

void GapInterpolation::bends(const Eigen::VectorXd& field, Eigen::VectorXd& bends) const { sum(face_, field, bends); }

double GapInterpolation::bend(const Eigen::VectorXd& field, int i, int j) const {
  const Lines<4>& f = face_[static_cast<std::size_t>(i)];
  const auto at = [&](std::size_t k) { return f.weight[k] * field[static_cast<Eigen::Index>(f.line[k]) * n_z_ + j]; };
  return at(0) + at(1) + at(2) + at(3);
}

void GapInterpolation::excesses(const Eigen::VectorXd& field, Eigen::VectorXd& excesses) const {
  sum(cell_, field, excesses);
}

template <std::size_t N>
void GapInterpolation::sum(const std::vector<Lines<N>>& of, const Eigen::VectorXd& field, Eigen::VectorXd& sums) const {
  sums.resize(field.size());
  const auto line = [&](const Eigen::VectorXd& f, int i) {
    return f.segment(static_cast<Eigen::Index>(i) * n_z_, n_z_);
  };
  for (std::size_t i = 0; i < of.size(); ++i) {
    auto into = sums.segment(static_cast<Eigen::Index>(i) * n_z_, n_z_);
    const auto& [lines, w] = of[i];
    if constexpr (N == 4)
      into = w[0] * line(field, lines[0]) + w[1] * line(field, lines[1]) + w[2] * line(field, lines[2]) +
             w[3] * line(field, lines[3]);
    else
      into = w[0] * line(field, lines[0]) + w[1] * line(field, lines[1]) + w[2] * line(field, lines[2]);
  }
}

}  // namespace hersey::film
