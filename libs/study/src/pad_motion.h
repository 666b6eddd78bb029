#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "hersey/run/steady_motion.h"

namespace hersey::study {

/// A steady motion of journal and pads, and the pads that have none and stand aside in it.
struct PadMotion {
  model::Model alone;                    ///< with those pads fixed
  std::vector<double> fixed_tilts = {};  ///< of each pad; not a number of one that is free
  run::SteadyMotion motion = {};
};

/// Name of the journal's joint in a bearing by itself.
inline constexpr const char* journal_joint = "journal";

/// Motion of the joint called `name`; null if the bearing has none.
[[nodiscard]] const mbd::JointObservation* find_joint(const model::Model& model, const run::SteadyMotion& motion,
                                                      const std::string& name);

/// Tilt of a pad about the axis along the bearing, whatever its pivot allows [rad].
[[nodiscard]] double tilt_of_pad(const model::Composite& composite, std::size_t k, const PadMotion& found);

/// Force of the film on a pad, bearing axes [N].
[[nodiscard]] Eigen::Vector2d force_on_pad(const model::Composite& composite, std::size_t k, const PadMotion& found);

/// Velocity components of the journal's centre.
[[nodiscard]] std::vector<solver::Equations::Index> journal_coordinates(const run::SteadyMotion& motion);

/// A matrix over a linearisation's directions as one over velocity components; zero where drives allow no motion.
[[nodiscard]] Eigen::MatrixXd over_coordinates(const solver::Linearisation& linear, const Eigen::MatrixXd& A);

/// Finds the motion of a bearing of tilting pads at its operating point. Pads opposite to the load that shear or the
/// shape of their films turns over, so that nothing balances them, are fixed where they carry nothing, the most remote
/// from the load first.
[[nodiscard]] PadMotion find_motion(const model::Composite& composite, const model::JournalPoint& point);

/// Small motions about the motion, their stiffness and damping the means over four positions of the grids' lines in
/// their cells, the journal at one place: the fronts of films jump from line to line, theory manual eq. (bearing.38).
[[nodiscard]] solver::Linearisation mean_small_motions(const PadMotion& found);

}  // namespace hersey::study
