#pragma once

#include "hersey/core/packed.h"

// Flow over a face between two control volumes (film.16, film.43, film.28), for one face or for several at once: Number
// is double or Packed.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace hersey::film {

template <class Number>
using MaskOf = decltype(Number{} < Number{});

/// Entrained (Couette) flow over a face whose upstream node is filled to theta, and its derivatives (film.28).
template <class Number>
struct EntrainedFlowOf {
  Number value{};   ///< [m^3/s]
  Number theta{};   ///< d/d theta [m^3/s]
  Number full{};    ///< d/d (flow of a full gap) [-]
  Number little{};  ///< d/d (flow per fill fraction of a nearly empty gap) [-]
};
using EntrainedFlow = EntrainedFlowOf<double>;

/// Flow over a face, linearised (film.16): dq = K d(p_a - p_b) + q_h_a dh_a + q_h_b dh_b + q_bend d bend + q_fluidity
/// d(1/mu) + q_density d density + q_theta d theta_upwind + q_speed d(mean speed) + q_half_slip d(half slip). Flows are
/// masses over rho0.
template <class Number>
struct FaceFlowOf {
  Number K{};                    ///< conductance [m^3/(Pa s)]
  Number density = 1;            ///< rho/rho0 on the face [-]
  Number q_density{};            ///< d/d density: the volume flow [m^3/s]
  Number q_h_a{};                ///< d/d thickness at a [m^2/s]
  Number q_h_b{};                ///< d/d thickness at b [m^2/s]
  Number q_bend{};               ///< d/d (gap on the face less the mean of both nodes) [m^2/s]
  Number q_excess{};             ///< d/d (mean gap of the control volume upstream less the gap at its node) [m^2/s]
  Number q_journal{};            ///< d/d phi_journal [m^3/(s rad)]
  Number q_theta{};              ///< d/d theta upstream [m^3/s]
  Number q_fluidity{};           ///< d/d (1/mu on the face)
  Number q_speed{};              ///< d/d (mean speed of both surfaces) [m^2]
  Number q_half_slip{};          ///< d/d (half their difference) [m^2]
  Number q_journal_speed{};      ///< d/d (the journal's speed beside the others) [m^2]
  Number couette{};              ///< entrained flow of a full gap [m^3/s]
  Number little{};               ///< entrained flow per fill fraction of a nearly empty gap [m^3/s]
  Number little_over_couette{};  ///< ratio of `little` to `couette` where that is clamped; else 0 [-]
  bool is_deep = false;          ///< the face lies over a pocket, which retains oil

  /// A nearly empty node is left by its whole content, a full one by the flow that the gap behind it carries. Between
  /// both the smooth monotone law with these limits applies (film.28).
  [[nodiscard]] HERSEY_KERNEL EntrainedFlowOf<Number> carried(const Number& theta) const;
};
using FaceFlow = FaceFlowOf<double>;

template <class Number>
HERSEY_KERNEL EntrainedFlowOf<Number> FaceFlowOf<Number>::carried(const Number& theta) const {
  const EntrainedFlowOf<Number> as_full{theta * couette, couette, theta, 0.0};
  const MaskOf<Number> alike = little == couette;
  if (all(alike)) return as_full;
  const EntrainedFlowOf<Number> as_little{theta * little, little, 0.0, theta};
  const MaskOf<Number> lacking = theta < 0.0;
  if (all(lacking & !alike)) return as_little;
  const Number y = theta * little / couette;
  if (is_deep) {
    const Number s = 1.0 + y - theta, by_little = 1.0 / (s * s);
    return {theta * little / s, little * by_little, y * y * by_little, theta * (1.0 - theta) * by_little};
  }
  const Number theta4 = theta * theta * theta * theta, y4 = y * y * y * y;
  const Number s = 1.0 + y4 - theta4, root = square_root(square_root(s)), by_little = 1.0 / (s * root);
  return {select(alike, as_full.value, lacking, as_little.value, theta * little / root),
          select(alike, as_full.theta, lacking, as_little.theta, little * by_little),
          select(alike, as_full.full, lacking, as_little.full, y4 * y * by_little),
          select(alike, as_full.little, lacking, as_little.little, theta * (1.0 - theta4) * by_little)};
}

/// What flows over a face depend on beside both nodes.
template <class Number>
struct FaceShape {
  Number width{};      ///< across the flow [m]
  Number unit{};       ///< width/(12 length) [-]
  Number speed{};      ///< mean speed of both surfaces across the face, which entrains the oil [m/s]
  Number half_slip{};  ///< half their difference [m/s]
  Number bend{};       ///< gap on the face less the mean of both nodes [m]
  bool has_bend = true;
  bool is_cut = false;  ///< no pressure gradient extends over a supply line
};

