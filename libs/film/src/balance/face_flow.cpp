#include <algorithm>
#include <cmath>

#include "balance/flow_balance.h"

// Flows over the faces between control volumes (film.16, film.43, film.13, film.26, film.28).
namespace hersey::film {
namespace {

// Smallest fraction of the gap at its nodes that interpolation leaves to a face, as for the control volumes.
constexpr double least_face_fraction = 0.25;

// Largest ratio of the gap half a cell on to that at the node in the law of little oil: larger ratios are not resolved
// by the grid, and the law would be too steep for Newton's method.
constexpr double most_widening = 1.25;

double fourth(double x) { return x * x * x * x; }

}  // namespace

// A nearly empty node is left by its whole content, a full one by the flow that the gap behind it carries. Between both
// the smooth monotone law with these limits applies (film.28).
EntrainedFlow FaceFlow::carried(double theta) const {
  if (little == couette) return {theta * couette, couette, theta, 0};
  if (theta < 0) return {theta * little, little, 0, theta};
  const double y = theta * little / couette;
  if (is_deep) {
    const double s = 1 + y - theta, by_little = 1 / (s * s);
    return {theta * little / s, little * by_little, y * y * by_little, theta * (1 - theta) * by_little};
  }
  const double theta4 = fourth(theta), y4 = fourth(y), s = 1 + y4 - theta4, root = std::sqrt(std::sqrt(s));
  const double by_little = 1 / (s * root);
  return {theta * little / root, little * by_little, y4 * y * by_little, theta * (1 - theta4) * by_little};
}

bool FlowBalance::is_limited(std::size_t f) const {
  if (axial(f)) return false;
  const Face& face = faces_[f];
  return bends_[static_cast<Eigen::Index>(f)] < (least_face_fraction - 1) * 0.5 * (nodes_[face.a].h + nodes_[face.b].h);
}

double FlowBalance::thickness_on(std::size_t f) const {
  const Face& face = faces_[f];
  const double mean = 0.5 * (nodes_[face.a].h + nodes_[face.b].h);
  if (axial(f)) return mean;
  return is_limited(f) ? least_face_fraction * mean : mean + bends_[static_cast<Eigen::Index>(f)];
}

FlowBalance::FaceGap FlowBalance::smooth_gap(std::size_t f, double h) const {
  const double speed = entrainment(f);
  FaceGap gap;
  gap.cube = h * h * h, gap.cube_h = 3 * h * h;
  gap.full = speed * h, gap.full_h = speed;
  return gap;
}

// Between rough surfaces (film.43) factors are means of those at both nodes.
void FlowBalance::roughen(std::size_t f, FaceGap& gap) const {
  if (rough_law_.is_smooth() && !is_layered()) return;  // all factors below are 1 and 0
  const Face& face = faces_[f];
  const RoughGap &a = rough_[face.a], &b = rough_[face.b];
  const int k = axial(f) ? 1 : 0;
  const double factor = 0.5 * (a.pressure[k] + b.pressure[k]);
  gap.cube_at = {0.5 * gap.cube * a.pressure_h[k], 0.5 * gap.cube * b.pressure_h[k]};
  gap.cube *= factor, gap.cube_h *= factor;
  // The surfaces carry the mean gap, and drag more or less of it as they slide.
  const double speed = entrainment(f), half_slip = this->half_slip(f);
  const double beyond = speed * (0.5 * (a.mean + b.mean) - 0.5 * (nodes_[face.a].h + nodes_[face.b].h));
  gap.full += beyond + 0.5 * (a.drag[k] + b.drag[k]) * half_slip;
  gap.full_at = {0.5 * (speed * (a.mean_h - 1) + half_slip * a.drag_h[k]),
                 0.5 * (speed * (b.mean_h - 1) + half_slip * b.drag_h[k])};
}

// The flow over pockets follows (film.26, film.28).
void FlowBalance::deepen(std::size_t f, double h, FaceGap& gap) {
  const auto t = static_cast<std::size_t>(flow_tube_of_[f]);
  const PocketFlowTube& flow_tube = relief_.flow_tubes()[t];
  const Face& face = faces_[f];
  const FlowTubeGap deep = relief_.gap(flow_tube, h);
  const double factor = gap.cube / (h * h * h);
  const double cube_h = gap.cube_h - 3 * factor * h * h;  // derivative of the roughness factor alone
  gap.cube_at[0] *= deep.cube.value / (h * h * h), gap.cube_at[1] *= deep.cube.value / (h * h * h);
  gap.cube = factor * deep.cube.value;
  gap.cube_h = factor * deep.cube.h + cube_h * deep.cube.value / (h * h * h);
  gap.cube_journal = factor * deep.cube.journal;

  // Past a step the oil is carried at the surfaces' mean speed relative to the step.
  const double past = entrainment(f) - pocket_edge_speed(f, flow_tube);
  gap.full += past * (deep.carry.value - h) + flow_tube.swept / face.width;
  gap.full_h += past * (deep.carry.h - 1);
  gap.full_journal = past * deep.carry.journal + flow_tube.swept_journal / face.width;
  const double mu = 2 / (flow_of(face.a, f).value + flow_of(face.b, f).value), volume = face.width * face.length;
  const double drop = nodes_[face.b].wall - nodes_[face.a].wall, drag = 12 * mu * volume;
  pocket_flows_[t].recirculation = drag * past * past * deep.excess.value;
  PocketFlow::Moment& m = pocket_flows_[t].moment;
  m.drop = face.width * (deep.carry.value - h);
  m.past = drag * deep.excess.value;
  m.value = m.past * past + m.drop * drop;
  m.h = drag * past * deep.excess.h + face.width * (deep.carry.h - 1) * drop;
  m.fluidity = -mu * m.past * past;
  m.journal = drag * past * deep.excess.journal + face.width * deep.carry.journal * drop;
}

bool FlowBalance::oil_crosses_pocket_edge(std::size_t f) const {
  const double speed = entrainment(f);
  return axial(f) || (speed - faces_[f].stretch * speeds_.u_journal) * speed > 0;
}

Speeds FlowBalance::entrained_upstream(std::size_t f, int from) const {
  const Cell& cell = cells_[from];
  Speeds by{.mean = cell.gap + cell.depth, .half_slip = rough_[from].drag[axial(f) ? 1 : 0]};
  if (cell.turning > 0 && !axial(f)) (oil_crosses_pocket_edge(f) ? by.journal : by.mean) -= cell.turning;
  return by;
}

// Flow of little oil (film.28): the content of the control volume upstream moves at the surfaces' mean speed; the
// content of a rotating pocket only at the speed relative to its step, in addition to the oil that rotates over the
// face with the pocket.
void FlowBalance::add_starved_limit(std::size_t f, FaceGap& gap) const {
  gap.little = gap.full;
  gap.from = gap.full >= 0 ? faces_[f].a : faces_[f].b;
  if (gap.full == 0 || (nodes_[gap.from].theta == 1 && !expects_any_fill_)) return;
  const double speed = entrainment(f), half_slip = this->half_slip(f), journal = faces_[f].stretch * speeds_.u_journal;
  const RoughGap& rough = rough_[gap.from];
  const int k = axial(f) ? 1 : 0;
  const bool is_deep = flow_tube_of_[f] >= 0;
  const PocketFlowTube* flow_tube =
      is_deep ? &relief_.flow_tubes()[static_cast<std::size_t>(flow_tube_of_[f])] : nullptr;
  const double swept = is_deep ? flow_tube->swept / faces_[f].width : 0;
  const double little = entrained_upstream(f, gap.from).dot({speed, half_slip, journal}) + swept;
  if (little * gap.full <= 0 || (is_deep && std::abs(little) <= std::abs(gap.full))) return;
  const double ratio = little / gap.full;
  if (!is_deep && (ratio > most_widening || ratio * most_widening < 1)) {
    gap.little_over_full = ratio > 1 ? most_widening : 1 / most_widening;
    gap.little = gap.little_over_full * gap.full;
    return;
  }
  gap.little = little;
  gap.little_h = speed * cells_[gap.from].gap_h + half_slip * rough.drag_h[k];
  gap.little_excess = speed * cells_[gap.from].gap_excess;
  if (is_deep) gap.little_journal = flow_tube->swept_journal / faces_[f].width;
  if (relief_.has_pockets() && oil_crosses_pocket_edge(f)) {
    gap.little_journal += (axial(f) ? speed : speed - journal) * relief_.depth_by_journal()[gap.from];
  }
}

std::array<double, 2> FlowBalance::thickness_weights(std::size_t f) const {
  if (is_limited(f)) return {0.5 * least_face_fraction, 0};
  return {0.5, axial(f) ? 0.0 : 1.0};
}

double FlowBalance::pocket_edge_speed(std::size_t f, const PocketFlowTube& flow_tube) const {
  return axial(f) ? 0 : edge_speed_of(flow_tube, entrainment(f), faces_[f].stretch * speeds_.u_journal);
}

// The line's rows count this fraction of the flow half-way to it.
void FlowBalance::find_carried_fraction(std::size_t f, const FaceGap& gap, const EntrainedFlow& carried) {
  const FaceFlow& flow = flows_[f];
  CutFaceFraction& fraction = line_fractions_[f % static_cast<std::size_t>(model_.grid.n_z)];
  fraction = {};
  if (flow.couette == 0) return;
  fraction.value = carried.value / flow.couette, fraction.theta = carried.theta / flow.couette;
  const double by_full = (carried.full + gap.little_over_full * carried.little - fraction.value) / gap.full;
  const double by_little = carried.little / gap.full;
  const auto [half, by_bend] = thickness_weights(f);
  fraction.h_a = by_full * (half * gap.full_h + gap.full_at[0]);
  fraction.h_b = by_full * (half * gap.full_h + gap.full_at[1]);
  (gap.from == faces_[f].a ? fraction.h_a : fraction.h_b) += by_little * gap.little_h;
  fraction.bend = by_full * by_bend * gap.full_h;
  fraction.excess = by_little * gap.little_excess;
  fraction.journal = by_full * gap.full_journal + by_little * gap.little_journal;
}

void FlowBalance::add_face(std::size_t f) {
  const Face& face = faces_[f];
  const Node &a = nodes_[face.a], &b = nodes_[face.b];
  FaceFlow& flow = flows_[f];
  flow = {};
  flow.density = 0.5 * (a.density + b.density);
  // No pressure gradient extends over a supply line: both sides are connected to the line itself.
  const double h = thickness_on(f), drop = a.p - b.p;
  const Fluidity &at_a = flow_of(face.a, f), &at_b = flow_of(face.b, f);
  const double fluidity = is_cut(f) ? 0 : 0.5 * (at_a.value + at_b.value);
  FaceGap gap = smooth_gap(f, h);
  roughen(f, gap);
  flow.is_deep = flow_tube_of_[f] >= 0;
  if (flow.is_deep) deepen(f, h, gap);
  add_starved_limit(f, gap);

  // The flow (film.16) is q = rho [h^3/(12 mu) b/l (p_a - p_b) + entrained flow].
  const double unit = face.width / (12 * face.length);
  flow.K = flow.density * unit * gap.cube * fluidity;
  flow.couette = flow.density * face.width * gap.full;
  flow.little = flow.density * face.width * gap.little;
  flow.little_over_couette = gap.little_over_full;
  flow.q_fluidity = is_cut(f) ? 0 : flow.density * unit * gap.cube * drop;
  const EntrainedFlow carried = flow.carried(upstream(f).theta);
  flow.q_theta = carried.theta;
  flow.q_density = unit * gap.cube * fluidity * drop + carried.value / flow.density;
  const double by_cube = flow.density * unit * fluidity * drop;
  const double by_full = flow.density * face.width * (carried.full + gap.little_over_full * carried.little),
               by_little = flow.density * face.width * carried.little;
  const double by_h = by_cube * gap.cube_h + by_full * gap.full_h;
  const auto [weight, by_bend] = thickness_weights(f);
  flow.q_h_a = weight * by_h + by_cube * gap.cube_at[0] + by_full * gap.full_at[0] + 0.5 * flow.q_fluidity * at_a.h;
  flow.q_h_b = weight * by_h + by_cube * gap.cube_at[1] + by_full * gap.full_at[1] + 0.5 * flow.q_fluidity * at_b.h;
  (gap.from == face.a ? flow.q_h_a : flow.q_h_b) += by_little * gap.little_h;
  flow.q_excess = by_little * gap.little_excess;
  flow.q_bend = by_bend * by_h;
  flow.q_journal = by_cube * gap.cube_journal + by_full * gap.full_journal + by_little * gap.little_journal;
  if (is_cut(f)) find_carried_fraction(f, gap, carried);
  const double poiseuille = flow.K * (a.p - b.p), entrained = carried.value;
  balance_[face.a] += poiseuille + entrained;
  balance_[face.b] -= poiseuille + entrained;
  const double passing = 0.5 * (std::abs(poiseuille) + std::abs(entrained));
  throughput_[face.a] += passing;
  throughput_[face.b] += passing;
}

std::array<double, 2> FlowBalance::flow_by_u(std::size_t f) const {
  const Face& face = faces_[f];
  const FaceFlow& flow = flows_[f];
  const Node &a = nodes_[face.a], &b = nodes_[face.b];
  const bool from_a = flow.couette >= 0;
  const auto by_laws = [&](const Node& node, double q_h) {
    const double fluidity_u = node.flow[axial(f) ? 1 : 0].u;
    return q_h * node.h_u + 0.5 * (flow.q_fluidity * fluidity_u + flow.q_density * node.density_u);
  };
  return {flow.K * a.p_u + by_laws(a, flow.q_h_a) + (from_a ? flow.q_theta * a.theta_u : 0),
          -flow.K * b.p_u + by_laws(b, flow.q_h_b) + (from_a ? 0 : flow.q_theta * b.theta_u)};
}

FlowBalance::CarriedBySpeeds FlowBalance::carried_by_speeds(std::size_t f) const {
  const Face& face = faces_[f];
  const FaceFlow& flow = flows_[f];
  const double h = thickness_on(f);
  Speeds full{.mean = h};
  if (!rough_law_.is_smooth() || is_layered()) {
    const RoughGap &a = rough_[face.a], &b = rough_[face.b];
    const int k = axial(f) ? 1 : 0;
    full.mean += 0.5 * (a.mean - nodes_[face.a].h + b.mean - nodes_[face.b].h);
    full.half_slip = 0.5 * (a.drag[k] + b.drag[k]);
  }
  Speeds swept;
  if (flow_tube_of_[f] >= 0) {
    const PocketFlowTube& flow_tube = relief_.flow_tubes()[static_cast<std::size_t>(flow_tube_of_[f])];
    const double deeper = relief_.gap(flow_tube, h).carry.value - h;
    full.mean += deeper;
    if (!axial(f)) {
      full.mean -= edge_speed_of(flow_tube, 1, 0) * deeper;
      full.journal -= edge_speed_of(flow_tube, 0, 1) * deeper;
    }
    swept.journal = flow_tube.swept_speed / face.width;
    full = full + swept;
  }
  Speeds little = full;
  if (flow.little_over_couette > 0)
    little = full * flow.little_over_couette;
  else if (flow.little != flow.couette)
    little = entrained_upstream(f, flow.couette >= 0 ? face.a : face.b) + swept;
  return {full * face.width, little * face.width};
}

Speeds FlowBalance::axial_speeds(const MotionDirection& direction) {
  return {0.5 * (direction.w_shell + direction.w_journal), 0.5 * (direction.w_shell - direction.w_journal),
          direction.w_journal};
}

Speeds FlowBalance::around_speeds(const MotionDirection& direction) {
  return {0.5 * (direction.u_shell + direction.u_journal), 0.5 * (direction.u_shell - direction.u_journal),
          direction.u_journal};
}

}  // namespace hersey::film
