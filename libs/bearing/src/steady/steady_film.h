#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "gap/deforming_surfaces.h"
#include "hersey/bearing/operating_point.h"
#include "hersey/bearing/shapes_at_rest.h"
#include "hersey/bearing/steady_coordinates.h"
#include "hersey/bearing/surface_flexibility.h"
#include "hersey/film/film_solver.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// A steady film and the surfaces it deforms: unknowns x = [u; s], u the film's and s the amplitudes of both bodies'
/// shapes, shell first, which obey
///
///     r_f(u, g(s)) = 0,    r_s = s_0 + C P(u, s) - s = 0,                                       (bearing.26)
///
/// P = [Q; W] what the film puts on the shapes and on the shell. Without surfaces that deform x = u and the film is
/// that of `film::solve_film`.
class SteadyFilm {
 public:
  /// Keeps references to `model` and `point`.
  SteadyFilm(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options);

  [[nodiscard]] bool deforms() const { return amplitudes() > 0; }
  /// True if the undeformed surfaces may overlap, since pressure parts them.
  [[nodiscard]] bool may_overlap() const { return deforms() || model_.compliance > 0; }
  [[nodiscard]] Eigen::Index amplitudes() const { return deforming_.amplitudes(); }
  [[nodiscard]] Eigen::Index size() const { return model_.grid.size() + amplitudes(); }
  [[nodiscard]] auto film_of(const Eigen::VectorXd& x) const { return x.head(model_.grid.size()); }
  [[nodiscard]] auto amplitudes_of(const Eigen::VectorXd& x) const { return x.tail(amplitudes()); }

  /// Returns the surfaces with the moving one at `e`, deformed by the amplitudes in x.
  [[nodiscard]] film::SurfaceMotion surfaces(const Coordinates& e, const Eigen::VectorXd& x);

  /// Sets the viscosities by the oil's temperatures.
  void set_viscosity(film::LayeredViscosity viscosity) {
    history_.viscosity = std::move(viscosity);
    ends_linearised_ = false;
  }
  /// Sets the shapes of both surfaces at rest, elastic deformation apart.
  void set_shapes(ShapesAtRest shapes) {
    shapes_ = std::move(shapes);
    ends_linearised_ = false;
  }
  /// As set.
  [[nodiscard]] const ShapesAtRest& shapes() const { return shapes_; }
  /// Sets the tolerance on the film's relative residual, instead of SteadyOptions::rtol.
  void set_tolerance(double rtol) { film_options_.rtol = rtol; }
  /// True if the last linearisation has found the answer to the position along with the increment.
  [[nodiscard]] bool has_position_answers() const { return u_by_position_.cols() > 0; }
  /// Makes every linearisation also find the film's answer to the position, which respond_to_position() then gives.
  void look_for_position() { finds_position_ = true; }
  /// History of a steady film, with its viscosities.
  [[nodiscard]] const film::FilmHistory& history() const { return history_; }

  /// Smallest gap of the surfaces with the journal at `e` before the film deforms them [m].
  [[nodiscard]] double undeformed_gap(const Coordinates& e) const;

  /// Returns unknowns without a film, the bodies deformed by their spin alone.
  [[nodiscard]] Eigen::VectorXd start() const;

  /// Solves film and deformation at `e` from x. On failure x is the last iterate.
  [[nodiscard]] film::FilmSolveSummary solve(const Coordinates& e, Eigen::VectorXd& x);

  /// True if the last solve() of a film between rigid surfaces has left it linearised about its answer: respond()
  /// refers to that. The next linearise(), which begins at that answer, then only adds the increment.
  [[nodiscard]] bool ends_linearised() const { return ends_linearised_; }
  /// Linearises about x; the members below refer to it.
  [[nodiscard]] film::FilmDomain linearise(const Coordinates& e, const Eigen::VectorXd& x);
  /// Linearises, after solving the film at this deformation where a step has moved its rupture front far: Newton's
  /// method would otherwise follow it node by node. @return linearisations, 0 where there is no film
  [[nodiscard]] int linearise_near(const Coordinates& e, Eigen::VectorXd& x);
  /// Advances the rupture front all the way after a Newton step from the last linearisation; between surfaces that do
  /// not deform.
  void advance_rupture_front(Eigen::VectorXd& x) const {
    if (!deforms()) reynolds_.active_set().advance_rupture_front(x);
  }
  /// True if the last linearisation has a factor for chord_about().
  [[nodiscard]] bool has_factor() const { return !deforms() && reynolds_.linear_solver().has_factor; }
  /// Residual, increment and force at a state nearby, with the derivatives of the last linearisation. @pre has_factor()
  [[nodiscard]] film::FilmDomain chord_about(const Coordinates& e, const Eigen::VectorXd& x);
  /// Returns what the film at x does, `offset` being that of the journal's axis. The last linearisation ends with it:
  /// a film of its own would need as much memory once more.
  [[nodiscard]] film::FilmObservables observe(const Coordinates& e, const Eigen::VectorXd& x,
                                              const Eigen::Vector2d& offset);
  /// Residual of the film, or of the deformation as the largest error of the gap over the clearance if that is larger.
  [[nodiscard]] double relative_residual() const;
  /// Newton's increment of x at a fixed journal, and the force on the shell after it, in the bearing's axes as they
  /// stand without load.
  [[nodiscard]] const Eigen::VectorXd& increment() const { return dx_; }
  [[nodiscard]] const Coordinates& force() const { return force_; }

