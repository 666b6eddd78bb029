#include "balance/face_law.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <random>

using namespace hersey;
using namespace hersey::film;

namespace {

// Nodes beside a face as a film has them: full, cavitated and over-full trials, gaps that widen and narrow.
class Films {
 public:
  BesideFace<double> node() {
    BesideFace<double> side;
    side.p = one_of({0.0, pressure_(random_)});
    side.theta = one_of({1.0, fill_(random_), -0.01});
    side.h = gap_(random_);
    side.density = 1 + 0.05 * fill_(random_);
    side.fluidity = 1 / (0.005 + 0.05 * fill_(random_)), side.fluidity_h = fill_(random_);
    side.oil_gap = side.h * one_of({1.0, 0.5 + fill_(random_)});
    side.oil_gap_h = one_of({1.0, 0.25}), side.oil_gap_excess = one_of({0.0, 1.0});
    side.mean = side.h * (1 + 0.1 * fill_(random_)), side.mean_h = 1 - 0.1 * fill_(random_);
    side.pressure = 1 - 0.2 * fill_(random_), side.pressure_h = 1e4 * fill_(random_);
    side.drag = 1e-6 * (fill_(random_) - 0.5), side.drag_h = 0.1 * fill_(random_);
    return side;
  }

  FaceShape<double> shape() {
    FaceShape<double> face;
    face.width = 1e-3 * (1 + fill_(random_)), face.unit = 0.1 * fill_(random_);
    face.speed = one_of({0.0, 10.0, -3.0}), face.half_slip = one_of({0.0, 5.0});
    face.bend = 4e-5 * (fill_(random_) - 0.7);
    return face;
  }

 private:
  double one_of(std::initializer_list<double> values) {
    return values.begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random_)];
  }

  std::mt19937 random_{7};
  std::uniform_real_distribution<double> fill_{0.01, 0.99}, gap_{2e-6, 6e-5}, pressure_{0, 2e7};
};

template <class Number>
struct Film {
  FaceShape<Number> face;
  BesideFace<Number> a, b;
};

template <bool is_rough, class Number>
std::array<Number, 13> flow_over(const Film<Number>& film) {
  FaceGap<Number> gap;
  find_gap<is_rough>(film.face, film.a, film.b, gap);
  gap.from_a = gap.full >= 0.0;
  const Number theta = select(gap.from_a, film.a.theta, film.b.theta);
  const MaskOf<Number> may_lack_oil = !(theta == 1.0);
  limit_by_little(little_oil<is_rough>(film.face, film.a, film.b, gap.from_a), may_lack_oil, false, gap);
  FaceFlowOf<Number> flow;
  const EntrainedFlowOf<Number> carried = find_flow(film.face, film.a, film.b, gap, flow);
  find_by_speeds<is_rough>(film.face, film.a, film.b, gap, carried, flow);
  return {flow.K * (film.a.p - film.b.p) + carried.value,
          flow.K,
          flow.q_density,
          flow.q_h_a,
          flow.q_h_b,
          flow.q_bend,
          flow.q_excess,
          flow.q_theta,
          flow.q_fluidity,
          flow.q_speed,
          flow.q_half_slip,
          flow.couette,
          flow.little};
}

// The flow of one face; derivatives are those of differences.
template <bool is_rough>
double value(const Film<double>& film) {
  return flow_over<is_rough>(film)[0];
}

void set(Packed& packed, int lane, double value) { packed.values[lane] = value; }

void set(BesideFace<Packed>& side, int lane, const BesideFace<double>& one) {
  set(side.p, lane, one.p), set(side.theta, lane, one.theta), set(side.h, lane, one.h);
  set(side.density, lane, one.density), set(side.fluidity, lane, one.fluidity);
  set(side.fluidity_h, lane, one.fluidity_h), set(side.oil_gap, lane, one.oil_gap);
  set(side.oil_gap_h, lane, one.oil_gap_h), set(side.oil_gap_excess, lane, one.oil_gap_excess);
  set(side.mean, lane, one.mean), set(side.mean_h, lane, one.mean_h), set(side.pressure, lane, one.pressure);
  set(side.pressure_h, lane, one.pressure_h), set(side.drag, lane, one.drag), set(side.drag_h, lane, one.drag_h);
}

void set(FaceShape<Packed>& face, int lane, const FaceShape<double>& one) {
  set(face.width, lane, one.width), set(face.unit, lane, one.unit), set(face.speed, lane, one.speed);
  set(face.half_slip, lane, one.half_slip), set(face.bend, lane, one.bend);
}

template <bool is_rough>
void compare_packed_with_single_faces() {
  Films films;
  for (int k = 0; k < 2000; ++k) {
    std::array<Film<double>, Packed::width> single;
    Film<Packed> packed;
    for (int lane = 0; lane < Packed::width; ++lane) {
      Film<double>& one = single[lane];
      one = {films.shape(), films.node(), films.node()};
      set(packed.face, lane, one.face), set(packed.a, lane, one.a), set(packed.b, lane, one.b);
    }
    const auto together = flow_over<is_rough>(packed);
    for (int of = 0; of < Packed::width; ++of) {
      const auto alone = flow_over<is_rough>(single[of]);
      for (std::size_t i = 0; i < alone.size(); ++i)
        CHECK(lane(together[i], of) == doctest::Approx(alone[i]).epsilon(1e-12));  // round-off: sums of either sign
    }
  }
}

}  // namespace

TEST_CASE("FlowsOverSeveralFacesAtOnce_AreThoseOverEach") {
  compare_packed_with_single_faces<false>();
  compare_packed_with_single_faces<true>();
}

TEST_CASE("FlowOverAFace_HasTheDerivativesOfItsDifferences") {
  Films films;
  for (int k = 0; k < 500; ++k) {
    Film<double> film{films.shape(), films.node(), films.node()};
    film.a.oil_gap = film.a.h, film.b.oil_gap = film.b.h;  // a node's gap contains its oil
    film.a.oil_gap_h = film.b.oil_gap_h = 1;
    film.a.fluidity_h = film.b.fluidity_h = 0;
    const auto flow = flow_over<false>(film);
    const auto check = [&](double& variable, double size, double slope) {
      const double step = 1e-6 * size, at = variable;
      variable = at + step;
      const double above = value<false>(film);
      variable = at - step;
      const double below = value<false>(film);
      variable = at;
      const double one_sided[] = {(above - flow[0]) / step, (flow[0] - below) / step};
      const double scale = std::abs(flow[0]) / size + std::abs(slope);
      // Where the law has a kink within the step, the slope is that of one side.
      const double miss = std::min(std::abs(one_sided[0] - slope), std::abs(one_sided[1] - slope));
      CHECK(miss <= 2e-4 * scale);  // the step's square by the curvature of y^4, and its round-off
    };
    check(film.face.bend, film.a.h + film.b.h, flow[5]);
    if (film.face.speed != 0) check(film.face.speed, 10, flow[9]);  // at rest nothing says which node is upstream
  }
}
