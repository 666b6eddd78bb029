#include "observe/film_wrench.h"

#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

// Sliding speed over which boundary friction changes its direction smoothly.
constexpr double friction_speed = 1e-3;

// Returns the slope at x = 0 of the parabola through three nodes, two of them at x = a and x = b.
std::array<double, 3> parabola_slope(double a, double b) {
  return {-(a + b) / (a * b), b / (a * (b - a)), -a / (b * (b - a))};
}

// Entries of a wrench in which the film's shear counts.
Vector6 counted(ShearForce shear_force) {
  Vector6 counts = Vector6::Ones();
  if (shear_force == ShearForce::torque_only) counts.tail<3>().setZero();
  if (shear_force == ShearForce::none) counts.setZero();
  return counts;
}

}  // namespace

FilmWrench::FilmWrench(const FilmModel& model)
    : model_(model),
      geometry_(model_),
      interpolation_(model_.grid, geometry_),
      shear_counts_(counted(model_.shear_force)) {
  for (const double phi : geometry_.phi) lines_.push_back({phi, std::cos(phi), std::sin(phi)});
  rows_.resize(static_cast<std::size_t>(model_.grid.n_z));
  lay_stencils();
}

// Differences are of second order up to the ends of patches and to the edges, where they are one-sided.
void FilmWrench::lay_stencils() {
  const Grid& grid = model_.grid;
  const Eigen::VectorXd &dx = geometry_.dx, &dz = geometry_.dz;
  for (int i = 0; i < grid.n_phi; ++i) {
    const int before = grid.before(i), after = grid.next(i);
    if (before < 0)
      phi_slopes_.push_back({{i, i + 1, i + 2}, parabola_slope(dx[i], dx[i] + dx[i + 1])});
    else if (after < 0)
      phi_slopes_.push_back({{i, i - 1, i - 2}, parabola_slope(-dx[before], -dx[before] - dx[i - 2])});
    else
      phi_slopes_.push_back({{i, before, after}, parabola_slope(-dx[before], dx[i])});
  }
  const int last = grid.n_z - 1;
  z_slopes_.push_back({{0, 1, 2}, parabola_slope(dz[0], dz[0] + dz[1])});
  for (int j = 1; j < last; ++j) z_slopes_.push_back({{j, j - 1, j + 1}, parabola_slope(-dz[j - 1], dz[j])});
  z_slopes_.push_back({{last, last - 1, last - 2}, parabola_slope(-dz[last - 1], -dz[last - 1] - dz[last - 2])});
}

FilmWrench::Stencil FilmWrench::slope_phi(int i, int j) const {
  Stencil slope = phi_slopes_[static_cast<std::size_t>(i)];
  for (int n = 0; n < 3; ++n) {
    slope.node[n] = model_.grid.index(slope.node[n], j);
    slope.weight[n] /= geometry_.stretch[j];
  }
  return slope;
}

FilmWrench::Stencil FilmWrench::slope_z(int node, int j) const {
  Stencil slope = z_slopes_[static_cast<std::size_t>(j)];
  for (int& of : slope.node) of += node - j;
  return slope;
}

FilmWrench::Basis FilmWrench::with_shear(const UnitTractions& unit) const {
  return {unit, unit.along.cwiseProduct(shear_counts_), unit.across.cwiseProduct(shear_counts_)};
}

FilmWrench::Basis FilmWrench::basis(int i, int j) const {
  return with_shear(tractions(model_.surface, model_.R, lines_[static_cast<std::size_t>(i)], geometry_.z[j]));
}

void FilmWrench::set_speeds(const SurfaceMotion& motion) {
  const double mu_friction = model_.asperities.mu_friction;
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    Row& row = rows_[j];
    row.stretch = geometry_.stretch[static_cast<Eigen::Index>(j)];
    row.slip << row.stretch * (motion.u_journal - motion.u_shell), motion.w_journal - motion.w_shell;
    const double square = row.slip.squaredNorm() + friction_speed * friction_speed, speed = std::sqrt(square);
    for (const int k : {0, 1}) row.rate_slip[k] = change_of_sliding(row.slip, Eigen::Vector2d::Unit(k)).rate;
    row.friction = mu_friction / speed * row.slip;
    row.friction_slip = mu_friction / speed * (Eigen::Matrix2d::Identity() - row.slip * row.slip.transpose() / square);
  }
}

