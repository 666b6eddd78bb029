#include "hersey/bearing/steady_surfaces.h"

#include <cmath>

#include "hersey/film/gap_shape.h"

namespace hersey::bearing {

film::SurfaceMotion steady_surfaces(const film::FilmModel& model, const OperatingPoint& point, const Coordinates& e) {
  RigidSurfaces surfaces(model);
  return steady_surfaces(surfaces, model, point, e);
}

film::SurfaceMotion steady_surfaces(RigidSurfaces& surfaces, const film::FilmModel& model, const OperatingPoint& point,
                                    const Coordinates& e) {
  film::SurfaceMotion motion;
  surfaces.set_clearance_change(point.growth, 0);
  surfaces.evaluate(parameters_of(model, point, e), motion);
  motion.u_shell = model.R * (point.shell_speed - point.whirl_speed);
  motion.u_journal -= model.R * point.whirl_speed;
  // The bearing's axes rest: a shell that turns takes its shape along.
  if (point.shell_speed != 0) motion.g_rate -= point.shell_speed * film::GapShape(model).shell_slope();
  return motion;
}

ParameterVector parameters_of(const film::FilmModel& model, const OperatingPoint& point, const Coordinates& e) {
  ParameterVector parameters = ParameterVector::Zero();
  parameters.segment<2>(kEx) = e;
  parameters.segment<2>(kTx) = point.tilt;
  parameters.segment<2>(kExRate) = point.e_rate;
  parameters.segment<2>(kTxRate) = point.tilt_rate;
  parameters[kJournalSpeed] = model.R * point.journal_speed;
  parameters[kRotation] = point.journal_angle;
  parameters[kSupplyAngle] = e.squaredNorm() > 0 ? std::atan2(-e.y(), -e.x()) : 0.0;
  return parameters;
}

}  // namespace hersey::bearing