/// A node beside a face, with its roughness in the face's direction.
template <class Number>
struct BesideFace {
  Number p{}, theta{}, h{}, density{};
  Number fluidity{}, fluidity_h{};
  Number oil_gap{}, oil_gap_h{}, oil_gap_excess{};    ///< gap that contains the oil, by h and by its excess
  Number mean{}, mean_h{}, pressure{}, pressure_h{};  ///< RoughGap
  Number drag{}, drag_h{};
};

/// Gap between two nodes: the parts that count for pressure-driven and for entrained flow, with derivatives by the
/// thickness on the face, by those at both nodes, and by phi_journal.
template <class Number>
struct FaceGap {
  Number h{}, weight{}, by_bend{};  ///< thickness, its derivatives by that at either node and by the bend
  Number cube{}, cube_h{}, cube_a{}, cube_b{}, cube_journal{};
  Number full{}, full_h{}, full_a{}, full_b{}, full_journal{};
  Number little{}, little_h{}, little_excess{}, little_journal{};  ///< by h and excess of the node upstream
  Number little_over_full{};  ///< ratio of `little` to `full` where that is clamped; else 0
  MaskOf<Number> from_a{};    ///< a is upstream
};

/// Smallest fraction of the gap at its nodes that interpolation leaves to a face, as for the control volumes.
constexpr double least_face_fraction = 0.25;

/// Sets thickness and gap on a face; between rough surfaces (film.43) factors are means of those at both nodes.
template <bool is_rough, class Number>
HERSEY_KERNEL void find_gap(const FaceShape<Number>& face, const BesideFace<Number>& a, const BesideFace<Number>& b,
                            FaceGap<Number>& gap) {
  const Number mean = 0.5 * (a.h + b.h);
  gap.h = mean, gap.weight = 0.5;
  if (face.has_bend) {
    const MaskOf<Number> limited = face.bend < (least_face_fraction - 1) * mean;
    gap.h = select(limited, least_face_fraction * mean, mean + face.bend);
    gap.weight = select(limited, Number(0.5 * least_face_fraction), Number(0.5));
    gap.by_bend = select(limited, Number(0.0), Number(1.0));
  }
  const Number square = gap.h * gap.h;
  gap.cube = square * gap.h, gap.cube_h = 3.0 * square;
  gap.full = face.speed * gap.h, gap.full_h = face.speed;
  if constexpr (is_rough) {
    gap.cube_a = 0.5 * gap.cube * a.pressure_h, gap.cube_b = 0.5 * gap.cube * b.pressure_h;
    const Number factor = 0.5 * (a.pressure + b.pressure);
    gap.cube = gap.cube * factor, gap.cube_h = gap.cube_h * factor;
    // The surfaces carry the mean gap, and drag more or less of it as they slide.
    const Number beyond = 0.5 * (a.mean + b.mean) - mean;
    gap.full += face.speed * beyond + 0.5 * (a.drag + b.drag) * face.half_slip;
    gap.full_a = 0.5 * (face.speed * (a.mean_h - 1.0) + face.half_slip * a.drag_h);
    gap.full_b = 0.5 * (face.speed * (b.mean_h - 1.0) + face.half_slip * b.drag_h);
  }
}

/// Flow of little oil per width, with its derivatives by h and excess of the node upstream and by phi_journal
/// (film.28).
template <class Number>
struct LittleOil {
  Number flow{}, h{}, excess{}, journal{};
};

/// The content of the control volume upstream moves at the surfaces' mean speed.
template <bool is_rough, class Number>
HERSEY_KERNEL LittleOil<Number> little_oil(const FaceShape<Number>& face, const BesideFace<Number>& a,
                                           const BesideFace<Number>& b, const MaskOf<Number>& from_a) {
  LittleOil<Number> oil{face.speed * select(from_a, a.oil_gap, b.oil_gap),
                        face.speed * select(from_a, a.oil_gap_h, b.oil_gap_h),
                        face.speed * select(from_a, a.oil_gap_excess, b.oil_gap_excess), 0.0};
  if constexpr (is_rough) {
    oil.flow += face.half_slip * select(from_a, a.drag, b.drag);
    oil.h += face.half_slip * select(from_a, a.drag_h, b.drag_h);
  }
  return oil;
}

/// Largest ratio of the gap half a cell on to that at the node in the law of little oil: larger ratios are not resolved
/// by the grid, and the law would be too steep for Newton's method.
constexpr double most_widening = 1.25;

