#include "hersey/film/film_domain.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "balance/node.h"

namespace hersey::film {

FilmDomain check_unknowns(const FilmModel& model, const Eigen::VectorXd& u) {
  int highest = -1;
  double most = 0;
  for (int node = 0; node < u.size(); ++node) {
    if (!std::isfinite(u[node])) return {FilmDomain::Violation::not_finite, node};
    // On an edge at p_cav, u > 0 is oil that leaves, not pressure.
    if (u[node] > most && !open_edge(model, node)) most = u[node], highest = node;
  }
  const bool is_meant =
      most < largest_pressure && log_viscosity_ratio(model.lubricant, most).value <= largest_log_viscosity;
  return is_meant ? FilmDomain{} : FilmDomain{FilmDomain::Violation::pressure, highest};
}

std::string position_of_node(const FilmModel& model, int node) {
  const Grid& grid = model.grid;
  const double phi = grid.phi(node / grid.n_z);
  const std::string along = is_round(model.surface) ? fmt::format("{:.1f} deg", phi * 180 / std::numbers::pi)
                                                    : fmt::format("{:.3g} mm", 1e3 * model.R * phi);
  const double z = model.L * grid.z_over_L(node % grid.n_z);
  const bool is_annulus = std::holds_alternative<Annulus>(model.surface);
  return along + fmt::format(", {} = {:.3g} mm", is_annulus ? "r" : "z", 1e3 * (is_annulus ? model.R + z : z));
}

std::string text(const FilmModel& model, const FilmDomain& domain) {
  using Violation = FilmDomain::Violation;
  if (domain.is_inside()) return {};
  const std::string where = domain.node < 0 ? "" : " at " + position_of_node(model, domain.node);
  if (domain.violation == Violation::closed) return "the film closes" + where;
  if (domain.violation == Violation::not_finite) return "the film has no finite pressure" + where;
  const bool stiffens = !std::holds_alternative<ConstantViscosity>(model.lubricant.viscosity_law);
  if (!stiffens) return "the film's pressure rises without bound" + where;
  return fmt::format(
      "the film's pressure runs away with its viscosity{}: beyond {:.0e} times that at rest, the "
      "pressure-viscosity law means no oil",
      where, std::exp(largest_log_viscosity));
}

}  // namespace hersey::film
