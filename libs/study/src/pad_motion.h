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

/// After which a search counts as one without an answer: those with one need ten.
inline constexpr int most_iterations = 100;

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

/// The bearing with all joints that have a start beginning where a motion has them.
[[nodiscard]] model::Model starting_at(model::Model alone, const run::SteadyMotion& motion);

/// True if pads return to where a motion has them while the shaft is held: no motion of theirs, which films resist by
/// C y', grows by -K y.
/// @param of_shaft  joints whose coordinates are those of the shaft
[[nodiscard]] bool pads_return(const run::SteadyMotion& motion, const std::vector<std::string>& of_shaft);

/// Small motions about `motion`, their stiffness and damping the means over four positions of the grids' lines in their
/// cells, theory manual eq. (bearing.38).
/// @param held  the bearing with its shaft held where the motion has it, and pads that start there
/// @param released  coordinates that drives prescribe in `held`
[[nodiscard]] solver::Linearisation mean_over_grids(const model::Model& held, const run::SteadyMotion& motion,
                                                    const std::vector<std::string>& released);

/// Small motions about the motion, their stiffness and damping the means over four positions of the grids' lines in
/// their cells, the journal at one place: the fronts of films jump from line to line, theory manual eq. (bearing.38).
[[nodiscard]] solver::Linearisation mean_small_motions(const PadMotion& found);

}  // namespace hersey::study
