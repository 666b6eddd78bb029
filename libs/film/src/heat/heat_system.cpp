#include "heat/heat_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace hersey::film {

HeatSystem::HeatSystem(const Grid& grid, int layers, bool has_ring) : grid_(grid), layers_(layers) {
  const int n_z = grid.n_z;
  layer_.resize(static_cast<std::size_t>(grid.size() * layers));
  from_slots_.resize(8 * layer_.size());
  is_linked_.resize(static_cast<std::size_t>(8 * grid.size()));
  pivots_.resize(layer_.size());
  if (has_ring) ring_.resize(static_cast<std::size_t>(grid.n_phi));
  from_film_.resize(static_cast<std::size_t>(2 * grid.size()));
  for (int node = 0; node < grid.size(); ++node) {
    const int i = node / n_z, j = node % n_z;
    const auto on = [&](int line) { return line < 0 ? node : grid.index(line, j); };
    neighbours_.push_back(
        {on(grid.before(i)), on(grid.next(i)), j > 0 ? node - 1 : node, j + 1 < n_z ? node + 1 : node});
  }
}

void HeatSystem::set_zero() {
  layer_.assign(layer_.size(), {});
  from_slots_.assign(from_slots_.size(), 0);
  is_linked_.assign(is_linked_.size(), false);
  ring_.assign(ring_.size(), {});
  from_film_.assign(from_film_.size(), 0);
}

// Loops over the layers of a column are unrolled for the most frequent numbers.
template <class Action>
void HeatSystem::for_layers(Action&& action) const {
  if (layers_ == 1) return action(std::integral_constant<int, 1>{});
  if (layers_ == 5) return action(std::integral_constant<int, 5>{});
  action(std::integral_constant<int, 0>{});
}

HeatSystem::Row HeatSystem::entries(int node, int layer) const {
  const int at = row(node, layer);
  const Layer& of = layer_[at];
  Row entries{{at, of.self}};
  if (layer > 0) entries.emplace_back(at - 1, of.below);
  if (layer + 1 < layers_) entries.emplace_back(at + 1, of.above);
  for (int slot = 8 * node; slot < 8 * (node + 1); ++slot)
    if (const double entry = from_slots_[slot * layers_ + layer]; entry != 0)
      entries.emplace_back(row(node_at(slot), layer), entry);
  if (of.ring != 0) entries.emplace_back(ring_row(node / grid_.n_z), of.ring);
  return entries;
}

/// Returns the film's contribution at a node to the row of the ring there.
double HeatSystem::from_film(int node, const Eigen::VectorXd& x) const {
  double sum = 0;
  for (int l = 0; l < lowest(); ++l) sum += from_film_[2 * node + l] * x[row(node, l)];
  return sum;
}

HeatSystem::Row HeatSystem::ring_entries(int i) const {
  const int n = ring_rows();
  if (answer_.is_set()) return answer_entries(i);
  Row entries{{ring_row(i), ring_[i].self},
              {ring_row((i + n - 1) % n), ring_[i].before},
              {ring_row((i + 1) % n), ring_[i].after}};
  for (int j = 0; j < grid_.n_z; ++j)
    for (int l = 0; l < lowest(); ++l)
      entries.emplace_back(row(grid_.index(i, j), l), from_film_[2 * grid_.index(i, j) + l]);
  return entries;
}

/// Computes all entries of the ring and of the film beside it.
HeatSystem::Row HeatSystem::answer_entries(int i) const {
  Row entries;
  for (int j = 0; j < ring_rows(); ++j) {
    const double heat = answer_.by_balance(i, j);
    entries.emplace_back(ring_row(j), heat * ring_[j].self + (i == j ? answer_.scale() : 0));
    for (int k = 0; k < grid_.n_z; ++k)
      for (int l = 0; l < lowest(); ++l)
        entries.emplace_back(row(grid_.index(j, k), l), heat * from_film_[2 * grid_.index(j, k) + l]);
  }
  return entries;
}

void HeatSystem::scale(int row, double factor) {
  for (double* entry : layer_[row].entries()) *entry *= factor;
  const int node = row / layers_, layer = row % layers_;
  for (int slot = 8 * node; slot < 8 * (node + 1); ++slot) from_slots_[slot * layers_ + layer] *= factor;
}

void HeatSystem::add(double weight, const HeatSystem& other) {
  const auto add_entries = [weight](auto& mine, auto theirs) {
    const auto to = mine.entries(), from = theirs.entries();
    for (std::size_t k = 0; k < to.size(); ++k) *to[k] += weight * *from[k];
  };
  for (std::size_t row = 0; row < layer_.size(); ++row) add_entries(layer_[row], other.layer_[row]);
  for (std::size_t k = 0; k < from_slots_.size(); ++k) from_slots_[k] += weight * other.from_slots_[k];
  for (std::size_t k = 0; k < is_linked_.size(); ++k) is_linked_[k] = is_linked_[k] || other.is_linked_[k];
  for (std::size_t i = 0; i < ring_.size(); ++i) add_entries(ring_[i], other.ring_[i]);
  for (std::size_t k = 0; k < from_film_.size(); ++k) from_film_[k] += weight * other.from_film_[k];
}

