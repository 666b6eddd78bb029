// Beams that move as is given: order two in space and in time of all that is shown of them.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "beam_cases.h"
#include "hersey/mbd/mechanism_builder.h"
#include "manufactured_line.h"
#include "observed_order.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace manufactured_beam_test {

using test::ManufacturedBeam;
// Gauss' rule of three points: of sixth order, far beyond that of the beam.
const std::array<double, 3> abscissae{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
const std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};

using Loads = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Forces and moments on the nodes that do the work of those along the beam where points move linearly between them,
/// and the wrenches on both ends (theory manual, beams.10). Several runs use those of one instant many times.
class NodalLoads {
 public:
  NodalLoads(const ManufacturedBeam& exact, int elements) : exact_(exact), elements_(elements) {}

  const Loads& at(double t) {
    const auto [entry, is_new] = known_.try_emplace(t);
    if (is_new) entry->second = loads(t);
    return entry->second;
  }
  [[nodiscard]] const ManufacturedBeam& exact() const { return exact_; }
  [[nodiscard]] int elements() const { return elements_; }

 private:
  [[nodiscard]] Loads loads(double t) const {
    Loads loads = Loads::Zero(6, elements_ + 1);
    loads.col(0) -= ManufacturedBeam::six(exact_.wrench(0.0, t));
    loads.col(elements_) += ManufacturedBeam::six(exact_.wrench(exact_.length, t));
    const double size = exact_.length / elements_;
    for (int e = 0; e < elements_; ++e) {
      for (std::size_t k = 0; k < abscissae.size(); ++k) {
        const Vector6 load = size * weights[k] * exact_.load((e + abscissae[k]) * size, t);
        loads.col(e) += (1 - abscissae[k]) * load;
        loads.col(e + 1) += abscissae[k] * load;
      }
    }
    return loads;
  }

  ManufacturedBeam exact_;
  int elements_;
  std::map<double, Loads> known_;
};

void add_loads(MechanismBuilder& b, const BeamBodyIds& ids, const std::shared_ptr<NodalLoads>& loads) {
  for (std::size_t node = 0; node < ids.frames.size(); ++node) {
    LoadSpec load{.name = std::to_string(node), .frame = ids.frames[node], .axes = LoadAxes::ground, .terms = {}};
    for (int i = 0; i < 6; ++i) {
      const auto column = static_cast<Eigen::Index>(node);
      const auto value = [loads, i, column](double t) { return loads->at(t)(i, column); };
      const auto unknown = [](double) { return std::nan(""); };  // its slopes are not used
      load.terms.push_back({.direction = Vector6::Unit(i),
                            .magnitude = test::time_function(value, unknown, unknown),
                            .variables = {{.kind = Variable::Kind::time, .coordinate = {}}}});
    }
    b.add_load(load);
  }
}

/// Motion of a section.
struct Motion {
  Pose X;
  Vector3 v, omega;  ///< ground's axes
};
Motion motion_of(const test::ManufacturedLine& line, double x, double t) {
  using V = test::Varied<double>;
  const Matrix3 R = test::matrix(line.R(x, t));
  const Matrix3 R_rate = test::matrix(test::slope_of([&](const V& s) { return line.R(V(x), s); }, t));
  const Matrix3 omega = R_rate * R.transpose();
  return {{R, test::vector(line.r(x, t))},
          test::vector(test::slope_of([&](const V& s) { return line.r(V(x), s); }, t)),
          {omega(2, 1), omega(0, 2), omega(1, 0)}};
}

