#include "hersey/bearing/operating_point.h"

namespace hersey::bearing {

film::FilmModel scaled_for(film::FilmModel model, const OperatingPoint& point) {
  const double omega = point.film_speed(clearance(model));
  if (omega > 0) model.fill_speed = omega;
  return model;
}

OperatingPoint with_growth(OperatingPoint point, const film::FilmModel& model, double growth) {
  const double before = clearance(model, point);
  point.growth = growth;
  point.e *= clearance(model, point) / before;
  return point;
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