void FilmWrench::evaluate(const FlowBalance& balance, const SurfaceMotion& motion, bool want_gradient) {
  const std::vector<Node>& nodes = balance.nodes();
  const Grid& grid = model_.grid;
  take_relief(balance);
  set_speeds(motion);
  for (Eigen::VectorXd* field : {&normal_.value, &normal_.by_u, &normal_.by_g}) field->resize(grid.size());
  opening_ = motion.shell_opening;
  if (want_gradient) {
    for (auto* gradient : {&by_u_, &by_g_}) gradient->setZero(6, grid.size());
    if (opening_.size() != 0) by_opening_.setZero(6, grid.size());
    by_supply_.setZero();
  }
  std::visit([&](const auto& surface) { add_nodes(surface, balance, want_gradient); }, model_.surface);
  if (cavitation_law(model_).has_tension() && !cavitation_law(model_).bears_tension()) cut_off(nodes, want_gradient);
  if (want_gradient && model_.cavitated_shear == CavitatedShear::film_share) add_borders(balance);
  pushes_.clear();
  if (balance.relief().has_pockets()) push_on_pocket_walls(balance, want_gradient);
  if (opening_.size() != 0) push_on_slopes(nodes, want_gradient);
  total_ = pressure_ + shear_ + asperity_;
}

// Over a fraction of a control volume the gap is deeper: mu v/h counts there with the depth (film.29).
void FilmWrench::take_relief(const FlowBalance& balance) {
  relief_.clear(), relief_journal_.clear();
  if (balance.relief().is_empty()) return;
  relief_.assign(balance.nodes().size(), {1, 0});
  relief_journal_.assign(balance.nodes().size(), 0);
  for (const CoveredDepth& covered : balance.relief().covered()) {
    const double h = balance.nodes()[covered.node].h, whole = h + covered.depth;
    relief_[covered.node].value -= covered.fraction * covered.depth / whole;
    relief_[covered.node].slope += covered.fraction * covered.depth / (whole * whole);
    relief_journal_[covered.node] -= covered.fraction_journal * covered.depth / whole;
  }
  for (std::size_t k = 0; k < relief_.size(); ++k) {
    if (relief_[k].value < 0) relief_[k] = {0, 0}, relief_journal_[k] = 0;  // two overlapping features
  }
}

// The pressure profile over a pocket differs from that over the land. Its effects on the shear of the oil and on the
// pocket's walls are half of the integral of d dp each, in the same direction on the surface that has the pocket
// (film.29).
void FilmWrench::push_on_pocket_walls(const FlowBalance& balance, bool want_gradient) {
  const Grid& grid = model_.grid;
  pushes_.clear();
  for (std::size_t t = 0; t < balance.relief().flow_tubes().size(); ++t) {
    const PocketFlowTube& flow_tube = balance.relief().flow_tubes()[t];
    const Face& face = balance.faces()[flow_tube.face];
    const PocketFlow::Moment& moment = balance.pocket_flow(t).moment;
    if (flow_tube.in_shell == flow_tube.in_journal) continue;
    const bool axial = flow_tube.face >= static_cast<std::size_t>(grid.size());
    const Basis at_a = basis(face.a / grid.n_z, face.a % grid.n_z), at_b = basis(face.b / grid.n_z, face.b % grid.n_z);
    const double sign = flow_tube.in_shell ? 1 : -1;
    const Vector6 direction =
        0.25 * sign *
        (axial ? Vector6(at_a.shear_across + at_b.shear_across) : Vector6(at_a.shear_along + at_b.shear_along));
    shear_ += moment.value * direction;
    if (!want_gradient) continue;
    const auto [by_node, by_bend] = balance.thickness_weights(flow_tube.face);
    WallPush push{.face = flow_tube.face,
                  .row = face.a % grid.n_z,
                  .direction = direction,
                  .by_bend = by_bend * moment.h,
                  .by_past = moment.past,
                  .in_journal = flow_tube.in_journal};
    for (const int k : {face.a, face.b}) {
      const Node& node = balance.nodes()[k];
      const double drop = k == face.a ? -moment.drop : moment.drop;
      const Fluidity& flow = node.flow[axial ? 1 : 0];
      const double by_h = by_node * moment.h + 0.5 * moment.fluidity * flow.h;
      by_u_.col(k) += (by_h * node.h_u + 0.5 * moment.fluidity * flow.u + drop * node.wall_u) * direction;
      by_g_.col(k) += by_h * node.h_g * direction;
      push.by_rate += 0.5 * moment.fluidity * flow.rate;
      push.by_rotation += 0.5 * moment.fluidity * flow.rotation;
    }
    by_journal_ += moment.journal * direction;
    pushes_.push_back(push);
  }
}

