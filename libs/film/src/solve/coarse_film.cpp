#include "solve/coarse_film.h"

#include "hersey/film/grid_transfer.h"

namespace hersey::film {

CoarseFilm coarsened(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                     const Eigen::VectorXd& u) {
  CoarseFilm coarse{model, motion, history, {}};
  coarse.model.grid = half_of(model.grid);
  const GridTransfer to_coarse(model.grid, coarse.model.grid);
  const double fill = fill_scale(coarse.model) / fill_scale(model);
  coarse.u = to_coarse(u).unaryExpr([fill](double value) { return value < 0 ? fill * value : value; });
  coarse.motion.g = to_coarse(motion.g);
  coarse.motion.g_rate = to_coarse(motion.g_rate);
  if (motion.roughness_ratio.size() != 0) coarse.motion.roughness_ratio = to_coarse(motion.roughness_ratio);
  coarse.motion.shell_opening.resize(0);  // affects forces only
  if (history.viscosity.fluidity.size() != 0) {
    coarse.history.viscosity = {to_coarse(history.viscosity.fluidity), to_coarse(history.viscosity.shear_fluidity),
                                to_coarse(history.viscosity.skew)};
    if (history.viscosity.at_rest.size() != 0) {
      coarse.history.viscosity.at_rest = to_coarse(history.viscosity.at_rest);
      coarse.history.viscosity.axial_fluidity = to_coarse(history.viscosity.axial_fluidity);
    }
  }
  if (history.dt == 0) return coarse;
  coarse.history.theta = to_coarse(history.theta);
  if (history.w.size() != 0) coarse.history.w = to_coarse(history.w);
  if (history.density.size() != 0) coarse.history.density = to_coarse(history.density);
  if (history.gap.size() != 0) coarse.history.gap = to_coarse(history.gap);
  return coarse;
}

Eigen::VectorXd refined(const CoarseFilm& coarse, const FilmModel& model) {
  const double fill = fill_scale(model) / fill_scale(coarse.model);
  const GridTransfer to_fine(coarse.model.grid, model.grid);
  return to_fine(coarse.u.unaryExpr([fill](double value) { return value < 0 ? fill * value : value; }));
}

}  // namespace hersey::film
