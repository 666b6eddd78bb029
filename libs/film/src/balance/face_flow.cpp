#include <algorithm>
#include <cmath>

#include "balance/flow_balance.h"

// Flows over the faces between control volumes (film.16, film.43, film.13, film.26, film.28).
namespace hersey::film {

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

// The flow over pockets follows (film.26, film.28).
void FlowBalance::deepen(std::size_t f, FaceGap<double>& gap) {
  const double h = gap.h;
  const auto t = static_cast<std::size_t>(flow_tube_of_[f]);
  const PocketFlowTube& flow_tube = relief_.flow_tubes()[t];
  const Face& face = faces_[f];
  const FlowTubeGap deep = relief_.gap(flow_tube, h);
  const double factor = gap.cube / (h * h * h);
  const double cube_h = gap.cube_h - 3 * factor * h * h;  // derivative of the roughness factor alone
  gap.cube_a *= deep.cube.value / (h * h * h), gap.cube_b *= deep.cube.value / (h * h * h);
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

// The content of a rotating pocket moves only at the speed relative to its step, in addition to the oil that rotates
// over the face with the pocket (film.28).
void FlowBalance::add_oil_of_pockets(std::size_t f, int from, LittleOil<double>& oil) const {
  const Cell& cell = cells_[from];
  const double speed = entrainment(f), journal = faces_[f].stretch * speeds_.u_journal;
  const bool crosses = oil_crosses_pocket_edge(f);
  oil.flow += speed * cell.depth;
  if (cell.turning > 0 && !axial(f)) oil.flow -= (crosses ? journal : speed) * cell.turning;
  if (flow_tube_of_[f] >= 0) {
    const PocketFlowTube& flow_tube = relief_.flow_tubes()[static_cast<std::size_t>(flow_tube_of_[f])];
    oil.flow += flow_tube.swept / faces_[f].width;
    oil.journal += flow_tube.swept_journal / faces_[f].width;
  }
  if (crosses) oil.journal += (axial(f) ? speed : speed - journal) * relief_.depth_by_journal()[from];
}

std::array<double, 2> FlowBalance::thickness_weights(std::size_t f) const {
  if (is_limited(f)) return {0.5 * least_face_fraction, 0};
  return {0.5, axial(f) ? 0.0 : 1.0};
}

double FlowBalance::pocket_edge_speed(std::size_t f, const PocketFlowTube& flow_tube) const {
  return axial(f) ? 0 : edge_speed_of(flow_tube, entrainment(f), faces_[f].stretch * speeds_.u_journal);
}

// The line's rows count this fraction of the flow half-way to it.
void FlowBalance::find_carried_fraction(std::size_t f, const FaceGap<double>& gap, const EntrainedFlow& carried) {
  const FaceFlow& flow = flows_[f];
  CutFaceFraction& fraction = line_fractions_[f % static_cast<std::size_t>(model_.grid.n_z)];
  fraction = {};
  if (flow.couette == 0) return;
  fraction.value = carried.value / flow.couette, fraction.theta = carried.theta / flow.couette;
  const double by_full = (carried.full + gap.little_over_full * carried.little - fraction.value) / gap.full;
  const double by_little = carried.little / gap.full;
  const auto [half, by_bend] = thickness_weights(f);
  fraction.h_a = by_full * (half * gap.full_h + gap.full_a);
  fraction.h_b = by_full * (half * gap.full_h + gap.full_b);
  (gap.from_a ? fraction.h_a : fraction.h_b) += by_little * gap.little_h;
  fraction.bend = by_full * by_bend * gap.full_h;
  fraction.excess = by_little * gap.little_excess;
  fraction.journal = by_full * gap.full_journal + by_little * gap.little_journal;
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
