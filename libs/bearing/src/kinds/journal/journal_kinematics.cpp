#include "hersey/bearing/journal_kinematics.h"

#include <algorithm>
#include <cmath>

#include "gap/varied.h"
#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace {

// The axis in the mid-plane frame: slope t = d_xy/d_z and piercing point e = r_xy - t r_z (bearing.1). The same
// expressions, differentiated along V, give the rates (bearing.3); hence rates and twists share one linear map.
struct Axis {
  Varied e, t;
};
Axis pierce(const VariedVector& r, const VariedVector& d, int i) {
  const Varied t = d[i] / d[2];
  return {r[i] - t * r[2], t};
}
Axis pierce_rate(const VariedVector& r, const VariedVector& d, const VariedVector& r_rate, const VariedVector& d_rate,
                 int i) {
  const Varied t = d[i] / d[2];
  const Varied t_rate = (d_rate[i] - t * d_rate[2]) / d[2];
  return {r_rate[i] - t_rate * r[2] - t * r_rate[2], t_rate};
}

// Angle opposite to the eccentricity: the widest gap at z = 0 (bearing.5). Without eccentricity it has no direction.
void widest_gap(double e_floor, JournalKinematics& k) {
  const double ex = k.value[kEx], ey = k.value[kEy], e2 = ex * ex + ey * ey;
  if (e2 == 0) return;
  k.value[kSupplyAngle] = std::atan2(-ey, -ex);
  if (e2 < e_floor * e_floor) return;
  k.d_dX.row(kSupplyAngle) = (ex * k.d_dX.row(kEy) - ey * k.d_dX.row(kEx)) / e2;
}

// Angle of the journal's x-axis, seen along the bearing's axis.
void rotation(const VariedVector& x_axis, JournalKinematics& k) {
  const Varied x = x_axis[0], y = x_axis[1];
  k.value[kRotation] = std::atan2(y.value, x.value);
  k.d_dX.row(kRotation) = (x.value * y.d - y.value * x.d) / (x.value * x.value + y.value * y.value);
}

}  // namespace

bool is_aligned(const Pose& X_AB) { return std::abs(X_AB.R(2, 2)) > 0.1; }

JournalKinematics journal_kinematics(const Pose& X_AB, const Vector6& V_AB_A, double R, double e_floor) {
  const Vector3 omega = V_AB_A.head<3>(), velocity = V_AB_A.tail<3>();
  const VariedVector r = varied_origin(X_AB.r), d = varied_direction(X_AB.R.col(2));
  HERSEY_REQUIRE(is_aligned(X_AB), "the journal's axis must point along the bearing's");

  const VariedVector r_rate{velocity + omega.cross(r.value), skew(omega) * r.d};
  const VariedVector d_rate{omega.cross(d.value), skew(omega) * d.d};

  JournalKinematics k;
  for (int i = 0; i < 2; ++i) {
    const Axis axis = pierce(r, d, i), rate = pierce_rate(r, d, r_rate, d_rate, i);
    const std::array<std::pair<int, Varied>, 4> entries{
        {{kEx + i, axis.e}, {kTx + i, axis.t}, {kExRate + i, rate.e}, {kTxRate + i, rate.t}}};
    for (const auto& [row, quantity] : entries) {
      k.value[row] = quantity.value;
      k.d_dX.row(row) = quantity.d;
    }
    k.d_dV.row(kExRate + i) = axis.e.d;
    k.d_dV.row(kTxRate + i) = axis.t.d;
  }

  // Speeds of the journal's surface past the shell's (bearing.4).
  k.value[kJournalSpeed] = R * omega.z();
  k.d_dV(kJournalSpeed, 2) = R;

  // The axis point in the mid-plane moves along z with v_z + (omega x e)_z.
  k.value[kAxialSpeed] = velocity.z() + omega.x() * k.value[kEy] - omega.y() * k.value[kEx];
  k.d_dV.row(kAxialSpeed) << k.value[kEy], -k.value[kEx], 0, 0, 0, 1;
  k.d_dX.row(kAxialSpeed) = omega.x() * k.d_dX.row(kEy) - omega.y() * k.d_dX.row(kEx);

  widest_gap(e_floor, k);
  rotation(varied_direction(X_AB.R.col(0)), k);
  return k;
}

}  // namespace hersey::bearing