// Adds the change of that moment with the gap between the nodes and the speed past steps.
Vector6 FilmWrench::pushes_along(const MotionDirection& direction) const {
  Vector6 sum = Vector6::Zero();
  const Grid& grid = model_.grid;
  for (const WallPush& push : pushes_) {
    const bool axial = push.face >= static_cast<std::size_t>(grid.size());
    const auto node = static_cast<int>(push.face);
    const Row& row = rows_[static_cast<std::size_t>(push.row)];
    const SlidingChange sliding = change_of_sliding(
        row.slip, {row.stretch * (direction.u_journal - direction.u_shell), direction.w_journal - direction.w_shell});
    double change = push.by_rate * sliding.rate + push.by_rotation * sliding.rotation;
    if (axial) {
      change += push.by_past * 0.5 * (direction.w_shell + direction.w_journal);
    } else {
      change += push.by_past * row.stretch *
                (0.5 * (direction.u_shell + direction.u_journal) - (push.in_journal ? direction.u_journal : 0));
      if (direction.g.size() != 0)
        change += push.by_bend * interpolation_.bend(direction.g, node / grid.n_z, node % grid.n_z);
    }
    sum += change * push.direction;
  }
  return sum;
}

FilmWrench::Shear FilmWrench::shear_of(const Node& node, const RoughGap& rough, const ValueAndSlope& relief) {
  Shear s;
  const double couette = node.sheared_fraction * node.mu / node.h;
  const double by_fraction = node.sheared_fraction_u * node.mu / node.h,
               by_mu = node.sheared_fraction * node.mu_u / node.h;
  const double couette_u = by_mu + by_fraction;
  for (int k = 0; k < 2; ++k) {
    const double factor = rough.couette[k] * relief.value;
    const double factor_h = rough.couette_h[k] * relief.value + rough.couette[k] * relief.slope;
    s.couette[k] = couette * factor;
    s.couette_u[k] = couette_u * factor;
    s.couette_h[k] = couette * (factor_h - factor / node.h) + node.sheared_fraction * node.mu_h / node.h * factor;
    s.couette_rate[k] = node.sheared_fraction * node.mu_rate / node.h * factor;
    s.half_gap[k] = 0.5 * (rough.mean + rough.drag[k]);
    s.half_gap_h[k] = 0.5 * (rough.mean_h + rough.drag_h[k]);
  }
  return s;
}

// In a film that bears tension the pressure is cut off at p_cav somewhere between two nodes (film.23). The sum over
// nodes would count the last one for its whole cell: it is of first order, and its derivatives jump there. A pressure
// that falls from u_a > 0 to u_b < 0 over a distance l acts on its positive part, the triangle u_a t l/2 with t =
// u_a/(u_a - u_b).
void FilmWrench::cut_off(const std::vector<Node>& nodes, bool want_gradient) {
  const Grid& grid = model_.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    const int next = grid.next(i);
    for (int j = 0; j < grid.n_z && next >= 0; ++j) {
      const bool falls = nodes[grid.index(i, j)].p > 0 && nodes[grid.index(next, j)].p < 0;
      const bool rises = nodes[grid.index(i, j)].p < 0 && nodes[grid.index(next, j)].p > 0;
      if (!falls && !rises) continue;
      const int a = falls ? i : next, b = falls ? next : i;
      const int full = grid.index(a, j), cut = grid.index(b, j);
      const double p = nodes[full].p, t = p / (p - nodes[cut].p), area = geometry_.step(i, j) * geometry_.weight_z[j];
      const Vector6 normal = basis(a, j).normal;
      pressure_ -= 0.5 * area * (1 - t) * p * normal;
      if (!want_gradient) continue;
      by_u_.col(full) += area * (t - 0.5 * t * t - 0.5) * normal;
      by_u_.col(cut) += 0.5 * area * t * t * normal;
    }
  }
}

