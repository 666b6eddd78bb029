#include "hersey/film/cavitation_law.h"

#include <algorithm>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

ValueAndSlope positive_part(double u) { return u >= 0 ? ValueAndSlope{u, 1} : ValueAndSlope{}; }

class Guembel final : public CavitationLaw {
 public:
  [[nodiscard]] std::string_view text() const override {
    return "guembel (half Sommerfeld: negative pressures dropped from the forces)";
  }
  [[nodiscard]] FilmPhase phase(double u, const CavitationScales& /*scales*/) const override { return {.p = {u, 1}}; }
  [[nodiscard]] double cavitated_unknown(const CavitatedRow& /*row*/,
                                         const CavitationScales& /*scales*/) const override {
    HERSEY_REQUIRE(false, "a film that bears tension is never cavitated");
    return 0;
  }
  [[nodiscard]] bool has_tension() const override { return true; }
};

class FullFilm final : public CavitationLaw {
 public:
  [[nodiscard]] std::string_view text() const override {
    return "full_film (no cavitation: tension acts on the surfaces)";
  }
  [[nodiscard]] FilmPhase phase(double u, const CavitationScales& /*scales*/) const override { return {.p = {u, 1}}; }
  [[nodiscard]] double cavitated_unknown(const CavitatedRow& /*row*/,
                                         const CavitationScales& /*scales*/) const override {
    HERSEY_REQUIRE(false, "a film that bears tension is never cavitated");
    return 0;
  }
  [[nodiscard]] bool has_tension() const override { return true; }
  [[nodiscard]] bool bears_tension() const override { return true; }
};

class ReynoldsCondition final : public CavitationLaw {
 public:
  [[nodiscard]] std::string_view text() const override {
    return "reynolds (p and its gradient vanish at rupture; mass not conserved)";
  }
  [[nodiscard]] FilmPhase phase(double u, const CavitationScales& /*scales*/) const override {
    return {.p = positive_part(u)};
  }
  [[nodiscard]] ValueAndSlope slack(double u) const override { return u < 0 ? ValueAndSlope{u, 1} : ValueAndSlope{}; }
  [[nodiscard]] double cavitated_unknown(const CavitatedRow& row, const CavitationScales& /*scales*/) const override {
    return std::min(0.0, -row.full / (row.slack + row.drawn));
  }
};

class MassConserving final : public CavitationLaw {
 public:
  [[nodiscard]] std::string_view text() const override {
    return "mass_conserving (pressure or fill fraction in every node)";
  }
  [[nodiscard]] FilmPhase phase(double u, const CavitationScales& scales) const override {
    if (u >= 0) return {.p = {u, 1}};
    return {.p = {}, .theta = {1 + u / scales.fill, 1 / scales.fill}};
  }
  [[nodiscard]] double cavitated_unknown(const CavitatedRow& row, const CavitationScales& scales) const override {
    const double slope = row.transport / scales.fill + row.drawn;
    return slope > 0 ? std::min(0.0, -row.full / slope) : 0;
  }
  [[nodiscard]] bool has_fill() const override { return true; }
};

}  // namespace

ValueAndSlope CavitationLaw::slack(double /*u*/) const { return {}; }

const CavitationLaw& cavitation_law(Cavitation cavitation) {
  static const Guembel guembel;
  static const ReynoldsCondition reynolds;
  static const MassConserving mass_conserving;
  static const FullFilm full_film;
  switch (cavitation) {
    case Cavitation::guembel:
      return guembel;
    case Cavitation::reynolds:
      return reynolds;
    case Cavitation::mass_conserving:
      return mass_conserving;
    case Cavitation::full_film:
      return full_film;
  }
  HERSEY_REQUIRE(false, "every cavitation model has its law");
  return guembel;
}

}  // namespace hersey::film
