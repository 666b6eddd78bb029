#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hersey/bearing/thrust_bearing.h"
#include "hersey/model/model.h"
#include "hersey/run/steady_motion.h"

namespace hersey::study {

/// Film of all pads of a bearing together, as that of a bore of arcs or of a thrust bearing: one grid of patches, one
/// set of figures and fields.
class PadFilm {
 public:
  /// @param films  of the pads, each on one arc or sector; they outlive this
  explicit PadFilm(const std::vector<model::Bearing>& films);

  /// Adds up what the pads' films show.
  /// @param fixed_tilts  of pads that stand aside, whose thickness and pressure are not those of the bearing; not a
  /// number of all others
  void observe(const run::SteadyMotion& motion, const std::vector<double>& fixed_tilts);

  /// Numbers of the pads in the order of the arcs.
  [[nodiscard]] const std::vector<std::size_t>& order() const { return order_; }

  std::shared_ptr<const bearing::BearingKind> kind;  ///< with all pads
  film::FilmModel model;
  film::FilmObservables film;
  film::FilmFields fields;
  std::optional<film::HeatObservables> heat;  ///< unset: the films have one temperature

 private:
  void add_patch(const model::Bearing& pad, std::size_t number);
  void add_extremes(const film::FilmObservables& pad);
  void add_figures(const film::FilmObservables& pad, const film::Grid& grid);
  void add_fields(const film::FilmFields& pad);
  void add_heat(const film::HeatObservables& pad, const film::Grid& grid, double oil_volume);
  void divide_heat();
  [[nodiscard]] double angle_of_pads() const;

  const std::vector<model::Bearing>& films_;
  film::Arcs bore_;                          // around a journal
  std::vector<bearing::SectorPad> sectors_;  // below a collar
  std::vector<std::size_t> order_;
};

}  // namespace hersey::study