// The sheared fraction of volumes that the border of a cavity cuts follows the nodes around (film.60, film.61).
void FilmWrench::add_borders(const FlowBalance& balance) {
  for (const CavityBorder& border : balance.borders()) {
    const int i = border.node / model_.grid.n_z, j = border.node % model_.grid.n_z;
    const Row& row = rows_[static_cast<std::size_t>(j)];
    Node full = balance.nodes()[border.node];
    full.sheared_fraction = 1;
    const Shear s =
        shear_of(full, balance.rough_gaps()[border.node], relief_.empty() ? ValueAndSlope{1, 0} : relief_[border.node]);
    const Basis b = basis(i, j);
    const Vector6 whole = geometry_.weight(i, j) *
                          (s.couette[0] * row.slip[0] * b.shear_along + s.couette[1] * row.slip[1] * b.shear_across);
    const Node& telling = balance.nodes()[border.of];
    by_u_.col(border.of) += (border.by_u + border.by_h * telling.h_u) * whole;
    by_g_.col(border.of) += border.by_h * telling.h_g * whole;
    by_supply_ += border.by_line * whole;
    for (std::size_t side = 0; side < 4; ++side)
      if (border.beside[side] >= 0) by_u_.col(border.beside[side]) += border.by_beside[side] * whole;
    for (const int k : {0, 1}) {
      const SlidingChange change = change_of_sliding(row.slip, Eigen::Vector2d::Unit(k));
      const double stretch = k == 0 ? row.stretch : 1;
      by_slip_.col(k) += stretch * (border.by_rate * change.rate + border.by_rotation * change.rotation) * whole;
    }
  }
}

// Pressure acts at right angles to the true surface, which is inclined where the shell's opening d changes: -p grad d
// in addition to p e_r (film.52). Oil reaches around the edges, too, and with it the integral is that of d grad p: a
// uniform pressure contributes nothing. Contact ends at the edges. Sums over the intervals between nodes are exactly
// zero where p or d is uniform.
void FilmWrench::push_on_slopes(const std::vector<Node>& nodes, bool want_gradient) {
  const bool is_plane = std::holds_alternative<Plane>(model_.surface);
  const bool is_skirt = std::holds_alternative<Skirt>(model_.surface);
  const bool is_annulus = std::holds_alternative<Annulus>(model_.surface);
  const Grid& grid = model_.grid;
  // Adds the contribution of the interval from node a to node b to the entry `row` of the wrench; `arm` is its width
  // and lever.
  const auto add = [&](int row, int a, int b, double arm) {
    const Node &at_a = nodes[a], &at_b = nodes[b];
    const double mean = 0.5 * arm * (opening_[a] + opening_[b]), fall = arm * (opening_[a] - opening_[b]);
    const double rise = 0.5 * arm * (at_b.wall - at_a.wall), contact = 0.5 * arm * (at_a.asperity + at_b.asperity);
    pressure_[row] += mean * (at_b.wall - at_a.wall);
    asperity_[row] += 0.5 * fall * (at_a.asperity + at_b.asperity);
    if (!want_gradient) return;
    by_u_(row, a) += -mean * at_a.wall_u + 0.5 * fall * at_a.asperity_h * at_a.h_u;
    by_u_(row, b) += mean * at_b.wall_u + 0.5 * fall * at_b.asperity_h * at_b.h_u;
    by_g_(row, a) += 0.5 * fall * at_a.asperity_h * at_a.h_g;
    by_g_(row, b) += 0.5 * fall * at_b.asperity_h * at_b.h_g;
    by_opening_(row, a) += rise + contact;
    by_opening_(row, b) += rise - contact;
  };
  constexpr int moment_x = 0, moment_y = 1, moment_z = 2, force_x = 3, force_y = 4, force_z = 5;
  // On an annulus (film.63): e_phi is its mean over the interval, the difference of both ends' e_r over the angle.
  const auto add_on_annulus = [&](int i, int j, int next) {
    const int node = grid.index(i, j);
    const GridLine& here = lines_[static_cast<std::size_t>(i)];
    if (next >= 0) {
      const GridLine& there = lines_[static_cast<std::size_t>(next)];
      const double width = geometry_.weight_z[j], dphi = geometry_.dphi(i);
      add(moment_z, node, grid.index(next, j), model_.R * geometry_.stretch[j] * width);
      add(force_x, node, grid.index(next, j), width * (there.cosine - here.cosine) / dphi);
      add(force_y, node, grid.index(next, j), width * (there.sine - here.sine) / dphi);
    }
    if (j + 1 >= grid.n_z) return;
    const double width = geometry_.weight_phi[i] * geometry_.stretch_between[j];
    add(force_x, node, node + 1, width * here.cosine);
    add(force_y, node, node + 1, width * here.sine);
  };
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int node = grid.index(i, j), next = grid.next(i);
      if (is_annulus) {
        add_on_annulus(i, j, next);
        continue;
      }
      if (next >= 0 && !is_plane) add(moment_z, node, grid.index(next, j), model_.R * geometry_.weight_z[j]);
      if (next >= 0 && is_plane) {
        add(force_y, node, grid.index(next, j), geometry_.weight_z[j]);
        add(moment_x, node, grid.index(next, j), -geometry_.z[j] * geometry_.weight_z[j]);
      }
      if (j + 1 >= grid.n_z) continue;
      add(force_z, node, node + 1, geometry_.weight_phi[i]);
      if (is_plane) add(moment_x, node, node + 1, model_.R * geometry_.phi[i] * geometry_.weight_phi[i]);
      if (!is_skirt) continue;
      const double lever = model_.R * geometry_.weight_phi[i];  // of a force along the axis, (skirt.6)
      add(moment_x, node, node + 1, lever * lines_[static_cast<std::size_t>(i)].sine);
      add(moment_y, node, node + 1, -lever * lines_[static_cast<std::size_t>(i)].cosine);
    }
  }
}