void HeatSystem::fix_ring() {
  ring_.assign(ring_.size(), {.self = 1});
  from_film_.assign(from_film_.size(), 0);
}

void HeatSystem::persist(Archive& archive) {
  std::vector<double> entries;
  const auto each = [this](auto&& action) {
    for (int row = 0; row < film_rows(); ++row) {
      for (double* entry : layer_[row].entries()) action(*entry);
      const int node = row / layers_, layer = row % layers_;
      for (int slot = 8 * node; slot < 8 * (node + 1); ++slot) action(from_slots_[slot * layers_ + layer]);
    }
    for (Ring& of : ring_)
      for (double* entry : of.entries()) action(*entry);
  };
  each([&entries](double entry) { entries.push_back(entry); });
  archive.io("entries", entries);
  auto next = entries.cbegin();
  each([&next](double& entry) { entry = *next++; });
  is_linked_.assign(is_linked_.size(), true);
  archive.io("from_film", from_film_);
}

// Subtracts the contributions of other columns from as many sums as there are layers.
template <int N>
void HeatSystem::subtract(int begin, int end, const double* x, std::span<double> sums) const {
  const int n = N > 0 ? N : layers_;
  for (int link = begin; link < end; ++link) {
    const auto& [slot, row] = linked_[link];
    const double* from = x + row;
    const double* entry = from_slots_.data() + slot * n;
    for (int l = 0; l < n; ++l) sums[l] -= entry[l] * from[l];
  }
}

template <int N>
void HeatSystem::multiply_layers(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  const int n = N > 0 ? N : layers_;
  std::array<double, N == 0 ? most_layers : N> sums;
  for (int node = 0; node < grid_.size(); ++node) {
    const int first = row(node, 0);
    for (int l = 0; l < n; ++l) {
      const Layer& of = layer_[first + l];
      sums[l] = -of.self * x[first + l];
      if (l > 0) sums[l] -= of.below * x[first + l - 1];
      if (l + 1 < n) sums[l] -= of.above * x[first + l + 1];
    }
    subtract<N>(links_[node].begin, links_[node].end, x.data(), sums);
    for (int l = 0; l < n; ++l) y[first + l] = -sums[l];
    if (!ring_.empty()) y[first] += layer_[first].ring * x[ring_row(node / grid_.n_z)];
  }
}

void HeatSystem::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  for_layers([&](auto number) { multiply_layers<number()>(x, y); });
  if (ring_.empty()) return;
  const int n = ring_rows();
  for (int i = 0; i < n; ++i) {
    const Ring& of = ring_[i];
    double sum =
        of.self * x[ring_row(i)] + of.before * x[ring_row((i + n - 1) % n)] + of.after * x[ring_row((i + 1) % n)];
    for (int j = 0; j < grid_.n_z; ++j) sum += from_film(grid_.index(i, j), x);
    y[ring_row(i)] = sum;
  }
  if (answer_.is_set()) y.segment(film_rows(), n) = answer_.rows(x.segment(film_rows(), n), y.segment(film_rows(), n));
}

// Along the axis oil usually flows from the middle to the edges.
void HeatSystem::prepare(int first, bool forwards) {
  order_.clear();
  const int n_phi = grid_.n_phi, middle = grid_.n_z / 2;
  for (int k = 0; k < n_phi; ++k) {
    const int i = ((forwards ? first + k : first - k) % n_phi + n_phi) % n_phi;
    for (int j = middle; j < grid_.n_z; ++j) order_.push_back(grid_.index(i, j));
    for (int j = middle - 1; j >= 0; --j) order_.push_back(grid_.index(i, j));
  }
  find_links();
  for (int node = 0; node < grid_.size(); ++node) {
    double last = 0;
    for (int l = 0; l < layers_; ++l) {
      const Layer& of = layer_[row(node, l)];
      const double inverse = 1 / (of.self - of.below * last);
      last = of.above * inverse;
      pivots_[row(node, l)] = {inverse, of.below * inverse, last};
    }
  }
  if (!ring_.empty()) prepare_ring();
}