/// Returns the errors of the beam at the end.
/// @param is_loose  its nodes are counted from ground, not from the first
test::Errors errors_of(const std::shared_ptr<NodalLoads>& loads, int steps, bool is_loose) {
  const ManufacturedBeam& exact = loads->exact();
  const int elements = loads->elements();
  const test::StraightBeam beam{.length = exact.length,
                                .elements = elements,
                                .stiffness = exact.stiffness,
                                .mass_per_length = exact.mass_per_length,
                                .inertia_per_length = test::vector(exact.inertia_per_length),
                                .damping = exact.damping};
  MechanismBuilder b;
  if (is_loose) b.loosen_beams();
  const BeamBodyIds ids = beam.add_to(b);
  const Motion root = motion_of(exact.line, 0, 0);
  const Vector3 &r = root.X.r, &v = root.v, &omega = root.omega;
  b.add_joint({.name = "free",
               .type = JointType::free,
               .inboard = b.frame_of(b.ground()),
               .outboard = ids.frames[0],
               .initial = {r[0], r[1], r[2], 0, 0, 0},
               .initial_rate = {v[0], v[1], v[2], omega[0], omega[1], omega[2]}});
  add_loads(b, ids, loads);
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  constexpr double end = 0.8;
  test::run(*m, state, end, steps);

  test::Errors errors;
  const double size = exact.length / elements;
  for (int node = 0; node <= elements; ++node) {
    const double x = node * size;
    const FrameMotion observation = m->frame_motion(state, ids.frames[static_cast<std::size_t>(node)]);
    const Motion wanted = motion_of(exact.line, x, end);
    const Eigen::Quaterniond rotation(observation.X_WF.R * wanted.X.R.transpose());
    errors.add("position [m]", (observation.X_WF.r - wanted.X.r).norm());
    errors.add("rotation [rad]", rotation_log(rotation).norm());
    errors.add("velocity [m/s]", (observation.v - wanted.v).norm());
    errors.add("angular velocity [rad/s]", (observation.omega - wanted.omega).norm());
  }
  const Observation all = m->observe(state);
  Eigen::Vector2d energy = Eigen::Vector2d::Zero();
  for (int e = 0; e < elements; ++e) {
    const ElasticObservation& segment = all.elastics[static_cast<std::size_t>(e)];
    const BeamSegment element({.element = {.length = size, .stiffness = exact.stiffness},
                               .mass_per_length = exact.mass_per_length,
                               .inertia_per_length = test::vector(exact.inertia_per_length),
                               .damping = exact.damping});
    const fem::BeamMotionResponse observation = element.section(segment.motion);
    const Vector6 missing =
        observation.elastic + observation.viscous - ManufacturedBeam::six(exact.section_forces((e + 0.5) * size, end));
    errors.add("N [N]", missing.head<3>().norm());
    errors.add("M [N m]", missing.tail<3>().norm());
    energy += Eigen::Vector2d(segment.energy.kinetic, segment.energy.strain);
  }
  for (int k = 0; k < 20; ++k)
    for (std::size_t i = 0; i < abscissae.size(); ++i)
      energy -= exact.length / 20 * weights[i] * exact.energies((k + abscissae[i]) * exact.length / 20, end);
  errors.add("kinetic energy [J]", energy[0]);
  errors.add("strain energy [J]", energy[1]);
  return errors;
}

TEST_CASE("ManufacturedBeam_IsMetWithOrderTwoInSpaceAndTime") {
  // Elements and steps are halved together, with nodes counted from ground and from the first.
  std::vector<test::Errors> loose, counted;
  for (const int n : {1, 2, 4}) {
    const auto loads = std::make_shared<NodalLoads>(ManufacturedBeam{}, 4 * n);
    loose.push_back(errors_of(loads, 20 * n, true));
    counted.push_back(errors_of(loads, 20 * n, false));
  }
  test::check_orders(loose, 2, 0.1);
  test::check_orders(counted, 2, 0.1);
}

TEST_CASE("ManufacturedBeamOfUniformStrain_IsMetWithOrderTwoInTime") {
  // Stretched and sheared alike all along, an element has the motion exactly: what is left is the steps' error.
  std::vector<test::Errors> on;
  for (const int n : {1, 2, 4})
    on.push_back(errors_of(std::make_shared<NodalLoads>(ManufacturedBeam{.line = {.bend = 0}}, 2), 40 * n, true));
  test::check_orders(on, 2, 0.1);
}

}  // namespace manufactured_beam_test
}  // namespace hersey::mbd
