#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "force/journal_ring.h"
#include "gap/surface_shape.h"
#include "hersey/bearing/wear.h"
#include "hersey/film/film_model.h"

namespace hersey::bearing {

/// Depth worn off the surfaces of a film in time. What a step has worn off opens the gap over the next one, at a
/// constant rate, so that the oil is conserved (theory manual, wear.4).
class WearingSurfaces : public SurfaceShape {
 public:
  /// @param common  the moving surface, where other films wear it, too; null: none do
  WearingSurfaces(const film::FilmModel& model, const WearModel& wear, std::shared_ptr<CommonSurface> common = {});

  void begin_step(double dt) override;
  void accept_step(double dt) override;
  void add_to(const mbd::RelativeMotion& motion, const GapKinematics::Turning& turning,
              film::SurfaceMotion& surfaces) override;
  void add_turning(const GapKinematics::Turning& turning,
                   std::vector<film::MotionDirection>& of_parameters) const override;
  /// False where nothing can be worn: a coefficient of 0 changes no bit.
  [[nodiscard]] bool changes_gap() const override {
    return wear_.fixed.coefficient > 0 || wear_.moving.coefficient > 0 || common_ != nullptr;
  }
  [[nodiscard]] double power(const Eigen::VectorXd& normal_forces) const override;
  void persist(Archive& archive) override;

  /// Wears off what contact does over the step that ends (theory manual, wear.2, wear.3).
  /// @param p_asperity  at its end, at the nodes [Pa]
  /// @param surfaces  whose speeds slide then
  /// @param dt  length of the step [s]; 0: the start of a run
  void wear_off(const Eigen::VectorXd& p_asperity, const film::SurfaceMotion& surfaces, double dt);

  /// Worn depths at the nodes [m]: of the fixed surface, and of the moving one by all of its films, where a journal
  /// that wears by place has the angles of the nodes in its own axes.
  [[nodiscard]] Eigen::VectorXd fixed() const { return worn_.head(area_.size()); }
  [[nodiscard]] Eigen::VectorXd moving() const;
  /// Ratio of roughness to that at the start, at the nodes, of surfaces that run in [-].
  [[nodiscard]] Eigen::VectorXd roughness_ratio() const { return roughness(worn()); }
  [[nodiscard]] WearObservation observe() const;
  /// Names a lining that has been worn off; empty where there is none.
  [[nodiscard]] std::string failure() const;

 private:
  /// Ratio of roughness to that at the start, at the nodes, where both surfaces have worn by depths [m].
  [[nodiscard]] Eigen::VectorXd roughness(const Eigen::VectorXd& depths) const;
  /// Values of rows at their nodes.
  [[nodiscard]] Eigen::VectorXd at_rows(const Eigen::VectorXd& rows) const;
  /// Depths of the moving surface among those of both.
  [[nodiscard]] auto of_moving(const Eigen::VectorXd& depths) const {
    return depths.tail(depths.size() - area_.size());
  }
  /// These at the nodes, as the journal is turned.
  [[nodiscard]] Eigen::VectorXd moving_at_nodes(const Eigen::VectorXd& depths) const;
  /// Depths of both surfaces together at the nodes.
  [[nodiscard]] Eigen::VectorXd opening(const Eigen::VectorXd& depths) const {
    return depths.head(area_.size()) + moving_at_nodes(depths);
  }
  /// Depths worn off until the end of the step accepted last, of the moving surface by all of its films.
  [[nodiscard]] Eigen::VectorXd worn() const;
  [[nodiscard]] double moving_depth() const;   ///< largest of the moving surface, wherever around [m]
  [[nodiscard]] double moving_volume() const;  ///< worn off it by this film [m^3]
  /// Depths over the coefficient, on the rows or the ring, that contact pressure times sliding distance at the nodes
  /// [Pa m] wears off the moving surface.
  [[nodiscard]] Eigen::VectorXd moving_depths(const Eigen::VectorXd& work) const;

  const film::FilmModel& model_;
  WearModel wear_;
  Eigen::VectorXd area_;    ///< weights of the nodes in integrals, with which the film's forces are summed [m^2]
  Eigen::VectorXd around_;  ///< area of the whole moving surface that passes a row [m^2], shape (n_z)
  std::optional<JournalRing> ring_;  ///< of a journal that wears by place
  std::shared_ptr<CommonSurface> common_;
  /// Depths of the fixed surface at the nodes, then of the moving one on the rows or the ring [m]: worn off by this
  /// film until the end of the step accepted last, and by which the gap is wider at the start and the end of a step;
  /// the latter's rate [m/s].
  Eigen::VectorXd worn_, start_, now_, rate_;
  Eigen::VectorXd sliding_pressure_;           ///< contact pressure times sliding speed at the step's start [Pa m/s]
  double over_ = 0;                            ///< length of the step before [s]
  double of_cycle_ = 0, volume_of_cycle_ = 0;  ///< time since the present cycle began [s], and what it has worn [m^3]
  double volume_of_last_ = -1;                 ///< that the cycle before has worn; below 0: there is none [m^3]
  double error_ = 0;                           ///< by the acceleration, of all cycles [m^3]
};

}  // namespace hersey::bearing