template <class Surface>
void FilmWrench::add_nodes(const Surface& surface, const FlowBalance& balance, bool want_gradient) {
  Sums sums;
  for (int i = 0; i < model_.grid.n_phi; ++i) {
    const GridLine& line = lines_[static_cast<std::size_t>(i)];
    for (int j = 0; j < model_.grid.n_z; ++j)
      add_node(balance, with_shear(surface.tractions(model_.R, line, geometry_.z[j])), i, j, want_gradient, sums);
  }
  pressure_ = sums.pressure, shear_ = sums.shear, asperity_ = sums.asperity;
  if (want_gradient) by_slip_ = sums.by_slip, by_journal_ = sums.by_journal;
}

void FilmWrench::add_node(const FlowBalance& balance, const Basis& b, int i, int j, bool want_gradient, Sums& sums) {
  const std::vector<Node>& nodes = balance.nodes();
  const int k = model_.grid.index(i, j);
  const Node& node = nodes[k];
  const double area = geometry_.weight(i, j);
  const Row& row = rows_[static_cast<std::size_t>(j)];
  const Eigen::Vector2d& slip = row.slip;
  const Stencil by_phi = slope_phi(i, j), by_z = slope_z(k, j);
  const double p_phi = by_phi.of_wall(nodes), p_z = by_z.of_wall(nodes);
  const Shear s = shear_of(node, balance.rough_gaps()[k], relief_.empty() ? ValueAndSlope{1, 0} : relief_[k]);
  const auto sheared = [&](double along_phi, double along_z) -> Vector6 {
    return along_phi * b.shear_along + along_z * b.shear_across;
  };
  sums.pressure += area * node.wall * b.normal;
  normal_.value[k] = area * (node.wall + node.asperity);
  normal_.by_u[k] = area * (node.wall_u + node.asperity_h * node.h_u);
  normal_.by_g[k] = area * node.asperity_h * node.h_g;
  sums.shear +=
      area * sheared(s.couette[0] * slip[0] - s.half_gap[0] * p_phi, s.couette[1] * slip[1] - s.half_gap[1] * p_z);
  const Vector6 contact = b.normal + row.friction[0] * b.along + row.friction[1] * b.across;
  if (node.asperity != 0) sums.asperity += area * node.asperity * contact;
  if (!want_gradient) return;

  Vector6 by_h = area * sheared(s.couette_h[0] * slip[0] - s.half_gap_h[0] * p_phi,
                                s.couette_h[1] * slip[1] - s.half_gap_h[1] * p_z);
  if (node.asperity_h != 0) by_h += area * node.asperity_h * contact;
  by_u_.col(k) +=
      node.h_u * by_h + area * (node.wall_u * b.normal + sheared(s.couette_u[0] * slip[0], s.couette_u[1] * slip[1]));
  by_g_.col(k) = node.h_g * by_h;
  add_slope_by_u(nodes, by_phi, area * s.half_gap[0], b.shear_along);
  add_slope_by_u(nodes, by_z, area * s.half_gap[1], b.shear_across);
  if (!relief_journal_.empty() && relief_journal_[k] != 0) {
    sums.by_journal +=
        area * relief_journal_[k] / relief_[k].value * sheared(s.couette[0] * slip[0], s.couette[1] * slip[1]);
  }
  sums.by_slip.col(0) += area * row.stretch * s.couette[0] * b.shear_along;
  sums.by_slip.col(1) += area * s.couette[1] * b.shear_across;
  if (s.couette_rate[0] == 0 && s.couette_rate[1] == 0 && node.asperity == 0) return;
  Eigen::Matrix<double, 6, 2> turned =
      sheared(s.couette_rate[0] * slip[0], s.couette_rate[1] * slip[1]) * row.rate_slip.transpose();
  turned += node.asperity * (b.along * row.friction_slip.row(0) + b.across * row.friction_slip.row(1));
  sums.by_slip.col(0) += area * row.stretch * turned.col(0);
  sums.by_slip.col(1) += area * turned.col(1);
}