/// Sets the flow of little oil over a face where the node upstream may lack oil.
template <class Number>
HERSEY_KERNEL void limit_by_little(const LittleOil<Number>& oil, const MaskOf<Number>& may_lack, bool is_deep,
                                   FaceGap<Number>& gap) {
  gap.little = gap.full;
  MaskOf<Number> counts = may_lack & (oil.flow * gap.full > 0.0);
  if (is_deep) counts = counts & (oil.flow * oil.flow > gap.full * gap.full);
  if (all(!counts)) return;
  const Number ratio = oil.flow / gap.full;
  if (!is_deep) {
    const MaskOf<Number> widens = ratio > most_widening, narrows = ratio * most_widening < 1.0;
    const MaskOf<Number> clamped = counts & (widens | narrows);
    gap.little_over_full =
        select(clamped, select(widens, Number(most_widening), Number(1 / most_widening)), Number(0.0));
    gap.little = select(clamped, gap.little_over_full * gap.full, gap.little);
    counts = counts & !clamped;
  }
  gap.little = select(counts, oil.flow, gap.little);
  gap.little_h = select(counts, oil.h, Number(0.0));
  gap.little_excess = select(counts, oil.excess, Number(0.0));
  gap.little_journal = select(counts, oil.journal, Number(0.0));
}

/// Sets the flow over a face, q = rho [h^3/(12 mu) b/l (p_a - p_b) + entrained flow] (film.16), without its
/// derivatives by speeds.
/// @return the entrained flow
template <class Number>
HERSEY_KERNEL EntrainedFlowOf<Number> find_flow(const FaceShape<Number>& face, const BesideFace<Number>& a,
                                                const BesideFace<Number>& b, const FaceGap<Number>& gap,
                                                FaceFlowOf<Number>& flow) {
  const Number drop = face.is_cut ? Number(0.0) : a.p - b.p;
  const Number fluidity = face.is_cut ? Number(0.0) : 0.5 * (a.fluidity + b.fluidity);
  flow.density = 0.5 * (a.density + b.density);
  const Number by_cube = flow.density * face.unit * fluidity * drop, carrying = flow.density * face.width;
  flow.K = flow.density * face.unit * gap.cube * fluidity;
  flow.couette = carrying * gap.full;
  flow.little = carrying * gap.little;
  flow.little_over_couette = gap.little_over_full;
  flow.q_fluidity = flow.density * face.unit * gap.cube * drop;
  const EntrainedFlowOf<Number> carried = flow.carried(select(gap.from_a, a.theta, b.theta));
  flow.q_theta = carried.theta;
  flow.q_density = face.unit * gap.cube * fluidity * drop + carried.value / flow.density;
  const Number by_full = carrying * (carried.full + gap.little_over_full * carried.little);
  const Number by_little = carrying * carried.little, by_h = by_cube * gap.cube_h + by_full * gap.full_h;
  const Number upstream_h = by_little * gap.little_h;
  flow.q_h_a = gap.weight * by_h + by_cube * gap.cube_a + by_full * gap.full_a + 0.5 * flow.q_fluidity * a.fluidity_h +
               select(gap.from_a, upstream_h, Number(0.0));
  flow.q_h_b = gap.weight * by_h + by_cube * gap.cube_b + by_full * gap.full_b + 0.5 * flow.q_fluidity * b.fluidity_h +
               select(gap.from_a, Number(0.0), upstream_h);
  flow.q_excess = by_little * gap.little_excess;
  flow.q_bend = gap.by_bend * by_h;
  flow.q_journal = by_cube * gap.cube_journal + by_full * gap.full_journal + by_little * gap.little_journal;
  return carried;
}

/// Sets the derivatives of a flow by the speeds of the surfaces; there are no pockets.
template <bool is_rough, class Number>
HERSEY_KERNEL void find_by_speeds(const FaceShape<Number>& face, const BesideFace<Number>& a,
                                  const BesideFace<Number>& b, const FaceGap<Number>& gap,
                                  const EntrainedFlowOf<Number>& carried, FaceFlowOf<Number>& flow) {
  const MaskOf<Number> clamped = gap.little_over_full > 0.0, alike = flow.little == flow.couette;
  Number full = gap.h, little = select(gap.from_a, a.oil_gap, b.oil_gap);
  if constexpr (is_rough) full += 0.5 * (a.mean - a.h + b.mean - b.h);
  little = select(clamped, gap.little_over_full * full, alike, full, little);
  const Number carrying = flow.density * face.width;
  flow.q_speed = carrying * (carried.full * full + carried.little * little);
  if constexpr (is_rough) {
    const Number full_slip = 0.5 * (a.drag + b.drag);
    const Number little_slip =
        select(clamped, gap.little_over_full * full_slip, alike, full_slip, select(gap.from_a, a.drag, b.drag));
    flow.q_half_slip = carrying * (carried.full * full_slip + carried.little * little_slip);
  }
}

}  // namespace hersey::film

#pragma GCC diagnostic pop
