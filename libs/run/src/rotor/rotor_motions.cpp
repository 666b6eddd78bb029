#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/run/rotor.h"

namespace hersey::run {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Complex = std::complex<double>;

constexpr Complex kI(0, 1);
// Of the largest entry of a shape: less is round-off, in motions of other bodies.
constexpr double kMoves = 1e-6;
constexpr double kPlanar = 0.02;      // minor over major axis: an orbit that nobody would call a circle or an ellipse
constexpr double kOscillates = 1e-6;  // damped over natural frequency
constexpr double kDiverges = 1e-4;    // 1/s over the speed [rad/s]: less is a free motion with its round-off

Orbit orbit_of(const MatrixXd& across, const VectorXcd& y) {
  const Eigen::Vector2cd r = across * y;
  return {r[0], r[1]};
}

/// Size of a motion that includes rotations: of the axis where it is the largest.
double reach_of(const RotorState& rotor) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const RotorStation& station : rotor.stations)
    low = std::min(low, station.along), high = std::max(high, station.along);
  return high > low ? high - low : 1;
}

/// Sense in which the axis circles in a motion of the free coordinates, beside that in which its shaft rotates.
Whirl whirl_of(const RotorState& rotor, const std::vector<Orbit>& orbits) {
  double forward = 0, backward = 0, size = 0;
  for (const Orbit& orbit : orbits) size = std::max(size, orbit.major());
  for (std::size_t s = 0; s < orbits.size(); ++s) {
    const Orbit& orbit = orbits[s];
    if (orbit.major() < 1e-3 * size) continue;  // near a node the sense means nothing
    const double ratio = orbit.minor(rotor.stations[s].sense) / orbit.major();
    forward = std::max(forward, ratio), backward = std::max(backward, -ratio);
  }
  if (forward < kPlanar && backward < kPlanar) return Whirl::planar;
  if (backward < kPlanar) return Whirl::forward;
  return forward < kPlanar ? Whirl::backward : Whirl::mixed;
}

std::vector<Orbit> orbits_of(const RotorState& rotor, const VectorXcd& y) {
  std::vector<Orbit> orbits;
  for (const RotorStation& station : rotor.stations) orbits.push_back(orbit_of(station.across, y));
  return orbits;
}

/// True if a motion is one of the axis, which a sagging shaft's motions along the axis and torsion displace a little.
bool moves_axis(const RotorState& rotor, const VectorXcd& y, const std::vector<Orbit>& orbits) {
  constexpr double kAside = 0.05;  // of the displacement along the axis and of torsion times the shaft's length
  double size = 0, other = 0;
  for (const Orbit& orbit : orbits) size = std::max(size, orbit.major());
  const double reach = reach_of(rotor);
  for (const RotorStation& station : rotor.stations) {
    const Eigen::Vector2cd moved = station.along_and_about * y;
    other = std::max({other, std::abs(moved[0]), reach * std::abs(moved[1])});
  }
  // The largest entry of a shape is an angle or a length.
  return size > kAside * other && size > kMoves * std::min(1.0, reach) * y.cwiseAbs().maxCoeff();
}

/// A motion exp(value t), or one whose speed follows from `value`.
struct SmallMotion {
  Complex value;
  VectorXcd y;
};

