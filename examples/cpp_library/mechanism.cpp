// A rod that swings about a pin, let go at 0.1 rad: mechanism, start, time steps.
#include <hersey/mbd/mechanism.h>
#include <hersey/mbd/mechanism_builder.h>
#include <hersey/solver/generalized_alpha.h>
#include <hersey/solver/initialise.h>

#include <cmath>
#include <cstdio>

int main() {
  using namespace hersey;
  const double m = 2, l = 0.25, I = 0.05;  // mass [kg], from the pin to its centre [m], about the centre [kg m^2]
  mbd::MechanismBuilder builder;
  builder.set_gravity({0, -9.81, 0});
  const Matrix3 inertia = I * Matrix3::Identity();
  const mbd::BodyId rod = builder.add_body({.name = "rod", .mass = m, .com = {0, -l, 0}, .inertia = inertia});
  builder.add_joint({.name = "pin",
                     .type = mbd::JointType::revolute,
                     .inboard = builder.frame_of(mbd::MechanismBuilder::ground()),
                     .outboard = builder.frame_of(rod),
                     .initial = {0.1}});
  const auto mechanism = builder.finalise();
  solver::State state = mechanism->initial_state();
  const auto start = solver::initialise(*mechanism, state, {.fixed = mechanism->given_coordinates()});
  if (!start.solved()) return std::fprintf(stderr, "%s\n", start.message.c_str()), 1;
  solver::GeneralizedAlpha integrator;
  const double period = 2 * M_PI * std::sqrt((I + m * l * l) / (m * 9.81 * l)), dt = period / 400;
  for (int k = 0; k < 400; ++k) {
    const solver::StepSummary step = integrator.step(*mechanism, state, dt);
    if (!step.solved()) return std::fprintf(stderr, "%s\n", step.message.c_str()), 1;
  }
  std::printf("angle after one period of small swings: %.4f rad\n", state.q[0]);
}
