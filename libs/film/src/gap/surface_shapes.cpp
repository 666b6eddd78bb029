#include "hersey/film/surface_shapes.h"

namespace hersey::film {

using Eigen::Index;

void SurfaceShapes::find_along_amplitude(Index a, MotionDirection& direction) const {
  direction.g = openings.col(a);
  Index of_surface = a;
  auto surface = surfaces.begin();
  for (; of_surface >= surface->functions.cols(); ++surface) of_surface -= surface->functions.cols();
  direction.shell_fraction = surface->is_shell ? 1 : 0;
  if (surface->rate.size() != 0)
    direction.g_rate.noalias() = surface->rate * surface->functions.col(of_surface);
  else
    direction.g_rate.resize(0);
}

void SurfaceShapes::find_along_rate(Index a, MotionDirection& direction) const { direction.g_rate = openings.col(a); }

}  // namespace hersey::film
