#include "observation/power_balance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hersey::run {
namespace {

double sum(const std::vector<double>& powers) { return std::accumulate(powers.begin(), powers.end(), 0.0); }

}  // namespace

double PowerBalance::largest() const {
  return std::max({std::abs(drives), std::abs(loads), std::abs(gravity), std::abs(springs), std::abs(contacts),
                   std::abs(bearings), std::abs(elastic), std::abs(kinetic_rate)});
}

PowerBalance power_balance(const mbd::MechanismSpec& spec, const mbd::Observation& observation,
                           const std::vector<ForceKind>& kinds) {
  PowerBalance balance;
  balance.drives = sum(observation.drive_powers);
  balance.loads = sum(observation.load_powers);
  balance.springs = sum(observation.spring_powers);
  for (std::size_t i = 0; i < observation.coordinate_force_powers.size(); ++i)
    (spec.coordinate_forces[i].force->is_source() ? balance.drives : balance.springs) +=
        observation.coordinate_force_powers[i];
  for (std::size_t i = 0; i < observation.force_powers.size(); ++i) {
    double& group = kinds[i] == ForceKind::bearing   ? balance.bearings
                    : kinds[i] == ForceKind::contact ? balance.contacts
                                                     : balance.springs;
    group += observation.force_powers[i];
  }
  for (std::size_t i = 1; i < spec.bodies.size(); ++i) {
    const mbd::BodySpec& body = spec.bodies[i];
    const mbd::FrameMotion& motion = observation.bodies[i];
    const Vector3 c = motion.X_WF.R * body.com;
    const Vector3 v = motion.v + motion.omega.cross(c);
    const Vector3 a = motion.a + motion.alpha.cross(c) + motion.omega.cross(motion.omega.cross(c));
    const Matrix3 inertia = motion.X_WF.R * body.inertia * motion.X_WF.R.transpose();
    balance.gravity += body.mass * spec.gravity.dot(v);
    // The gyroscopic torque omega x (I omega) does no work.
    balance.kinetic_rate += body.mass * v.dot(a) + motion.omega.dot(inertia * motion.alpha);
  }
  for (const mbd::ElasticObservation& body : observation.elastics) {
    balance.gravity += body.energy.gravity;
    for (const mbd::ElasticLoad& load : body.energy.loads) balance.loads += load.power;
    balance.elastic -= body.energy.strain_rate + body.energy.dissipation;
    balance.kinetic_rate += body.energy.kinetic_rate;
  }
  return balance;
}

}  // namespace hersey::run
