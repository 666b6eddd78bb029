// Bodies with a displacement of every node: a Newton iteration of a rotating, bending rod against one solution with its
// factored matrix, and a step of it against one of its modal body. Fails where an iteration costs more than 4 solutions
// at 25,000 degrees of freedom, where the modal step is not 50 times faster, or where 96,000 take more than 4 GiB.
// Usage: nodal_body_bench [small]
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>

#include "hersey/core/scalar_function.h"
#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/mbd/nodal_body.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"

namespace {

using namespace hersey;
using Clock = std::chrono::steady_clock;

constexpr double gibibyte = 1024.0 * 1024 * 1024;
constexpr double dt = 5e-5;  // 0.9 degrees at 3000 rpm
constexpr double omega = 314;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<fem::InterfaceFrame> ends_of(const fem::Mesh& mesh) {
  std::vector<fem::InterfaceFrame> frames;
  for (const auto& [set, x] : {std::pair{"x0", 0.0}, std::pair{"x1", 0.3}}) {
    const std::vector<int>& nodes = mesh.node_sets.at(set);
    frames.push_back({set, {x, 0.025, 0.02}, nodes, fem::Connection::average, fem::face_weights(mesh, nodes)});
  }
  return frames;
}

struct Steps {
  double each = 0;        ///< [s]
  double iterations = 0;  ///< Newton's, per step
};

/// Steps of the rod turning about one end and loaded across at the other.
Steps turn(const std::shared_ptr<mbd::ModalBody>& body, int steps) {
  mbd::MechanismBuilder b;
  const mbd::FlexibleBodyIds ids = b.add_flexible_body("rod", {"tip"}, body);
  const mbd::JointId hub = b.add_joint({.name = "hub",
                                        .type = mbd::JointType::revolute,
                                        .inboard = b.frame_of(b.ground()),
                                        .outboard = ids.frames[0],
                                        .initial = {0.0},
                                        .initial_rate = {omega}});
  b.add_drive({.name = "motor",
               .coordinate = {hub, 0},
               .kind = mbd::DriveSpec::Kind::speed,
               .function = std::make_shared<ConstantFunction>(omega)});
  mbd::LoadTerm across;
  across.direction << 0, 0, 0, 0, 5000, 1000;
  across.magnitude = std::make_shared<ConstantFunction>(1.0);
  b.add_load({.name = "push", .frame = ids.frames[1], .axes = mbd::LoadAxes::ground, .terms = {across}});
  const auto m = b.finalise();
  solver::State state = m->initial_state();
  const auto start = solver::initialise(
      *m, state, {.fixed = m->given_coordinates(), .fixed_rates = m->given_rates(), .stiff = m->elastic_coordinates()});
  if (!start.solved()) std::abort();
  solver::GeneralizedAlpha integrator;
  const auto step = [&] {
    const solver::StepSummary summary = integrator.step(*m, state, dt);
    if (!summary.solved()) {
      fmt::print("{}\n", summary.message);
      std::abort();
    }
    return summary.iterations;
  };
  step();  // factorises
  Steps result;
  const auto from = Clock::now();
  for (int i = 0; i < steps; ++i) result.iterations += static_cast<double>(step()) / steps;
  result.each = since(from) / steps;
  return result;
}

/// A rod 300 x 50 x 40 mm of `cells`; false if a target is missed.
bool time_body(const std::array<int, 3>& cells) {
  const fem::ElasticBody mesh =
      fem::assemble(fem::box_mesh(fem::ElementType::tet10, {0.3, 0.05, 0.04}, cells),
                    {fem::isotropic({.youngs_modulus = 2.1e11, .poisson_ratio = 0.3, .density = 7850})});
  const bool small = mesh.size() < 50000;
  fem::ReductionOptions options;
  options.modes = 20;
  const fem::Reduction reduction = fem::reduce(mesh, ends_of(mesh.mesh), options);
  if (!reduction.solved()) std::abort();
  const mbd::RayleighDamping damping{.stiffness = 1e-6};

  // One solution with a matrix as the body's own.
  const fem::FrameSupports supports = fem::frame_supports(mesh.mesh, reduction.body.frames);
  double solve = 1e9;
  {
    fem::ConstrainedStiffness constrained(mesh.K, mesh.m, supports.fixed_dofs, supports.C);
    if (!constrained.factorise(-1 / (0.25 * dt * dt)).solved()) std::abort();
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(mesh.size());
    for (int i = 0; i < 10; ++i) {
      const auto from = Clock::now();
      if (constrained.solve(one).size() == 0) std::abort();
      solve = std::min(solve, since(from));
    }
  }
  const auto nodal = std::make_shared<mbd::NodalBody>(mesh, reduction.body, damping);
  const int steps = small ? 40 : 10;
  const Steps by_nodes = turn(nodal, steps);
  const Steps by_modes = turn(std::make_shared<mbd::ModalBody>(mbd::modal_data(reduction.body, damping)), 400);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double memory = static_cast<double>(usage.ru_maxrss) * 1024 / gibibyte;
  const double iteration = by_nodes.each / by_nodes.iterations, ratio = by_nodes.each / by_modes.each;
  fmt::print("{:>7} {:9.1f} {:9.1f} {:9.2f} {:9.2f} {:9.1f} {:9.3f} {:9.0f} {:9.2f}\n", mesh.size(), 1e3 * solve,
             1e3 * iteration, iteration / solve, by_nodes.iterations, 1e3 * by_nodes.each, 1e3 * by_modes.each, ratio,
             memory);
  bool met = true;
  const auto miss = [&](bool missed, const char* what) {
    if (missed) fmt::print("MISSED: {}\n", what);
    met = met && !missed;
  };
  miss(small && iteration > 4 * solve, "a Newton iteration costs more than 4 solutions");
  miss(small && ratio < 50, "the modal step is not 50 times faster");
  miss(memory > 4, "more than 4 GiB");
  return met;
}

}  // namespace

int main(int argc, char**) {
  fmt::print(
      "A rod of tet10 elements turning at 3000 rpm under a force across, steps of 0.9 degrees; times in ms, memory "
      "of\n");
  fmt::print("the program in GiB. Modal: 20 vibrations.\n\n");
  fmt::print("{:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "unknown", "solve", "iteration", "ratio",
             "its/step", "step", "modal", "ratio", "memory");
  bool met = time_body({28, 6, 5});
  if (argc < 2) met = time_body({44, 9, 9}) && met;
  return met ? EXIT_SUCCESS : EXIT_FAILURE;
}