void FilmWrench::add_slope_by_u(const std::vector<Node>& nodes, const Stencil& slope, double drag,
                                const Vector6& traction) {
  for (int n = 0; n < 3; ++n) {
    const double by_u = drag * slope.weight[n] * nodes[slope.node[n]].wall_u;
    if (by_u != 0) by_u_.col(slope.node[n]) -= by_u * traction;
  }
}

Vector6 FilmWrench::more_of_other_shear(const FlowBalance& balance) const {
  const Grid& grid = model_.grid;
  Vector6 more = Vector6::Zero();
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int k = grid.index(i, j);
      Node node = balance.nodes()[k];
      if (node.other_sheared_fraction == node.sheared_fraction) continue;
      node.sheared_fraction = node.other_sheared_fraction - node.sheared_fraction;
      const Shear s = shear_of(node, balance.rough_gaps()[k], relief_.empty() ? ValueAndSlope{1, 0} : relief_[k]);
      const Eigen::Vector2d traction =
          geometry_.weight(i, j) * s.couette.cwiseProduct(rows_[static_cast<std::size_t>(j)].slip);
      const Basis b = basis(i, j);
      more += traction[0] * b.shear_along + traction[1] * b.shear_across;
    }
  }
  return more;
}

Vector6 FilmWrench::along(const MotionDirection& direction) const {
  const Eigen::Vector2d slip(direction.u_journal - direction.u_shell, direction.w_journal - direction.w_shell);
  Vector6 d = by_slip_ * slip + direction.phi_journal * by_journal_ + direction.phi_supply * by_supply_ +
              pushes_along(direction);
  if (direction.g.size() != 0) d += by_g_ * direction.g;
  if (direction.shell_fraction == 0) return d;
  HERSEY_REQUIRE(opening_.size() != 0, "what the shell's surface opens the gap by comes with the motion");
  d += direction.shell_fraction * (by_opening_ * direction.g);
  return d;
}

void FilmWrench::find_by_gap(Eigen::Matrix<double, 6, Eigen::Dynamic>& by) const {
  by = by_g_;
  const Grid& grid = model_.grid;
  for (const WallPush& push : pushes_) {
    const auto node = static_cast<int>(push.face);
    if (push.face >= static_cast<std::size_t>(grid.size())) continue;
    interpolation_.for_each_of_bend(node / grid.n_z, node % grid.n_z, [&](int of, double weight) {
      by.col(of) += push.by_bend * weight * push.direction;
    });
  }
}

const Eigen::Matrix<double, 6, Eigen::Dynamic>& FilmWrench::by_shell_opening() const {
  HERSEY_REQUIRE(opening_.size() != 0, "what the shell's surface opens the gap by comes with the motion");
  return by_opening_;
}

}  // namespace hersey::film
