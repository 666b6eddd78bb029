#include <algorithm>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/contract.h"
#include "hersey/film/grid_transfer.h"
#include "steady/steady_heat.h"
#include "steady/steady_search.h"

namespace hersey::bearing {
namespace {

// What a search on half of the nodes leaves of the load and of the film: far less than the grid's own error, which the
// search on all nodes has to take away in any case.
constexpr double kCoarseSearch = 1e-6;

// Below so many nodes a search is as quick by itself as with one on half of the nodes before it.
constexpr int kNodesWorthHalving = 1000;

// Begins with the position and the film that a search on half of the nodes each way finds (bearing.39). Without an
// answer there the search begins by itself.
void begin_on_coarse_grid(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                          SteadySearch& search) {
  const bool is_elastic = options.elasticity && (options.elasticity->shell || options.elasticity->journal);
  if (!point.load || options.start_film.size() > 0 || is_elastic || options.solver == film::FilmSolver::sor) return;
  if (model.grid.size() < kNodesWorthHalving || !film::can_be_coarsened(model.grid)) return;
  film::FilmModel half = model;
  half.grid = film::half_of(model.grid);
  SteadyOptions on_half = options;
  on_half.rtol = std::max(options.rtol, kCoarseSearch);
  if (options.solver == film::FilmSolver::multigrid) on_half.solver = film::usual_solver(half.grid);
  SteadySearch search_there(half, point, on_half);
  begin_on_coarse_grid(half, point, on_half, search_there);
  if (!search_there.solve().solved()) return;
  const film::GridTransfer transfer(half.grid, model.grid);
  const double fill = film::fill_scale(model) / film::fill_scale(half);
  search.begin_at(search_there.position(),
                  transfer(search_there.film().unaryExpr([fill](double u) { return u < 0 ? fill * u : u; })));
}

SteadySummary search_from_coarse_grids(const film::FilmModel& model, const OperatingPoint& point,
                                       const SteadyOptions& options, SteadyState& state) {
  SteadySearch search(model, point, options);
  begin_on_coarse_grid(model, point, options, search);
  SteadySummary summary = search.solve();
  summary.work = search.work();
  if (summary.solved()) state = search.state();
  return summary;
}

}  // namespace

double initial_gap(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options) {
  const std::unique_ptr<SteadyCoordinates> coordinates =
      (options.kind ? options.kind : journal_kind())->steady_coordinates(model);
  return coordinates->smallest_gap(point, point.load ? coordinates->widest() : point.e);
}

SteadySummary solve_steady(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                           SteadyState& state) {
  HERSEY_REQUIRE(!point.load || point.load->norm() > 0, "a load that is not zero");
  const bool is_fed = std::any_of(model.features.begin(), model.features.end(), [](const auto& f) { return f.is_fed; });
  const bool has_pressure = is_fed || film::cavitation_law(model).bears_tension() ||
                            model.edge_left.pressure > model.p_cav || model.edge_right.pressure > model.p_cav;
  HERSEY_REQUIRE(point.film_speed(clearance(model), model.L) > 0 ||
                     model.asperities.model != film::AsperityModel::none || has_pressure,
                 "speeds that move oil in the gap, a feed or another pressure, or asperities");
  HERSEY_REQUIRE(initial_gap(model, point, options) > 0, "a journal inside its bore");
  if (options.thermal) return solve_with_heat(model, point, options, state);
  SteadySummary summary = search_from_coarse_grids(model, point, options, state);
  if (summary.solved() || options.solver != film::FilmSolver::multigrid) return summary;
  // Of films that starve multigrid loses the level of the oil, which their edges hardly determine.
  SteadyOptions by_factors = options;
  by_factors.solver = film::FilmSolver::newton;
  SteadySummary again = search_from_coarse_grids(model, point, by_factors, state);
  if (!again.solved()) return summary;
  again.iterations += summary.iterations;
  again.work += summary.work;
  return again;
}

film::FilmFields steady_fields(const film::FilmModel& model, const SteadyState& state) {
  OperatingPoint loaded = state.point;
  loaded.tilt = state.tilt;
  film::SurfaceMotion motion = state.kind->steady_coordinates(model)->surfaces(loaded, state.e);
  state.shapes.add_to(motion);
  if (state.d_shell.size() > 0) motion.g += state.d_shell;
  if (state.d_journal.size() > 0) motion.g -= state.d_journal;
  film::FilmFields fields = film::film_fields(model, motion, state.u, state.viscosity);
  fields.depth = film::mean_depth(model, motion.phi_journal);
  if (state.heat) state.heat->fields.show_in(fields);
  fields.d_shell = state.d_shell;
  fields.d_journal = state.d_journal;
  return fields;
}

}  // namespace hersey::bearing
