#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"

// Keys of a thrust bearing of pads on pivots: those of its pads and pivots, and what each pad's film has in common with
// a thrust bearing.
namespace hersey::model {
namespace {

TypePtr thrust_pads_format() {
  const TypePtr length = quantity("m", "20 mm", Range::positive());
  return object(
      "the pads",
      {
          required("count", integer(6, {.low = 1, .high = 48}), "Number of pads."),
          required("arc", quantity("rad", "50 deg", Range::positive()), "Whole angle of each pad."),
          defaulted("offset", number("0.6", {.low = 0, .high = 1, .low_open = true, .high_open = true}), "0.5",
                    "Angle from the leading edge to the pivot over the whole arc: 0.5 in the middle, 0.6 for a collar "
                    "that turns in the pads' `sense`."),
          optional("pivot_radius", length, "Distance of the pivots from the axis.", "the mean radius"),
          defaulted("angle", quantity("rad", "0 deg"), "0 deg",
                    "Middle of the first pad, from the stator's x-axis towards y."),
          optional("thickness", length, "From a pad's face to its pivot.", "two fifths of the pads' width"),
          defaulted("density", quantity("kg/m^3", "7850 kg/m^3", Range::not_negative()), "7850 kg/m^3",
                    "Gives mass and moments of inertia of pads of that thickness; 0: pads without mass."),
          optional("mass", quantity("kg", "0.5 kg", Range::not_negative()),
                   "Of one pad; its moments of inertia are those of a sector of that mass.", "from `density`"),
      });
}

std::vector<Key> thrust_pivot_keys() {
  return {
      defaulted("form",
                choice({{"point", "pads tilt around the axis and along the radius"},
                        {"line",
                         "pads roll about a line along the radius: they do not follow a collar that leans "
                         "outwards"}}),
                "point", "What pads stand on."),
      defaulted("damping", quantity("N.s/m", "1e4 N.s/m", Range::not_negative()), "0 N.s/m",
                "Of a pivot that yields, along the axis."),
  };
}

TypePtr collar_point_format() {
  const TypePtr slope = quantity("rad", "0.01 deg");
  const std::vector<Word> not_given{{"none", "not given; for `--set`"}};
  return object(
      "an operating point",
      {
          required("speed", quantity("rad/s", "3000 rpm"),
                   "Of the collar about the stator's z-axis: positive from x towards y."),
          optional("load", or_word(quantity("N", "20 kN", Range::positive()), not_given),
                   "Load that presses the collar on the pads: the film thickness is sought."),
          optional("film_thickness", or_word(quantity("m", "30 um", Range::positive()), not_given),
                   "Distance of the collar from the stator's plane on its axis, in which pads that do not tilt have "
                   "their faces, instead of a load: its load is sought."),
          defaulted("tilt_x", slope, "0 deg",
                    "Slope of the collar's axis towards x; positive: the gap is narrower at x > 0."),
          defaulted("tilt_y", slope, "0 deg",
                    "Slope of the collar's axis towards y; positive: the gap is narrower at y > 0."),
          defaulted("whirl_ratio", number("1", Range::not_negative()), "1",
                    "Frequency of the motion at which the pads follow, over the collar's frequency, in stiffness and "
                    "damping; 0: slow motions."),
      });
}

}  // namespace

std::vector<Key> tilting_pad_thrust_keys() {
  std::vector<Key> keys;
  for (Key& key : thrust_keys()) {
    const bool is_ours =
        key.name == "stator" || key.name == "runner" || is_key_of_each_pad("tilting_pad_thrust", key.name);
    if (is_ours) keys.push_back(std::move(key));
  }
  const auto at = std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.name == "sense"; });
  keys.insert(at, {required("pads", thrust_pads_format(), "Number, size and place of the pads."),
                   defaulted("pivot", pivot_format(thrust_pivot_keys()), "{type: rigid}", "What the pads stand on.")});
  keys.push_back(
      optional("operating_point", collar_point_format(),
               "Speed and load, or film thickness, of the bearing by itself (`hersey bearing`); a simulation "
               "has its own.",
               "given on the command line"));
  return keys;
}

}  // namespace hersey::model
