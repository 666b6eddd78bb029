#include "schema/kinds/arc_keys.h"

#include <utility>

#include "schema/bearing_keys.h"

namespace hersey::model {
namespace {

std::vector<Key> with(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

Key preload_key(bool is_required) {
  const TypePtr preload = number("0.5", {.low = -10, .high = 1});
  const char* text =
      "1 - c_b/c_p, below 1: c_b the clearance where a central journal is nearest to the arc, c_p that of the arc's "
      "own circle.";
  return is_required ? required("preload", preload, text) : optional("preload", preload, text, "0");
}

const TypePtr& offset_type() {
  static const TypePtr offset = number("0.5", {.low = -10, .high = 10});
  return offset;
}

constexpr const char* offset_text =
    "Angle from the leading end to where a central journal is nearest, over the whole arc: 0.5 in the middle, 1 at the "
    "trailing end.";

}  // namespace

std::vector<Key> arc_end_keys() {
  const TypePtr edge = edge_format();
  const TypePtr fill = number("0.5", {.low = 0, .high = 1});
  const auto both = [](const char* title, const char* what, const TypePtr& type) {
    return any_of(title, {type, object(what, {required("leading", type, "At the end with the smaller angle."),
                                              required("trailing", type, "At the end with the larger angle.")})});
  };
  return {
      defaulted("edge_pressure",
                both("a pressure such as 2 bar, `closed`, or {leading, trailing}", "the two ends of an arc", edge),
                "0 Pa", "Pressure in the grooves at both ends, or walls there."),
      optional("ambient_fill", both("a number from 0 to 1, or {leading, trailing}", "two fill fractions", fill),
               "Share of oil in a groove at the cavitation pressure, from which the film draws: 1 flooded, 0 air.",
               "1"),
      optional(
          "edge_flow",
          both("a flow such as 0.4 L/min, or {leading, trailing}", "two flows",
               quantity("m^3/s", "0.4 L/min", Range::not_negative())),
          "All the oil that reaches the groove, at the cavitation pressure, before an arc: what the arc has no room "
          "for is lost, and where it could draw more it is starved; in place of `ambient_fill`.",
          "as much as the film draws"),
  };
}

TypePtr arcs_format() {
  const TypePtr angle = quantity("rad", "-90 deg"), clearance = quantity("m", "60 um", Range::positive());
  return named(
      "a mapping from names to arcs",
      object(
          "an arc of the bore",
          with({required("middle", angle, "Its middle, from the shell's x-axis towards y."),
                required("arc", quantity("rad", "120 deg", Range::positive()), "Its whole angle."), preload_key(false),
                optional("machined_clearance", clearance,
                         "Radius of its own circle minus radius of the journal, c_p, instead of a preload."),
                defaulted("offset", offset_type(), "0.5", offset_text),
                optional("radial_clearance", clearance, "Its clearance c_b where it is least.", "that of the bearing")},
               arc_end_keys())));
}

TypePtr bore_format() {
  const TypePtr angle = quantity("rad", "-90 deg");
  const Key offset = defaulted("offset", offset_type(), "0.5", offset_text);
  const std::vector<Key> common = with(
      {
          preload_key(true),
          defaulted("groove", quantity("rad", "20 deg", Range::not_negative()), "20 deg",
                    "Angle of each of the axial grooves between the arcs."),
          defaulted("angle", angle, "-90 deg", "Middle of the first arc, from the shell's x-axis towards y."),
      },
      arc_end_keys());
  return variant("a bore of equal arcs with axial grooves between them", "type", common,
                 {
                     {"elliptical", "two arcs: a lemon bore", {offset}},
                     {"offset_half",
                      "two arcs, moved along their split line; nearest at their trailing ends for a journal that turns "
                      "from x towards y",
                      {defaulted("offset", offset_type(), "1", offset_text)}},
                     {"three_lobe", "three arcs", {offset}},
                     {"four_lobe", "four arcs", {offset}},
                     {"lobes",
                      "any number of arcs; `preload: 0` makes a plain bore with axial grooves",
                      {required("count", integer(5, {.low = 1, .high = 24}), "Number of arcs."), offset}},
                 });
}

}  // namespace hersey::model
