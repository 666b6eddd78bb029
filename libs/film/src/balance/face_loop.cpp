#include <cmath>
#include <type_traits>
#include <utility>

#include "balance/face_law.h"
#include "balance/flow_balance.h"

// The loop over all faces of a film. Kernels return packed numbers only to functions into which they are inlined.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace hersey::film {
namespace {

/// One number, or those of the next nodes or faces as well; `at` gives the one with an index.
template <class Number, class At>
HERSEY_KERNEL Number gathered(const At& at, int first) {
  if constexpr (std::is_same_v<Number, double>)
    return at(first);
  else
    return Packed::Values{at(first), at(first + 1), at(first + 2), at(first + 3)};
}

HERSEY_KERNEL FaceFlow lane(const FaceFlowOf<Packed>& flow, int k) {
  return {.K = lane(flow.K, k),
          .density = lane(flow.density, k),
          .q_density = lane(flow.q_density, k),
          .q_h_a = lane(flow.q_h_a, k),
          .q_h_b = lane(flow.q_h_b, k),
          .q_bend = lane(flow.q_bend, k),
          .q_excess = lane(flow.q_excess, k),
          .q_journal = 0,
          .q_theta = lane(flow.q_theta, k),
          .q_fluidity = lane(flow.q_fluidity, k),
          .q_speed = lane(flow.q_speed, k),
          .q_half_slip = lane(flow.q_half_slip, k),
          .q_journal_speed = 0,
          .couette = lane(flow.couette, k),
          .little = lane(flow.little, k),
          .little_over_couette = lane(flow.little_over_couette, k)};
}

}  // namespace

template <bool is_rough, class Number>
HERSEY_KERNEL BesideFace<Number> FlowBalance::beside_face(int first, bool is_axial) const {
  const int axis = is_axial ? 1 : 0;
  const Node* const nodes = nodes_.data();
  const Cell* const cells = cells_.data();
  BesideFace<Number> side;
  side.p = gathered<Number>([=](int k) HERSEY_INLINED { return nodes[k].p; }, first);
  side.theta = gathered<Number>([=](int k) HERSEY_INLINED { return nodes[k].theta; }, first);
  side.h = gathered<Number>([=](int k) HERSEY_INLINED { return nodes[k].h; }, first);
  side.density = gathered<Number>([=](int k) HERSEY_INLINED { return nodes[k].density; }, first);
  side.fluidity = gathered<Number>([=](int k) HERSEY_INLINED { return nodes[k].flow[axis].value; }, first);
  side.fluidity_h = gathered<Number>([=](int k) HERSEY_INLINED { return nodes[k].flow[axis].h; }, first);
  side.oil_gap = gathered<Number>([=](int k) HERSEY_INLINED { return cells[k].gap; }, first);
  side.oil_gap_h = gathered<Number>([=](int k) HERSEY_INLINED { return cells[k].gap_h; }, first);
  side.oil_gap_excess = gathered<Number>([=](int k) HERSEY_INLINED { return cells[k].gap_excess; }, first);
  if constexpr (is_rough) {
    const RoughGap* const rough = rough_.data();
    side.mean = gathered<Number>([=](int k) HERSEY_INLINED { return rough[k].mean; }, first);
    side.mean_h = gathered<Number>([=](int k) HERSEY_INLINED { return rough[k].mean_h; }, first);
    side.pressure = gathered<Number>([=](int k) HERSEY_INLINED { return rough[k].pressure[axis]; }, first);
    side.pressure_h = gathered<Number>([=](int k) HERSEY_INLINED { return rough[k].pressure_h[axis]; }, first);
    side.drag = gathered<Number>([=](int k) HERSEY_INLINED { return rough[k].drag[axis]; }, first);
    side.drag_h = gathered<Number>([=](int k) HERSEY_INLINED { return rough[k].drag_h[axis]; }, first);
  }
  return side;
}

template <class Number>
HERSEY_KERNEL FaceShape<Number> FlowBalance::shape_of(int first, bool is_axial) const {
  const Face* const faces = faces_.data();
  FaceShape<Number> shape;
  shape.has_bend = !is_axial;
  shape.width = gathered<Number>([=](int f) HERSEY_INLINED { return faces[f].width; }, first);
  shape.unit = shape.width / (12.0 * gathered<Number>([=](int f) HERSEY_INLINED { return faces[f].length; }, first));
  shape.speed = speed_z_, shape.half_slip = half_slip_z_;
  if (is_axial) return shape;
  const Number stretch = gathered<Number>([=](int f) HERSEY_INLINED { return faces[f].stretch; }, first);
  shape.speed = stretch * speed_phi_, shape.half_slip = stretch * half_slip_phi_;
  const double* const bends = bends_.data();
  shape.bend = gathered<Number>([=](int f) HERSEY_INLINED { return bends[f]; }, first);
  return shape;
}

