#pragma once

#include <vector>

#include "hersey/bearing/film_force.h"
#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// Data of a bearing that exist before the first row.
struct BearingPlan {
  const model::Model& model;
  const model::Bearing& bearing;
  film::FilmFields start;  ///< the same fields as at any instant
};

/// A bearing at an instant.
struct BearingRow {
  const bearing::BearingObservation& observation;
  const film::FilmFields& fields;
  const film::Grid& grid;
  double radius = 0;       ///< of the film, to which an annulus' z is relative [m]
  bool is_forward = true;  ///< leading ends are those with the smaller coordinate
  const film::FilmModel* model = nullptr;
};

/// The fields of a film at an instant.
struct FilmInstant {
  double t = 0;
  const film::FilmFields& fields;
};

/// Writes what is known of a bearing before any run: its size, assumptions, and the nodes of its film.
void write_bearing_plan(const model::Model& model, const model::Bearing& bearing, results::Writer& writer);

/// One bearing in the results file: figures over time, extremes around the bore, fields.
class BearingRecord {
 public:
  /// @param film  of the bearing; outlives this
  BearingRecord(const BearingPlan& plan, const bearing::FilmForce& film, results::Writer& writer);
  void append(const bearing::BearingObservation& observation) const {
    const film::FilmModel& model = film_.model();
    rows_.append({observation, film_.fields(), model.grid, model.R, is_forward_, &model});
  }
  void append_fields(double t) const { fields_.append({t, film_.fields()}); }
  /// The group of a bearing and that of its cycles.
  [[nodiscard]] static std::vector<QuantityGroup> describe();

 private:
  const bearing::FilmForce& film_;
  bool is_forward_;
  QuantityRows<BearingRow, BearingPlan> rows_;
  QuantityRows<FilmInstant, BearingPlan> fields_;
};

}  // namespace hersey::run
