// Forces between two bodies, which may depend on the deformation of the bodies: theory manual, sections on two-body
// forces and on surfaces that deform.
#include <algorithm>

#include "elastic/surface_force.h"
#include "hersey/core/stopwatch.h"
#include "hersey/core/task_pool.h"
#include "hersey/mbd/mechanism.h"
#include "mechanism/mechanism_parts.h"

namespace hersey::mbd {

using Eigen::Index;

void ForceResponse::set_zero(Index amplitudes) {
  W_B_A.setZero();
  summed = arm = 0;
  dW_dX.setZero();
  dW_dV.setZero();
  dW_dA.setZero();
  Q.setZero(amplitudes);
  dW_ds.setZero(6, amplitudes);
  dW_dr.setZero(6, amplitudes);
  dQ_dX.setZero(amplitudes, 6);
  dQ_dV.setZero(amplitudes, 6);
  dQ_ds.setZero(amplitudes, amplitudes);
  dQ_dr.setZero(amplitudes, amplitudes);
}

void MechanismParts::find_deforming_surfaces() {
  deforms_surface.assign(elastics.size(), 0);
  const auto side_of = [&](const std::optional<ElasticId>& id) {
    if (!id) return -1;
    deforms_surface[static_cast<std::size_t>(id->index)] = 1;
    return id->index;
  };
  for (std::size_t i = 0; i < spec.forces.size(); ++i) {
    sides.push_back({side_of(spec.forces[i].surfaces.a), side_of(spec.forces[i].surfaces.b)});
    (spec.forces[i].force->is_costly() ? costly : cheap).push_back(i);
  }
}

/// With the shapes of elastic bodies as last found.
RelativeMotion MechanismParts::relative_motion(std::size_t force, double t) const {
  RelativeMotion relative = motion.relative(tree.forces[force]);
  relative.t = t;
  Index count = 0;
  for (const int side : {sides[force].a, sides[force].b})
    if (side >= 0) count += elastics[static_cast<std::size_t>(side)].shapes().value.size();
  relative.s.resize(count);
  relative.s_rate.resize(count);
  Index at = 0;
  for (const int side : {sides[force].a, sides[force].b}) {
    if (side < 0) continue;
    const ShapeMotion& shapes = elastics[static_cast<std::size_t>(side)].shapes();
    relative.s.segment(at, shapes.value.size()) = shapes.value;
    relative.s_rate.segment(at, shapes.value.size()) = shapes.rate;
    at += shapes.value.size();
  }
  return relative;
}

void MechanismParts::read_elastic_bodies(const solver::State& state) {
  for (std::size_t i = 0; i < elastics.size(); ++i) {
    elastics[i].read(motion, state, {}, true);
    if (deforms_surface[i] != 0) elastics[i].find_shapes();
  }
}

/// Costly ones side by side; each writes to its own response, so that their order does not matter. Given by std::cref,
/// `act` takes nothing from the heap.
void MechanismParts::for_each_force(const std::function<void(std::size_t)>& act) {
  const Stopwatch all(timing.forces);
  const auto timed = [&](std::size_t i) {
    const Stopwatch one(timing.force[i]);
    act(i);
  };
  for (const std::size_t i : cheap) timed(i);
  TaskPool::shared().run(costly.size(), [&](std::size_t c) { timed(costly[c]); });
}

void MechanismParts::evaluate_two_body_forces(const Assembly& assembly, const solver::State& state) {
  const bool want_tangent = assembly.tangent != nullptr;
  for (std::size_t i = 0; i < elastics.size(); ++i) {
    const Stopwatch one(timing.elastic[i]);
    if (deforms_surface[i] != 0) elastics[i].find_shapes(assembly);
  }
  for (std::size_t i = 0; i < spec.forces.size(); ++i) {
    relatives[i] = relative_motion(i, state.t);
    relatives[i].dt = assembly.stage.dt;
  }
  const auto evaluate = [&](std::size_t i) {
    spec.forces[i].force->evaluate(relatives[i], want_tangent, responses[i]);
  };
  follow_shared(assembly, state);
  for_each_force(std::cref(evaluate));
  for (const MechanismSpec::Shared& shared : spec.shared) shared.unknowns->condense(responses);
  hand_out_shape_forces(responses);
}

void MechanismParts::follow_shared(const Assembly& assembly, const solver::State& state) {
  for (std::size_t i = 0; i < spec.shared.size(); ++i) {
    std::vector<double> rates;
    for (const int column : shared_columns[i]) rates.push_back(state.v[column]);
    spec.shared[i].unknowns->follow({state.t, assembly.stage.dt, relatives, rates});
  }
}

void MechanismParts::hand_out_shape_forces(const std::vector<ForceResponse>& of_forces) {
  for (std::size_t i = 0; i < of_forces.size(); ++i) {
    Index at = 0;
    for (const int side : {sides[i].a, sides[i].b}) {
      if (side < 0) continue;
      ElasticAssembly& elastic = elastics[static_cast<std::size_t>(side)];
      const Index count = elastic.shapes().value.size();
      elastic.add_shape_forces(of_forces[i].Q.segment(at, count));
      at += count;
    }
  }
}

void MechanismParts::add_two_body_forces(Assembly& assembly) const {
  for (std::size_t i = 0; i < spec.forces.size(); ++i) {
    add_pair_force(assembly, tree.forces[i], responses[i]);
    if (assembly.tangent == nullptr) continue;
    std::vector<const ShapeColumns*> surfaces;
    for (const int side : {sides[i].a, sides[i].b})
      if (side >= 0) surfaces.push_back(&elastics[static_cast<std::size_t>(side)].shape_columns());
    if (!surfaces.empty()) add_surface_tangent(assembly, tree.forces[i], surfaces, responses[i]);
  }
}

}  // namespace hersey::mbd
