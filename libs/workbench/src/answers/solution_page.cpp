#include "hersey/workbench/solution_page.h"

#include <cmath>
#include <utility>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/film_coordinates.h"
#include "hersey/run/film_fields.h"
#include "hersey/study/bearing_study.h"

namespace hersey::workbench {
namespace {

using report::PageSolution;
using study::BearingSolution;

void add_fields(const film::FilmModel& model, const film::FilmFields& fields, report::PageFilm& page) {
  const bearing::FilmCoordinate along = bearing::coordinate_along(model), across = bearing::coordinate_across(model);
  page.along = along.name, page.across = across.name;
  page.phi = along.values, page.z = across.values;
  if (film::is_round(model.surface) && !model.grid.closes()) page.arcs = film::arc_of_lines(model.grid);
  for (const run::FilmField& field : run::film_fields())
    if (Eigen::VectorXd values = field.values(fields); values.size() > 0)
      page.fields.push_back({field.name, field.unit, field.text, std::move(values)});
}

/// @param phi_line  where a supply line lies [rad]
void add_features(const film::FilmModel& model, double journal_angle, double phi_line, report::PageFilm& page) {
  const double beyond = bearing::is_on_annulus(model) ? model.R : 0;
  for (const film::SurfaceFeature& f : model.features) {
    const double turned = f.surface == film::Surface::journal ? journal_angle : 0;
    page.features.push_back(
        {f.name, std::holds_alternative<film::Ellipse>(f.shape), f.phi + turned, f.z + beyond, f.arc, f.length});
  }
  if (model.supply.kind != film::SupplyKind::none)
    page.features.push_back({"supply line", false, phi_line, 0, 0, model.L});
}

report::PageFilm film_of(const BearingSolution& solution) {
  const film::FilmModel& model = solution.model;
  report::PageFilm page;
  if (solution.state.kind->has_axis()) {
    page.clearance = bearing::clearance(model, solution.state.point);
    page.e = solution.state.e;
  }
  add_fields(model, study::fields_of(solution), page);
  const bool has_line = model.supply.kind != film::SupplyKind::none;
  const double phi_line =
      has_line ? bearing::steady_surfaces(model, solution.state.point, solution.state.e).phi_supply : 0;
  add_features(model, solution.state.point.journal_angle, phi_line, page);
  return page;
}

report::PageFilm film_of_ring(const study::RingFilmState& film) {
  report::PageFilm page;
  page.name = film.name;
  page.clearance = film.clearance;
  page.e = film.e;
  add_fields(film.model, film.fields, page);
  const bool at_widest = film.model.supply.kind == film::SupplyKind::widest_gap;
  add_features(film.model, 0, at_widest ? std::atan2(-film.e.y(), -film.e.x()) : film.model.supply.phi, page);
  return page;
}

}  // namespace

PageSolution page_of(const BearingSolution& solution) {
  PageSolution page;
  page.label = solution.run.label;
  page.status = solution.status, page.message = solution.message;
  for (const model::StudyValue& value : solution.run.values) {
    page.values.emplace_back(value.name.substr(value.name.find_last_of('.') + 1), value.text);
  }
  if (!solution.solved()) return page;
  page.has_axis = solution.state.kind->has_axis();
  if (page.has_axis) page.load = solution.state.load;
  for (const study::BearingFigure& f : study::figures_of(solution)) {
    page.figures.push_back({f.key, f.group, f.label, f.unit, f.value, f.grid_error, f.words});
  }
  if (solution.pads && solution.pads->ring) {
    for (const study::RingFilmState& film : solution.pads->ring->films) page.films.push_back(film_of_ring(film));
  } else {
    page.films.push_back(film_of(solution));
  }
  return page;
}

}  // namespace hersey::workbench
