#include <algorithm>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/contract.h"
#include "steady/steady_heat.h"
#include "steady/steady_search.h"

namespace hersey::bearing {

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
  SteadySearch search(model, point, options);
  const SteadySummary summary = search.solve();
  if (summary.solved()) state = search.state();
  return summary;
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