  using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  /// Total derivatives of x and of the wrench on the shell (bearing's axes) with changes of the surfaces (bearing.28).
  void respond(std::span<const film::MotionDirection> directions, Eigen::MatrixXd& dx, Columns& dW);
  /// Total derivatives with the position `e` of the last linearisation.
  void respond_to_position(const Coordinates& e, Eigen::MatrixXd& dx, Columns& dW);
  /// Change of the wrench on the shell with accelerations by the oil's inertia (damper.8), given what unit rates do to
  /// x.
  /// @pre rigid surfaces
  [[nodiscard]] Columns by_acceleration(const Eigen::MatrixXd& dx_by_rate, double inertia_factor);
  /// Change of force() by changes of x and of the wrench.
  [[nodiscard]] Eigen::MatrixXd change_of_force(const Eigen::MatrixXd& dx, const Columns& dW) const;

  /// True if the step from x at e to x_next at e_next thins or thickens the film nowhere by more than a Newton step
  /// may.
  [[nodiscard]] bool reuses_film(const Coordinates& e, const Eigen::VectorXd& x, const Coordinates& e_next,
                                 const Eigen::VectorXd& x_next);

  /// Returns roughly how far the surfaces of elastic bodies yield to a load [m].
  [[nodiscard]] double depth(const Coordinates& load);

  /// Returns the opening of the gap at the nodes by amplitudes, rotation of the frames included [m].
  [[nodiscard]] Eigen::VectorXd opening(const Eigen::VectorXd& s) const { return all_openings_ * s; }

  /// Slope of the journal's axis relative to the shell's under load [-], and rotation of the shell's frame about z
  /// under the load [rad].
  [[nodiscard]] Eigen::Vector2d tilt(const Eigen::VectorXd& x) const;
  [[nodiscard]] double turn(const Eigen::VectorXd& x) const;

  /// Radial displacement of each surface at the nodes, away from the axis [m]; empty where it is rigid.
  [[nodiscard]] Eigen::VectorXd shell_displacement(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd journal_displacement(const Eigen::VectorXd& x) const;

  /// Coordinates of the moving surface.
  [[nodiscard]] SteadyCoordinates& coordinates() const { return *coordinates_; }
  [[nodiscard]] const film::Reynolds& reynolds() const { return reynolds_; }

 private:
  void solve_with_position(const Coordinates& e, Eigen::VectorXd& du);
  void gather_flexibility(const SteadyElasticity& elasticity);
  [[nodiscard]] film::FilmSolveSummary solve_film(const film::SurfaceMotion& motion, Eigen::VectorXd& u);
  [[nodiscard]] film::FilmSolveSummary solve_by_factorisation(const film::SurfaceMotion& motion, Eigen::VectorXd& u);
  [[nodiscard]] film::FilmSolveSummary solve_jointly(const Coordinates& e, Eigen::VectorXd& x);
  [[nodiscard]] film::FilmSolveSummary solve_nested(const Coordinates& e, Eigen::VectorXd& x);
  [[nodiscard]] Eigen::VectorXd limit_step(const Coordinates& e, const Eigen::VectorXd& x, const Eigen::VectorXd& dx);
  void eliminate_deformation();
  [[nodiscard]] film::SurfaceMotion rigid_surfaces(const OperatingPoint& point, const Coordinates& e) const;
  [[nodiscard]] Eigen::MatrixXd force_of(const Eigen::Ref<const Eigen::MatrixXd>& wrench) const;
  [[nodiscard]] Eigen::VectorXd answer(const Eigen::VectorXd& Q, const Vector6& W) const;
  [[nodiscard]] Eigen::MatrixXd wrench_by_amplitudes() const;
  void lay_openings();
  [[nodiscard]] Eigen::MatrixXd forces_on_shapes(const Eigen::MatrixXd& du, const Eigen::MatrixXd& g) const;

  const film::FilmModel& model_;
  const OperatingPoint& point_;
  std::unique_ptr<SteadyCoordinates> coordinates_;
  film::FilmSolveOptions film_options_;
  DeformingSurfaces deforming_;
  film::Reynolds reynolds_;
  film::FilmHistory history_;  // dt = 0: a steady film
  ShapesAtRest shapes_;
  Eigen::MatrixXd C_, C_W_;                         // of both bodies, shell first; C_W for the wrench on the shell
  Eigen::VectorXd s_0_;                             // what the spin of the bodies does
  Eigen::MatrixXd offset_by_s_, by_offset_moment_;  // of the shell's body, SurfaceFlexibility
  Eigen::MatrixXd tilt_by_s_;                       // of the journal's axis against the shell's, (2, amplitudes)
  // Rotation of the shell's frame about z relative to where its body is fixed, and to that body's axes.
  Eigen::RowVectorXd turn_by_s_, turn_in_body_by_s_;
  Eigen::MatrixXd all_openings_;                  // of the gap by amplitudes, frames turned included
  std::vector<film::MotionDirection> positions_;  // of the amplitudes, then of the tilt

  // At the state last linearised: residual of the deformation, answers of film, wrench and deformation to the
  // amplitudes, and the factor of what is left for these.
  Eigen::VectorXd r_s_, dx_;
  Coordinates force_;
  // Answer to the position, and the wrench's change at fixed u; empty: not found along with the increment.
  Eigen::MatrixXd u_by_position_;
  Columns W_by_position_;
  bool finds_position_ = false, ends_linearised_ = false;
  Vector6 wrench_ = Vector6::Zero();  // on the shell, its present axes
  double turn_ = 0, turn_in_body_ = 0;
  Eigen::MatrixXd C_W_now_;  // of the shell's body as it is deformed
  Eigen::MatrixXd u_by_s_;
  Columns W_by_s_;
  Eigen::PartialPivLU<Eigen::MatrixXd> condensed_;
};

}  // namespace hersey::bearing
