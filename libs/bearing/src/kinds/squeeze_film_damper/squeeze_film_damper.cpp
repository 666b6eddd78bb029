#include "hersey/bearing/squeeze_film_damper.h"

namespace hersey::bearing {
namespace {

class DamperKind final : public BearingKind {
 public:
  [[nodiscard]] std::string name() const override { return "squeeze_film_damper"; }
  [[nodiscard]] bool has_axis() const override { return true; }
  [[nodiscard]] std::string fixed_surface() const override { return journal_kind()->fixed_surface(); }
  [[nodiscard]] std::string moving_surface() const override { return journal_kind()->moving_surface(); }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> description(
      const film::FilmModel& model) const override {
    return journal_kind()->description(model);
  }
  [[nodiscard]] std::unique_ptr<GapKinematics> gap(const film::FilmModel& model,
                                                   bool moving_surface_deforms) const override {
    return journal_kind()->gap(model, moving_surface_deforms);
  }
  [[nodiscard]] std::unique_ptr<SteadyCoordinates> steady_coordinates(const film::FilmModel& model) const override {
    return journal_kind()->steady_coordinates(model);
  }
};

}  // namespace

std::shared_ptr<const BearingKind> squeeze_film_damper_kind() {
  static const std::shared_ptr<const BearingKind> kind = std::make_shared<DamperKind>();
  return kind;
}

bool is_damper(const BearingKind& kind) { return kind.name() == squeeze_film_damper_kind()->name(); }

}  // namespace hersey::bearing
