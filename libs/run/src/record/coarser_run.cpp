#include "record/coarser_run.h"

#include <cmath>

namespace hersey::run {
namespace {

constexpr double kLonger = 2;              // times the steps
constexpr double kOrderOfLocalErrors = 8;  // 2^3

}  // namespace

model::Model with_longer_steps(model::Model model) {
  model::Simulation& plan = model.simulation;
  plan.step *= kLonger;
  if (plan.error_control) {
    plan.error_control->tolerance *= kOrderOfLocalErrors;
    plan.error_control->largest *= kLonger;
  }
  model.output.meshes_at.clear();  // files besides the results
  return model;
}

StepErrors step_errors(const BearingSummary& fine, const BearingSummary& coarse) {
  const auto error = [](double value, double longer) { return std::abs(value - longer) / (kLonger * kLonger - 1); };
  return {.moft = error(fine.moft, coarse.moft),
          .pofp = error(fine.pofp, coarse.pofp),
          .max_force = error(fine.max_force, coarse.max_force),
          .mean_power = error(fine.mean_power, coarse.mean_power),
          .mean_flow = error(fine.mean_flow, coarse.mean_flow)};
}

}  // namespace hersey::run
