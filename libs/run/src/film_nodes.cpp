#include "film_nodes.h"

#include <vector>

namespace hersey::run {
namespace {

std::vector<double> angles(const film::Grid& grid) {
  std::vector<double> phi(static_cast<std::size_t>(grid.n_phi));
  for (int i = 0; i < grid.n_phi; ++i) phi[static_cast<std::size_t>(i)] = grid.phi(i);
  return phi;
}

std::vector<double> heights(const film::FilmModel& film) {
  std::vector<double> z(static_cast<std::size_t>(film.grid.n_z));
  for (int j = 0; j < film.grid.n_z; ++j) {
    z[static_cast<std::size_t>(j)] = film.L * film.grid.z_over_L(j);
  }
  return z;
}

}  // namespace

void write_film_nodes(const model::Bearing& bearing, results::Writer& writer) {
  const std::string path = "/bearings/" + bearing.name + "/fields/";
  writer.constant(path + "phi", angles(bearing.film.grid), "rad", "bearing angle of the nodes");
  writer.constant(path + "z", heights(bearing.film), "m", "axial position of the nodes");
}

}  // namespace hersey::run
