#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"
#include "schema/kinds/arc_keys.h"

// Keys of a bearing of tilting pads: those of its pads and pivots, and what each pad's film has in common with a
// journal bearing.
namespace hersey::model {
namespace {

TypePtr pads_format() {
  const TypePtr angle = quantity("rad", "-90 deg"), length = quantity("m", "20 mm", Range::positive());
  const TypePtr moment = quantity("kg.m^2", "1e-3 kg.m^2", Range::not_negative());
  std::vector<Key> keys{
      required("count", integer(5, {.low = 1, .high = 24}), "Number of pads."),
      required("arc", quantity("rad", "60 deg", Range::positive()), "Whole angle of each pad."),
      optional("preload", number("0.5", {.low = -10, .high = 1}),
               "1 - c_b/c_p, below 1: c_b the assembled clearance, between pivot and central journal, c_p the machined "
               "one.",
               "0"),
      optional("machined_clearance", quantity("m", "150 um", Range::positive()),
               "Radius of the pads' own circles minus radius of the journal, c_p, instead of a preload."),
      defaulted("offset", number("0.5", {.low = 0, .high = 1, .low_open = true, .high_open = true}), "0.5",
                "Angle from the leading end to the pivot over the whole arc: 0.5 in the middle, 0.6 for a journal that "
                "rotates from x towards y."),
      defaulted("load",
                choice({{"between_pads", "`load_angle` lies between two pivots"},
                        {"on_pad", "`load_angle` passes through a pivot"}}),
                "between_pads", "How the pads lie to the load."),
      defaulted("load_angle", angle, "-90 deg", "Direction that `load` means, from the shell's x-axis towards y."),
      optional("pivot_angles", list("angles, one for each pad", angle),
               "Where the pivots are, from the shell's x-axis towards y.", "evenly around, as `load` says"),
      optional("thickness", length, "From a pad's face to its pivot.", "a fifth of the diameter"),
      defaulted("density", quantity("kg/m^3", "7850 kg/m^3", Range::not_negative()), "7850 kg/m^3",
                "Gives mass and moments of inertia of pads of that thickness; 0: pads without mass."),
      optional("mass", quantity("kg", "0.5 kg", Range::not_negative()), "Of one pad.", "from `density`"),
      optional("inertia", moment, "Moment of inertia of one pad about an axis along the bearing through its pivot.",
               "from `density`"),
  };
  keys.push_back(optional(
      "elastic",
      object(
          "an elastic pad",
          {required("youngs_modulus", quantity("Pa", "210 GPa", Range::positive()), "Young's modulus."),
           defaulted("poisson_ratio", number("0.3", {.low = -1, .high = 0.5, .low_open = true, .high_open = true}),
                     "0.3", "Poisson's ratio."),
           optional("seat", quantity("m", "10 mm", Range::positive()),
                    "Length around, on a pad's back, over which a pivot bears; of pads that pitch along the bearing, "
                    "too.",
                    "a quarter of the thickness"),
           defaulted("elements", list("three numbers", integer(12, {.low = 1, .high = 1000}), 3), "[12, 4, 2]",
                     "Quadratic elements around, along and through a pad."),
           defaulted("modes", integer(16, {.low = 1, .high = 1000}), "16",
                     "How many static shapes of a pad under pressures of its film, the most compliant ones.")}),
      "Pads bend under their films' pressure: each is a mesh of its own, with the mass of `density`.", "rigid"));
  for (Key& key : arc_end_keys()) keys.push_back(std::move(key));
  return object("the pads", std::move(keys));
}

/// Keys of pivots that pads around a journal have.
std::vector<Key> pivot_keys() {
  return {
      defaulted("pitch",
                choice({{"no", "pads roll about lines along the bearing"},
                        {"yes", "pads stand on points and follow a tilted journal, too"}}),
                "no", "Whether pads tilt along the bearing."),
      defaulted("damping", quantity("N.s/m", "1e4 N.s/m", Range::not_negative()), "0 N.s/m",
                "Of a pivot that yields, along the radius."),
      defaulted("friction_torque", quantity("N.m", "5 N.m", Range::not_negative()), "0 N.m",
                "Of dry friction that resists rolling: coefficient times force on the pivot times radius of ball or "
                "rocker."),
  };
}

}  // namespace

std::vector<Key> tilting_pad_keys() {
  std::vector<Key> keys;
  for (Key& key : journal_keys()) {
    if (key.name == "shell" || key.name == "journal" || is_key_of_each_pad("tilting_pad", key.name))
      keys.push_back(std::move(key));
  }
  const auto at = std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.name == "grid"; });
  keys.insert(at, {required("pads", pads_format(), "Number, size and place of the pads."),
                   defaulted("pivot", pivot_format(pivot_keys()), "{type: rigid}", "What the pads stand on.")});
  keys.push_back(optional("operating_point", composite_point_format("the assembled clearance", "the pads"),
                          "Speed and load, or position, of the bearing by itself (`hersey bearing`); a simulation has "
                          "its own.",
                          "given on the command line"));
  return keys;
}

}  // namespace hersey::model