HERSEY_KERNEL void FlowBalance::add_flow(int f, double poiseuille, double entrained) {
  const auto [a, b] = std::pair{faces_[f].a, faces_[f].b};
  const double passing = 0.5 * (std::abs(poiseuille) + std::abs(entrained));
  balance_[a] += poiseuille + entrained;
  balance_[b] -= poiseuille + entrained;
  throughput_[a] += passing;
  throughput_[b] += passing;
}

// One face, whatever counts there.
template <bool is_rough>
void FlowBalance::add_face(int f) {
  const Face& face = faces_[f];
  FaceShape<double> shape = shape_of<double>(f, axial(f));
  shape.is_cut = is_cut(f);
  const auto a = beside_face<is_rough, double>(face.a, axial(f)), b = beside_face<is_rough, double>(face.b, axial(f));
  FaceFlow& flow = flows_[f];
  flow = {};
  flow.is_deep = flow_tube_of_[f] >= 0;
  FaceGap<double> gap;
  find_gap<is_rough>(shape, a, b, gap);
  if (flow.is_deep) deepen(f, gap);
  gap.from_a = gap.full >= 0;
  const int from = gap.from_a ? face.a : face.b;
  const bool may_lack_oil = nodes_[from].theta != 1 || expects_any_fill_;
  LittleOil<double> oil = little_oil<is_rough>(shape, a, b, gap.from_a);
  if (relief_.has_pockets()) add_oil_of_pockets(f, from, oil);
  limit_by_little(oil, may_lack_oil, flow.is_deep, gap);
  const EntrainedFlow carried = find_flow(shape, a, b, gap, flow);
  const auto [full, little] = carried_by_speeds(f);
  const Speeds by_speeds = (full * carried.full + little * carried.little) * flow.density;
  flow.q_speed = by_speeds.mean, flow.q_half_slip = by_speeds.half_slip, flow.q_journal_speed = by_speeds.journal;
  if (shape.is_cut) find_carried_fraction(f, gap, carried);
  add_flow(f, flow.K * (a.p - b.p), carried.value);
}

/// Faces of a film without pockets, away from a supply line: several at once.
template <bool is_rough>
class FlowBalance::PackedFaces {
 public:
  explicit PackedFaces(FlowBalance& balance) : balance_(balance) {}

  HERSEY_FUSED void add_fused() { add_all(); }
  void add_plain() { add_all(); }

 private:
  HERSEY_KERNEL void add_all() {
    for (const FaceRun& run : balance_.around_runs_) add_around_line(run);
    for (const FaceRun& run : balance_.axial_runs_) add(run);
  }

  HERSEY_KERNEL void add_around_line(const FaceRun& run) {
    const int n_z = balance_.model_.grid.n_z, cut = balance_.line_.column * n_z - run.face;
    if (!balance_.line_.cuts || cut < 0 || cut >= run.count) return add(run);
    const int after = cut + n_z;
    add({run.face, run.a, run.b, cut});
    for (int k = cut; k < after; ++k) balance_.add_face<is_rough>(run.face + k);
    add({run.face + after, run.a + after, run.b + after, run.count - after});
  }

  HERSEY_KERNEL void add(const FaceRun& run) {
    int k = 0;
    for (; k + Packed::width <= run.count; k += Packed::width) add_packed(run.face + k, run.a + k, run.b + k);
    for (; k < run.count; ++k) balance_.add_face<is_rough>(run.face + k);
  }

  HERSEY_KERNEL void add_packed(int f, int node_a, int node_b) {
    const bool is_axial = balance_.axial(f);
    const auto shape = balance_.shape_of<Packed>(f, is_axial);
    const auto a = balance_.beside_face<is_rough, Packed>(node_a, is_axial);
    const auto b = balance_.beside_face<is_rough, Packed>(node_b, is_axial);
    FaceGap<Packed> gap;
    find_gap<is_rough>(shape, a, b, gap);
    gap.from_a = gap.full >= 0.0;
    const Packed theta = select(gap.from_a, a.theta, b.theta);
    const PackedMask may_lack_oil = balance_.expects_any_fill_ ? theta == theta : !(theta == 1.0);
    limit_by_little(little_oil<is_rough>(shape, a, b, gap.from_a), may_lack_oil, false, gap);
    FaceFlowOf<Packed> flow;
    const EntrainedFlowOf<Packed> carried = find_flow(shape, a, b, gap, flow);
    find_by_speeds<is_rough>(shape, a, b, gap, carried, flow);
    const Packed poiseuille = flow.K * (a.p - b.p);
    for (int k = 0; k < Packed::width; ++k) {
      balance_.flows_[f + k] = lane(flow, k);
      balance_.add_flow(f + k, lane(poiseuille, k), lane(carried.value, k));
    }
  }

  FlowBalance& balance_;
};

void FlowBalance::add_faces() { has_rough_gaps() ? add_faces_of<true>() : add_faces_of<false>(); }

template <bool is_rough>
void FlowBalance::add_faces_of() {
  if (relief_.is_empty()) {
    PackedFaces<is_rough> faces(*this);
    return has_fused_instructions() ? faces.add_fused() : faces.add_plain();
  }
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) add_face<is_rough>(f);
}

}  // namespace hersey::film

#pragma GCC diagnostic pop
