#include "kinds/plane_slider/slider_kinematics.h"

#include <array>
#include <cmath>
#include <utility>

#include "gap/varied.h"
#include "hersey/core/contract.h"

namespace hersey::bearing {

bool faces_pad(const Pose& X_AB) { return std::abs(X_AB.R(0, 0)) > 0.1; }

SliderKinematics slider_kinematics(const Pose& X_AB, const Vector6& V_AB_A) {
  HERSEY_REQUIRE(faces_pad(X_AB), "the runner's x-axis must point along the pad's");
  const Vector3 omega = V_AB_A.head<3>(), velocity = V_AB_A.tail<3>();
  const VariedVector r = varied_origin(X_AB.r), n = varied_direction(X_AB.R.col(0));
  const VariedVector r_rate{velocity + omega.cross(r.value), skew(omega) * r.d};
  const VariedVector n_rate{omega.cross(n.value), skew(omega) * n.d};

  // The plane through r at right angles to n (slider.2), and its rates (slider.3) along the relative motion: rates and
  // twists share one linear map.
  const Varied zero{0, Eigen::Matrix<double, 1, 6>::Zero()};
  const Varied t_y = zero - n[1] / n[0], t_z = zero - n[2] / n[0];
  const Varied e = r[0] - t_y * r[1] - t_z * r[2];
  const Varied t_y_rate = zero - (n_rate[1] + t_y * n_rate[0]) / n[0];
  const Varied t_z_rate = zero - (n_rate[2] + t_z * n_rate[0]) / n[0];
  const Varied e_rate = r_rate[0] - t_y_rate * r[1] - t_y * r_rate[1] - t_z_rate * r[2] - t_z * r_rate[2];

  SliderKinematics k;
  const std::array<std::pair<Varied, Varied>, 3> coordinates{{{e, e_rate}, {t_y, t_y_rate}, {t_z, t_z_rate}}};
  for (int i = 0; i < 3; ++i) {
    const auto& [position, rate] = coordinates[static_cast<std::size_t>(i)];
    k.value[kSliderE + i] = position.value, k.d_dX.row(kSliderE + i) = position.d;
    k.value[kSliderERate + i] = rate.value, k.d_dX.row(kSliderERate + i) = rate.d;
    k.d_dV.row(kSliderERate + i) = position.d;
  }
  k.value[kSliderSpeed] = velocity.y(), k.d_dV(kSliderSpeed, 4) = 1;
  k.value[kSliderSideSpeed] = velocity.z(), k.d_dV(kSliderSideSpeed, 5) = 1;
  return k;
}

}  // namespace hersey::bearing
