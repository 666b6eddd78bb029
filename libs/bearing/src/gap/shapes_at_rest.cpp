#include "hersey/bearing/shapes_at_rest.h"

namespace hersey::bearing {

void ShapesAtRest::add_to(film::SurfaceMotion& motion) const {
  add_to_shell(thermal_shell, motion);
  add_to_journal(thermal_journal, motion);
}

void add_to_shell(const Eigen::VectorXd& shape, film::SurfaceMotion& motion) {
  if (shape.size() == 0) return;
  motion.g += shape;
  if (motion.shell_opening.size() == 0) motion.shell_opening.setZero(shape.size());
  motion.shell_opening += shape;
}

void add_to_journal(const Eigen::VectorXd& shape, film::SurfaceMotion& motion) {
  if (shape.size() > 0) motion.g -= shape;
}

}  // namespace hersey::bearing
