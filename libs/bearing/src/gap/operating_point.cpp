#include "hersey/bearing/operating_point.h"

namespace hersey::bearing {

film::FilmModel scaled_for(film::FilmModel model, const OperatingPoint& point) {
  const double omega = point.film_speed(clearance(model), model.L);
  if (omega > 0) model.fill_speed = omega;
  return model;
}

OperatingPoint with_growth(OperatingPoint point, const film::FilmModel& model, double growth) {
  const double before = clearance(model, point);
  point.growth = growth;
  point.e *= clearance(model, point) / before;
  return point;
}

}  // namespace hersey::bearing
