#include "hersey/bearing/steady_derivative.h"

#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace {

// Positions (e_x, e_y, t_x, t_y) and their rates: Parameter kEx to kTyRate.
constexpr int kDirections = 8;

// A tangent leaves the square of a small step of the residual that it takes away; more than this share of it, and the
// film has no answer to the parameter that is its own, as one without supply, whose fill level is open.
constexpr double kLeft = 0.05;

// Below this eccentricity over the clearance no gap is the widest.
constexpr double kCentred = 1e-6;

/// Rows of a wrench that work on (e_x, e_y, t_x, t_y).
template <class Wrench>
Eigen::Matrix<double, 4, Wrench::ColsAtCompileTime> generalised(const Wrench& wrench) {
  Eigen::Matrix<double, 4, Wrench::ColsAtCompileTime> rows(4, wrench.cols());
  rows << wrench.row(3), wrench.row(4), wrench.row(1), -wrench.row(0);
  return rows;
}

/// The film of `at` with the journal at `e`, linearised about `u`.
film::FilmDomain linearise(const BearingBeside& at, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                           film::Reynolds& film) {
  return film.linearise(steady_surfaces(at.model, at.point, e), film::FilmHistory{}, u);
}

}  // namespace

SteadyDerivative::SteadyDerivative(const film::FilmModel& model, const SteadyState& state)
    : model_(model), state_(state), film_(model_) {
  HERSEY_REQUIRE(is_of_film_alone(state), "rigid surfaces and one temperature that is given");
  const film::FilmDomain domain = linearise({model_, state_.point}, state_.e, state_.u, film_);
  HERSEY_REQUIRE(domain.is_inside(), "a state that has been solved for");
  answers_.resize(film_.size(), kDirections);
  Eigen::Matrix<double, 6, kDirections> wrench;
  const std::vector<film::MotionDirection> wanted = directions(model_, state_.e);
  for (int k = 0; k < kDirections; ++k) {
    Eigen::VectorXd residual;
    Vector6 partial;
    film_.partial(wanted[static_cast<std::size_t>(k)], residual, partial);
    answers_.col(k) = -residual;
    wrench.col(k) = partial;
  }
  residual_by_e_ = -answers_.leftCols<2>();
  film_.solve(answers_);
  adjoints_ = -generalised(film_.wrench_by_u()).transpose();
  film_.solve_transposed(adjoints_);
  force_by_e_ = (wrench + film_.wrench_by_u() * answers_).block<2, 2>(3, 0);
}

bool SteadyDerivative::is_of_film_alone(const SteadyState& state) {
  return !state.heat && !state.effective && state.s.size() == 0 && state.thermal_shape.size() == 0;
}

std::vector<film::MotionDirection> SteadyDerivative::directions(const film::FilmModel& model,
                                                                const Eigen::Vector2d& e) const {
  std::vector<film::MotionDirection> result;
  result.reserve(kDirections);
  for (int k = 0; k < kDirections; ++k) result.push_back(surface_direction(model, k));
  if (model.supply.kind == film::SupplyKind::widest_gap && e.norm() > kCentred * model.c) {
    result[kEx].phi_supply = -e.y() / e.squaredNorm();
    result[kEy].phi_supply = e.x() / e.squaredNorm();
  }
  return result;
}

// (bearing.35): what the parameter does to residual and force at the film and position there are, and what these do
// then so that both vanish again.
std::optional<SteadyDerivative::Change> SteadyDerivative::change(const std::array<BearingBeside, 2>& sides) {
  Eigen::MatrixXd residual = Eigen::MatrixXd::Zero(film_.size(), 1);
  Vector6 wrench = Vector6::Zero();
  for (const double sign : {-1.0, 1.0}) {
    const BearingBeside& side = sides[sign > 0 ? 1 : 0];
    film::Reynolds film(side.model);
    if (!linearise(side, state_.e, state_.u, film).is_inside()) return std::nullopt;
    residual -= 0.5 * sign * film.residual();
    wrench += 0.5 * sign * film.wrench_on_shell();
  }
  Change change{0.5 * (sides[1].point.e - sides[0].point.e), residual, residual};
  film_.solve(residual);
  change.u = residual;
  if (state_.point.load) {
    const Eigen::Vector2d load = 0.5 * (*sides[1].point.load - *sides[0].point.load);
    const Vector6 force = wrench + film_.wrench_gradient(residual.col(0));
    change.e = force_by_e_.fullPivLu().solve(load - force.segment<2>(3));
  }
  change.u += answers_.leftCols<2>() * change.e;
  change.residual -= residual_by_e_ * change.e;
  return change;
}

// (bearing.37), whose change with film and adjoints vanishes: both stay as they are.
DynamicCoefficients SteadyDerivative::coefficients(film::Reynolds& film, const Eigen::Vector2d& e) const {
  const std::vector<film::MotionDirection> wanted = directions(film.model(), e);
  const auto by_u = generalised(film.wrench_by_u());
  DynamicCoefficients result;
  for (int k = 0; k < kDirections; ++k) {
    Eigen::VectorXd residual;
    Vector6 partial;
    film.partial(wanted[static_cast<std::size_t>(k)], residual, partial);
    residual += film.jacobian_product(answers_.col(k));
    const Eigen::Vector4d column = generalised(partial) + by_u * answers_.col(k) + adjoints_.transpose() * residual;
    (k < 4 ? result.stiffness : result.damping).col(k % 4) = column;
  }
  return result;
}

std::optional<std::array<SteadyState, 2>> SteadyDerivative::beside(const std::array<BearingBeside, 2>& sides) {
  const std::optional<Change> moved = change(sides);
  if (!moved) return std::nullopt;
  std::array<SteadyState, 2> states{state_, state_};
  for (const double sign : {-1.0, 1.0}) {
    const BearingBeside& side = sides[sign > 0 ? 1 : 0];
    SteadyState& state = states[sign > 0 ? 1 : 0];
    state.point = side.point;
    state.tilt = side.point.tilt;
    state.e += sign * moved->e;
    state.u += sign * moved->u;
    film::Reynolds film(side.model);
    if (!linearise(side, state.e, state.u, film).is_inside()) return std::nullopt;
    if ((film.residual() - film_.residual()).norm() > kLeft * moved->residual.norm()) return std::nullopt;
    state.film = film::observe_film(side.model, steady_surfaces(side.model, side.point, state.e), film::FilmHistory{},
                                    state.e, state.u, state.tilt);
    state.load = state.film.wrench_on_shell.segment<2>(3);
    state.coefficients = coefficients(film, state.e);
  }
  return states;
}

}  // namespace hersey::bearing
