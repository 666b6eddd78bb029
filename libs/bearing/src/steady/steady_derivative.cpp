#include "hersey/bearing/steady_derivative.h"

#include <array>
#include <cstdint>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/clearance.h"
#include "hersey/bearing/steady_surfaces.h"
#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace {

// The positions and rates that coefficients of displacement belong to.
constexpr std::array<int, 4> kDirections{kEx, kEy, kExRate, kEyRate};

// A tangent leaves the square of a small step of the residual that it takes away; more than this fraction of it, and
// the film has no answer to the parameter that is its own, as one without supply, whose fill level is open.
constexpr double kLeft = 0.05;

// Condition of a film whose level is fixed by nothing, from a diagonal shifted by 1e-9 of a conductance (Reynolds::
// linearise); of films that are, some hundreds to ten thousands.
constexpr double kDetermined = 1e6;

// Below this eccentricity over the clearance no gap is the widest.
constexpr double kCentred = 1e-6;

/// Rows of a wrench that are its force across the axis.
template <class Wrench>
auto force_of(const Wrench& wrench) {
  return wrench.template middleRows<2>(3);
}

}  // namespace

SteadyDerivative::SteadyDerivative(const film::FilmModel& model, const SteadyState& state)
    : model_(model), state_(state), film_(model_), surfaces_(model_) {
  HERSEY_REQUIRE(is_of_film_alone(state), "rigid surfaces and one temperature that is given");
  const film::FilmDomain domain =
      film_.linearise(steady_surfaces(surfaces_, model_, state_.point, state_.e), film::FilmHistory{}, state_.u);
  HERSEY_REQUIRE(domain.is_inside(), "a state that has been solved for");
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrench;
  film_.partials(directions(surfaces_, model_, state_.e), answers_, wrench);
  residual_by_e_ = answers_.leftCols<2>();
  answers_ = -answers_;
  film_.solve(answers_);
  adjoints_ = -force_of(film_.forces().wrench_by_u).transpose();
  film_.solve(adjoints_, film::SystemMatrix::transposed);
  force_ = force_of(film_.forces().wrench_on_shell);
  force_by_e_ = force_of(wrench + film_.forces().wrench_by_u * answers_).leftCols<2>();
  is_determined_ = amplification() < kDetermined;
}

// The condition number of the film's equations, from below: a vector whose entries have nothing to do with each other
// has a part in every direction, that of the smallest singular value among them.
double SteadyDerivative::amplification() {
  Eigen::MatrixXd x(model_.grid.size(), 1);
  std::uint32_t state = 1;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    state = 1664525U * state + 1013904223U;
    x(i, 0) = (state >> 31) != 0 ? 1 : -1;
  }
  const double through = film_.jacobian_product(x.col(0)).norm(), size = x.squaredNorm();
  film_.solve(x);
  return x.norm() * through / size;
}

bool SteadyDerivative::is_of_film_alone(const SteadyState& state) {
  return state.kind->has_axis() && !state.heat && !state.effective && state.s.size() == 0 && state.shapes.empty();
}

std::vector<film::MotionDirection> SteadyDerivative::directions(const RigidSurfaces& surfaces,
                                                                const film::FilmModel& model,
                                                                const Eigen::Vector2d& e) {
  std::vector<film::MotionDirection> result;
  result.reserve(kDirections.size());
  for (const int parameter : kDirections) result.push_back(surfaces.direction(parameter));
  if (model.supply.kind == film::SupplyKind::widest_gap && e.norm() > kCentred * clearance(model)) {
    result[0].phi_supply = -e.y() / e.squaredNorm();
    result[1].phi_supply = e.x() / e.squaredNorm();
  }
  return result;
}

// (bearing.35): what the parameter does to residual and force at the film and position there are, and what these do
// then so that both vanish again.
std::optional<SteadyDerivative::Change> SteadyDerivative::change(const BearingBeside& side, RigidSurfaces& surfaces,
                                                                 film::Reynolds& film) {
  const film::SurfaceMotion motion = steady_surfaces(surfaces, side.model, side.point, state_.e);
  if (!film.linearise(motion, film::FilmHistory{}, state_.u).is_inside()) return std::nullopt;
  Eigen::MatrixXd answer = film_.residual().value - film.residual().value;
  Change change{side.point.e - state_.point.e, {}, answer};
  film_.solve(answer);
  change.u = answer;
  if (state_.point.load) {
    const Eigen::Vector2d load = *side.point.load - *state_.point.load,
                          force = force_of(film.forces().wrench_on_shell) - force_ +
                                  force_of(Vector6(film_.forces().wrench_by_u * answer.col(0)));
    change.e = force_by_e_.fullPivLu().solve(load - force);
  }
  change.u += answers_.leftCols<2>() * change.e;
  change.residual -= residual_by_e_ * change.e;
  return change;
}

// (bearing.37), whose change with film and adjoints vanishes: both stay as they are.
void SteadyDerivative::coefficients(const RigidSurfaces& surfaces, film::Reynolds& film, const Eigen::Vector2d& e,
                                    DynamicCoefficients& result) const {
  Eigen::MatrixXd residual;
  Eigen::Matrix<double, 6, Eigen::Dynamic> partial;
  film.partials(directions(surfaces, film.model(), e), residual, partial);
  const auto by_u = force_of(film.forces().wrench_by_u);
  for (Eigen::Index k = 0; k < residual.cols(); ++k) {
    residual.col(k) += film.jacobian_product(answers_.col(k));
    (k < 2 ? result.stiffness : result.damping).col(k % 2).head<2>() =
        force_of(partial.col(k)) + by_u * answers_.col(k) + adjoints_.transpose() * residual.col(k);
  }
}

SteadyState SteadyDerivative::here() {
  SteadyState state = state_;
  state.film = film_.observe(steady_surfaces(surfaces_, model_, state.point, state.e), state.e, state.u, state.tilt);
  state.load = force_;
  coefficients(surfaces_, film_, state.e, state.coefficients);
  return state;
}

std::optional<SteadyState> SteadyDerivative::beside(const BearingBeside& side) {
  if (!is_determined_) return std::nullopt;
  film::Reynolds film(side.model);
  RigidSurfaces surfaces(side.model);
  const std::optional<Change> moved = change(side, surfaces, film);
  if (!moved) return std::nullopt;
  SteadyState state = state_;
  state.point = side.point;
  state.tilt = side.point.tilt;
  state.e += moved->e;
  state.u += moved->u;
  const film::SurfaceMotion motion = steady_surfaces(surfaces, side.model, side.point, state.e);
  if (!film.linearise(motion, film::FilmHistory{}, state.u).is_inside()) return std::nullopt;
  if ((film.residual().value - film_.residual().value).norm() > kLeft * moved->residual.norm()) return std::nullopt;
  state.film = film.observe(motion, state.e, state.u, state.tilt);
  state.load = state.film.wrench_on_shell.segment<2>(3);
  coefficients(surfaces, film, state.e, state.coefficients);
  return state;
}

}  // namespace hersey::bearing
