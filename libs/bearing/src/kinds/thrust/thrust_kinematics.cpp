#include "kinds/thrust/thrust_kinematics.h"

#include <array>
#include <cmath>
#include <utility>

#include "gap/varied.h"
#include "hersey/core/contract.h"

namespace hersey::bearing {

bool faces_stator(const Pose& X_AB) { return std::abs(X_AB.R(2, 2)) > 0.1; }

ThrustKinematics thrust_kinematics(const Pose& X_AB, const Vector6& V_AB_A) {
  HERSEY_REQUIRE(faces_stator(X_AB), "the runner's z-axis must point along the stator's");
  const Vector3 omega = V_AB_A.head<3>(), velocity = V_AB_A.tail<3>();
  const VariedVector r = varied_origin(X_AB.r), n = varied_direction(X_AB.R.col(2));
  const VariedVector r_rate{velocity + omega.cross(r.value), skew(omega) * r.d};
  const VariedVector n_rate{omega.cross(n.value), skew(omega) * n.d};

  // The plane through r at right angles to n (thrust.2), and its rates (thrust.3) along the relative motion: rates and
  // twists share one linear map.
  const Varied a_x = n[0] / n[2], a_y = n[1] / n[2];
  const Varied zeta = r[2] + a_x * r[0] + a_y * r[1];
  const Varied a_x_rate = (n_rate[0] - a_x * n_rate[2]) / n[2];
  const Varied a_y_rate = (n_rate[1] - a_y * n_rate[2]) / n[2];
  const Varied zeta_rate = r_rate[2] + a_x_rate * r[0] + a_x * r_rate[0] + a_y_rate * r[1] + a_y * r_rate[1];

  ThrustKinematics k;
  const std::array<std::pair<Varied, Varied>, 3> coordinates{{{zeta, zeta_rate}, {a_x, a_x_rate}, {a_y, a_y_rate}}};
  for (int i = 0; i < 3; ++i) {
    const auto& [position, rate] = coordinates[static_cast<std::size_t>(i)];
    k.value[kThrustZ + i] = position.value, k.d_dX.row(kThrustZ + i) = position.d;
    k.value[kThrustZRate + i] = rate.value, k.d_dX.row(kThrustZRate + i) = rate.d;
    k.d_dV.row(kThrustZRate + i) = position.d;
  }
  k.value[kThrustSpeed] = omega.z(), k.d_dV(kThrustSpeed, 2) = 1;
  return k;
}

}  // namespace hersey::bearing