/// Replaces motions of one value, of which any mixture is one, by those that run forward most and least: a shaft that
/// whirls forward and backward alike shows both.
void part_by_whirl(const RotorState& rotor, std::vector<SmallMotion>& motions) {
  constexpr double kOne = 1e-7;  // relative difference of values that round-off may have parted
  const auto points = static_cast<Index>(rotor.stations.size());
  for (std::size_t first = 0; first < motions.size();) {
    std::size_t last = first + 1;
    while (last < motions.size() &&
           std::abs(motions[last].value - motions[first].value) < kOne * std::abs(motions[first].value))
      ++last;
    const auto count = static_cast<Index>(last - first);
    MatrixXcd Y(motions[first].y.size(), count), forward(points, count), backward(points, count);
    for (Index k = 0; k < count; ++k) {
      Y.col(k) = motions[first + static_cast<std::size_t>(k)].y;
      for (Index p = 0; p < points; ++p) {
        const RotorStation& station = rotor.stations[static_cast<std::size_t>(p)];
        const Orbit orbit = orbit_of(station.across, Y.col(k));
        forward(p, k) = orbit.forward(station.sense), backward(p, k) = orbit.backward(station.sense);
      }
    }
    const MatrixXcd of_forward = forward.adjoint() * forward, of_both = of_forward + backward.adjoint() * backward;
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXcd> eigen(of_forward, of_both);
    if (count > 1 && eigen.info() == Eigen::Success && eigen.eigenvectors().allFinite()) {
      const MatrixXcd parted = Y * eigen.eigenvectors();
      for (Index k = 0; k < count; ++k) motions[first + static_cast<std::size_t>(k)].y = parted.col(k);
    }
    first = last;
  }
}

}  // namespace

Complex Orbit::forward(int sense) const { return 0.5 * (x + static_cast<double>(sense) * kI * y); }
Complex Orbit::backward(int sense) const { return 0.5 * (x - static_cast<double>(sense) * kI * y); }
double Orbit::major() const { return std::abs(forward(1)) + std::abs(backward(1)); }
double Orbit::minor(int sense) const { return std::abs(forward(sense)) - std::abs(backward(sense)); }

std::vector<WhirlMode> whirl_modes(const RotorState& rotor) {
  solver::Linearisation linear;
  linear.Z.setIdentity(rotor.M.rows(), rotor.M.rows());
  linear.M = rotor.M, linear.C = rotor.C, linear.K = rotor.K;
  std::vector<solver::Mode> all = solver::find_modes(linear).modes;
  std::vector<SmallMotion> motions;
  const auto oscillates = [](const solver::Mode& mode) { return mode.damped_frequency > kOscillates * mode.frequency; };
  const auto diverges = [&](const solver::Mode& mode) {
    return !oscillates(mode) && mode.s.real() > kDiverges * rotor.speed &&
           moves_axis(rotor, mode.shape, orbits_of(rotor, mode.shape));
  };
  std::erase_if(all, [&](const solver::Mode& mode) { return !oscillates(mode) && !diverges(mode); });
  for (const solver::Mode& mode : all)
    if (oscillates(mode) && moves_axis(rotor, mode.shape, orbits_of(rotor, mode.shape)))
      motions.push_back({mode.s, mode.shape});
  part_by_whirl(rotor, motions);
  std::vector<WhirlMode> modes;
  auto parted = motions.begin();
  for (const solver::Mode& mode : all) {
    WhirlMode found;
    found.mode = mode;
    const bool moves = oscillates(mode) && moves_axis(rotor, mode.shape, orbits_of(rotor, mode.shape));
    if (moves) found.mode.shape = parted++->y;
    const double zeta = mode.damping_ratio;
    found.log_decrement = 2 * std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta);
    found.orbits = orbits_of(rotor, found.mode.shape);
    if (moves) found.whirl = whirl_of(rotor, found.orbits);
    if (!oscillates(mode)) {
      found.whirl = Whirl::diverging;
      found.log_decrement = -std::numeric_limits<double>::infinity();
    }
    double size = 0;
    for (const Orbit& orbit : found.orbits) size = std::max(size, orbit.major());
    if (size > 0)
      for (Orbit& orbit : found.orbits) orbit.x /= size, orbit.y /= size;
    modes.push_back(std::move(found));
  }
  std::sort(modes.begin(), modes.end(),
            [](const WhirlMode& a, const WhirlMode& b) { return a.mode.damped_frequency < b.mode.damped_frequency; });
  return modes;
}