// Most of the four neighbours and of those beyond contribute nothing to a column: oil comes from one side around and
// one side along the axis.
void HeatSystem::find_links() {
  std::vector<int> rank(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) rank[order_[k]] = static_cast<int>(k);
  links_.clear(), linked_.clear();
  const auto count = [this] { return static_cast<int>(linked_.size()); };
  for (int node = 0; node < grid_.size(); ++node) {
    Links links{.begin = count()};
    for (const bool later : {false, true}) {
      if (later) links.later = count();
      for (int slot = 8 * node; slot < 8 * (node + 1); ++slot)
        if (is_linked_[slot] && (rank[node_at(slot)] > rank[node]) == later)
          linked_.emplace_back(slot, row(node_at(slot), 0));
    }
    links.end = count();
    links_.push_back(links);
  }
}

// Columns are solved one by one; those that follow are still zero.
template <int N>
void HeatSystem::sweep_layers(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  const int n = N > 0 ? N : layers_;
  std::array<double, N == 0 ? most_layers : N> rest;
  for (const int node : order_) {
    const int first = row(node, 0);
    for (int l = 0; l < n; ++l) rest[l] = b[first + l];
    subtract<N>(links_[node].begin, links_[node].later, x.data(), rest);
    if (!ring_.empty()) rest[0] -= layer_[first].ring * x[ring_row(node / grid_.n_z)];
    const Pivot* pivot = &pivots_[first];
    rest[0] *= pivot[0].inverse;
    for (int l = 1; l < n; ++l) rest[l] = rest[l] * pivot[l].inverse - pivot[l].below * rest[l - 1];
    for (int l = n - 2; l >= 0; --l) rest[l] -= pivot[l].above * rest[l + 1];
    for (int l = 0; l < n; ++l) x[first + l] = rest[l];
  }
}

void HeatSystem::sweep(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  x.head(size()).setZero();
  if (!ring_.empty()) {
    if (answer_.is_set()) {
      x.segment(film_rows(), ring_rows()) =
          answer_.solve(b.segment(film_rows(), ring_rows()), Eigen::VectorXd::Zero(ring_rows()));
    } else {
      x.segment(film_rows(), ring_rows()) = b.segment(film_rows(), ring_rows());
      solve_ring(x);
    }
  }
  for_layers([&](auto number) { sweep_layers<number()>(b, x); });
  if (ring_.empty()) return;
  Eigen::VectorXd by_film = Eigen::VectorXd::Zero(ring_rows());
  for (int i = 0; i < ring_rows(); ++i)
    for (int j = 0; j < grid_.n_z; ++j) by_film[i] += from_film(grid_.index(i, j), x);
  if (answer_.is_set()) {
    x.segment(film_rows(), ring_rows()) = answer_.solve(b.segment(film_rows(), ring_rows()), by_film);
    return;
  }
  x.segment(film_rows(), ring_rows()) = b.segment(film_rows(), ring_rows()) - by_film;
  solve_ring(x);
}

// A ring is a tridiagonal chain, closed by two entries: Sherman and Morrison's formula combines the chain's solutions
// for them.
void HeatSystem::prepare_ring() {
  const int n = ring_rows();
  if (answer_.is_set()) {
    Eigen::VectorXd C(n);
    for (int i = 0; i < n; ++i) C[i] = ring_[i].self;
    answer_.prepare(C);
    return;
  }
  ring_pivots_.assign(static_cast<std::size_t>(n), {});
  const double corner = -ring_[0].self;
  double last = 0;
  for (int i = 0; i < n; ++i) {
    double self = ring_[i].self;
    if (i == 0) self -= corner;
    if (i == n - 1) self -= ring_[0].before * ring_[n - 1].after / corner;
    const double inverse = 1 / (self - (i > 0 ? ring_[i].before * last : 0));
    last = ring_[i].after * inverse;
    ring_pivots_[i] = {inverse, last};
  }
  closing_.setZero(size());
  closing_[ring_row(0)] = corner, closing_[ring_row(n - 1)] = ring_[n - 1].after;
  closing_fraction_ = 0;
  Eigen::VectorXd answer = closing_;
  solve_ring(answer);
  closing_ = answer;
  closing_fraction_ = 1;
}

void HeatSystem::solve_ring(Eigen::VectorXd& x) const {
  const int n = ring_rows();
  for (int i = 0; i < n; ++i) {
    const double carried = i > 0 ? ring_[i].before * x[ring_row(i - 1)] : 0;
    x[ring_row(i)] = (x[ring_row(i)] - carried) * ring_pivots_[i].first;
  }
  for (int i = n - 2; i >= 0; --i) x[ring_row(i)] -= ring_pivots_[i].second * x[ring_row(i + 1)];
  if (closing_fraction_ == 0) return;
  const double fraction = ring_[0].before / -ring_[0].self;
  const double moved = x[ring_row(0)] + fraction * x[ring_row(n - 1)];
  const double by_closing = 1 + closing_[ring_row(0)] + fraction * closing_[ring_row(n - 1)];
  x.segment(film_rows(), n) -= moved / by_closing * closing_.tail(n);
}

}  // namespace hersey::film
