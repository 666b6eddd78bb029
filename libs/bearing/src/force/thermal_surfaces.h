#pragma once

#include <Eigen/Dense>

#include "gap/clearance_growth.h"
#include "gap/surface_shape.h"
#include "gap/thermal_shape.h"
#include "hersey/bearing/gap_kinematics.h"
#include "hersey/core/archive.h"
#include "hersey/film/film_heat.h"

namespace hersey::bearing {

/// How the temperatures of its walls move the surfaces of a film in time (theory manual, thermal.42 to thermal.44,
/// thermal.58, thermal.61): both grow apart everywhere by the walls' mean temperatures, and the surfaces of meshed
/// bodies change their shape node by node.
class ThermalSurfaces : public SurfaceShape {
 public:
  /// @param heat  temperatures of the film; null: it has one temperature
  /// @param growth  of the clearance of a film with one temperature [m]
  ThermalSurfaces(const film::FilmModel& model, const film::FilmHeat* heat, double growth);

  /// Growth and shapes over the step of length dt that begins [s].
  void begin_step(double dt) override;
  /// The step of length dt has ended, and temperatures with it.
  void accept_step(double dt) override;
  /// Temperatures of the step accepted last have been changed.
  void change_target();
  /// Walls that are fixed over a cycle have been corrected at its end.
  void settle();

  /// Widens the clearance of the surfaces that are placed next.
  void set_clearance_change(GapKinematics& gap) const { gap.set_clearance_change(growth_.now(), growth_.rate()); }
  /// Adds the shapes of both surfaces to gap and rate; the clearance has grown already.
  void add_to(const mbd::RelativeMotion& motion, const GapKinematics::Turning& turning,
              film::SurfaceMotion& surfaces) override;
  /// True where a surface has a shape of its own.
  [[nodiscard]] bool changes_gap() const override { return shell().size() > 0 || journal().size() > 0; }

  /// Sets the growth of the clearance of a film in steady motion [m].
  void set_growth(double growth) { growth_.start_at(growth); }
  /// Growth of the clearance at the end of the step [m].
  [[nodiscard]] double growth() const { return growth_.now(); }
  /// Growth that temperatures call for [m].
  [[nodiscard]] double growth_target() const { return growth_.target(); }
  /// Shapes at the end of the step, outwards at the nodes [m]; empty: round.
  [[nodiscard]] const Eigen::VectorXd& shell() const { return shell_.now(); }
  [[nodiscard]] const Eigen::VectorXd& journal() const { return journal_.now(); }
  /// Shapes that temperatures call for [m]; empty: round.
  [[nodiscard]] Eigen::VectorXd shell_target() const;
  [[nodiscard]] Eigen::VectorXd journal_target() const;
  /// Power of the forces at the nodes on walls that move apart [W].
  [[nodiscard]] double power(const Eigen::VectorXd& normal_forces) const override;

  /// Saves or restores growth and shapes of a film with temperatures.
  void persist(Archive& archive) override;

 private:
  [[nodiscard]] double growth_by_temperature() const;

  const film::FilmModel& model_;
  const film::FilmHeat* heat_;
  double given_growth_;
  ClearanceGrowth growth_;
  ThermalShape shell_, journal_;
};

}  // namespace hersey::bearing