RotorState with_cross_coupling(RotorState rotor, const CrossCoupling& coupling) {
  HERSEY_REQUIRE(coupling.station < rotor.stations.size(), "the station exists");
  const MatrixXd& across = rotor.stations[coupling.station].across;
  const double Q = rotor.stations[coupling.station].sense * coupling.Q;
  // A shaft displaced along x is pushed along y, one displaced along y against x: on in its own sense.
  rotor.K -= across.row(1).transpose() * (Q * across.row(0)) - across.row(0).transpose() * (Q * across.row(1));
  return rotor;
}

UnbalanceResponse unbalance_response(const RotorState& rotor) {
  const double omega = rotor.speed;
  const MatrixXcd dynamic = rotor.K - omega * omega * rotor.M + kI * omega * rotor.C;
  const VectorXcd y = dynamic.partialPivLu().solve(rotor.unbalance);
  UnbalanceResponse response;
  response.stations = orbits_of(rotor, y);
  for (const RotorBearing& bearing : rotor.bearings) {
    const Eigen::Matrix<Complex, 6, 6> D = bearing.K + kI * omega * bearing.C - omega * omega * bearing.M;
    const Eigen::Matrix<Complex, 6, 1> W = -(D * (bearing.twist * y));
    const Eigen::Vector2cd f = bearing.across * W.tail<3>();
    response.bearings.push_back({f[0], f[1]});
  }
  return response;
}

std::vector<CriticalSpeed> undamped_critical_speeds(const RotorState& rotor, double stiffness) {
  MatrixXd K = rotor.K, C = rotor.C, M = rotor.M;
  std::vector<std::size_t> carried;
  for (const RotorBearing& bearing : rotor.bearings) {
    K -= bearing.twist.transpose() * bearing.K * bearing.twist;
    C -= bearing.twist.transpose() * bearing.C * bearing.twist;
    M -= bearing.twist.transpose() * bearing.M * bearing.twist;
    if (std::find(carried.begin(), carried.end(), bearing.station) != carried.end()) continue;
    carried.push_back(bearing.station);
    const MatrixXd& across = rotor.stations[bearing.station].across;
    K += stiffness * across.transpose() * across;
  }
  const MatrixXd stiff = (K + K.transpose()) / 2, mass = (M + M.transpose()) / 2;
  const MatrixXd gyroscopic = (C - C.transpose()) / (2 * rotor.speed);
  // (rotors.12), inverted: slow motions are not lost in the round-off of fast ones. The shift keeps motions without
  // stiffness apart, such as one along the axis.
  const MatrixXcd inertia = mass - kI * gyroscopic;
  const double shift = 1e-4 * rotor.speed * rotor.speed;
  const Eigen::PartialPivLU<MatrixXcd> lu(stiff + shift * inertia);
  const Eigen::ComplexEigenSolver<MatrixXcd> eigen(lu.solve(inertia));
  std::vector<SmallMotion> motions;
  for (Index i = 0; i < stiff.rows(); ++i) {
    const Complex nu = eigen.eigenvalues()[i];
    if (!(nu.real() > 0) || std::abs(nu.imag()) > 1e-6 * nu.real()) continue;  // no whirl once a revolution
    const double squared = 1 / nu.real() - shift;
    if (squared <= 1e-2 * shift) continue;  // without stiffness
    const VectorXcd y = eigen.eigenvectors().col(i);
    if (moves_axis(rotor, y, orbits_of(rotor, y))) motions.push_back({std::sqrt(squared), y});
  }
  std::sort(motions.begin(), motions.end(),
            [](const SmallMotion& a, const SmallMotion& b) { return a.value.real() < b.value.real(); });
  part_by_whirl(rotor, motions);
  std::vector<CriticalSpeed> found;
  for (const SmallMotion& motion : motions)
    found.push_back({motion.value.real(), whirl_of(rotor, orbits_of(rotor, motion.y))});
  return found;
}

}  // namespace hersey::run
