#pragma once

#include <string_view>
#include <vector>

#include "hersey/model/short_names.h"
#include "interpret/context/interpret.h"

namespace hersey::model {

/// Reader of one kind of bearing. A new kind is a file beside this one, and its line in bearing_kinds().
struct KindReader {
  std::string_view kind;
  /// Reads frames, film and surfaces of a bearing.
  void (*read)(Context& context, const Value& value, Bearing& bearing);
  /// Reads its operating point, once solver and coupling are known.
  void (*read_point)(Context& context, const Value& value, Bearing& bearing);
  /// Returns its short names.
  ShortNames (*short_names)(const Model& model, const Bearing& bearing);
};

// A journal in a bore.
void read_journal(Context& context, const Value& value, Bearing& bearing);
void read_journal_point(Context& context, const Value& value, Bearing& bearing);
[[nodiscard]] ShortNames journal_short_names(const Model& model, const Bearing& bearing);

// A pad on a plane runner.
void read_plane_slider(Context& context, const Value& value, Bearing& bearing);
void read_plane_slider_point(Context& context, const Value& value, Bearing& bearing);
[[nodiscard]] ShortNames plane_slider_short_names(const Model& model, const Bearing& bearing);

// Pads in sectors of an annulus, or a washer, below a runner that turns.
void read_thrust(Context& context, const Value& value, Bearing& bearing);
void read_thrust_point(Context& context, const Value& value, Bearing& bearing);
[[nodiscard]] ShortNames thrust_short_names(const Model& model, const Bearing& bearing);

// A journal that orbits without rotating.
void read_squeeze_film_damper(Context& context, const Value& value, Bearing& bearing);
void read_squeeze_film_damper_point(Context& context, const Value& value, Bearing& bearing);
[[nodiscard]] ShortNames squeeze_film_damper_short_names(const Model& model, const Bearing& bearing);

// A piston's skirt in its liner.
void read_skirt(Context& context, const Value& value, Bearing& bearing);
void read_skirt_point(Context& context, const Value& value, Bearing& bearing);
[[nodiscard]] ShortNames skirt_short_names(const Model& model, const Bearing& bearing);

/// All kinds.
[[nodiscard]] inline std::vector<KindReader> bearing_kinds() {
  return {{"journal", read_journal, read_journal_point, journal_short_names},
          {"plane_slider", read_plane_slider, read_plane_slider_point, plane_slider_short_names},
          {"thrust", read_thrust, read_thrust_point, thrust_short_names},
          {"squeeze_film_damper", read_squeeze_film_damper, read_squeeze_film_damper_point,
           squeeze_film_damper_short_names},
          {"skirt", read_skirt, read_skirt_point, skirt_short_names}};
}

}  // namespace hersey::model
