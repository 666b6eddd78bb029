#include <utility>

#include "schema/bearing_keys.h"
#include "schema/oil_laws.h"
#include "schema/restrictor_laws.h"
#include "schema/thermal_walls.h"

// Keys of a pad on a plane runner.
namespace hersey::model {
namespace {

TypePtr pad_shape_format() {
  const TypePtr rise = quantity("m", "20 um", Range::not_negative()), part = quantity("m", "30 mm", Range::positive());
  return list(
      "a list of deviations from a plane",
      variant("a deviation from a plane", "profile", {},
              {
                  {"ramp",
                   "a straight ramp at the leading end; without a length the whole pad is a taper",
                   {required("rise", rise, "By how much the gap is wider at the leading end."),
                    optional("length", part, "How far the ramp goes from the leading end.", "the pad's length")}},
                  {"step",
                   "a step over the whole width, deep at the leading end (Rayleigh)",
                   {required("depth", quantity("m", "15 um", Range::positive()), "Its height."),
                    required("length", part, "How far the deep part goes from the leading end.")}},
                  {"crown",
                   "a parabola along the sliding direction, highest in the middle",
                   {required("drop", rise, "By how much the gap is wider at both ends.")}},
                  {"barrel",
                   "a parabola across the sliding direction, highest in the middle",
                   {required("drop", rise, "By how much the gap is wider at both sides.")}},
              }));
}

TypePtr pad_features_format() {
  const TypePtr extent = quantity("m", "8 mm", Range::positive()), place = quantity("m", "5 mm");
  const std::vector<Key> common = {
      defaulted("y", place, "0 mm", "Its middle along the sliding direction, from the pad's middle."),
      defaulted("z", place, "0 mm", "Its middle across the sliding direction."),
      optional("pressure", function_format({"Pa"}, "20 bar"),
               "Supply pressure; a function of time or of the rotation of `simulation.crank`.",
               "not fed: a pocket of the given depth"),
      circuit_node_key(),
      restrictor_key(),
      defaulted("depth", quantity("m", "0.5 mm", Range::not_negative()), "0 mm",
                "By how much it widens the gap, and its friction falls; 0 leaves the gap as it is."),
      optional("temperature", temperature_or_node("50 degC"),
               "Of the oil that feeds it, in a film with `thermal: {model: film}`.", "`thermal.supply_temperature`"),
  };
  return named("a mapping from names to holes and pockets of the pad",
               variant("a hole or pocket", "shape", common,
                       {
                           {"hole", "a round hole", {required("diameter", extent, "Its diameter.")}},
                           {"pocket",
                            "a rectangular recess",
                            {required("along", extent, "Its extent along the sliding direction."),
                             optional("across", extent, "Its extent across it.", "the pad's width")}},
                       }));
}

TypePtr pad_edges_format() {
  const TypePtr edge = edge_format();
  return any_of("a pressure such as 2 bar, `closed`, or {leading, trailing, left, right}",
                {edge, object("four edges", {
                                                required("leading", edge,
                                                         "At the end y = -length/2, where the runner "
                                                         "comes in at a positive speed."),
                                                required("trailing", edge, "At the end y = +length/2."),
                                                required("left", edge, "At the side z = -width/2."),
                                                required("right", edge, "At the side z = +width/2."),
                                            })});
}

TypePtr pad_grid_format() {
  return object("a grid", {
                              defaulted("along", integer(60, {.low = 4, .high = 100000}), "60",
                                        "Nodes along the sliding direction, both ends included."),
                              defaulted("across", integer(13, {.low = 3, .high = 100000}), "13",
                                        "Nodes over the width, both sides included."),
                          });
}

TypePtr pad_point_format() {
  const TypePtr slope = quantity("rad", "0.02 deg");
  const std::vector<Word> not_given{{"none", "not given; for `--set`"}};
  return object(
      "an operating point",
      {
          required("speed", quantity("m/s", "3 m/s"),
                   "Of the runner along the pad's y-axis: positive from the leading to the trailing end."),
          optional("load", or_word(quantity("N", "5 kN", Range::positive()), not_given),
                   "Load that presses pad and runner together: the film thickness is sought."),
          optional("film_thickness", or_word(quantity("m", "20 um", Range::positive()), not_given),
                   "Smallest distance of the surfaces before anything deforms, instead of a load: its load is sought."),
          defaulted("approach_speed", quantity("m/s", "10 mm/s"), "0 m/s",
                    "Of pad and runner towards each other; with a film_thickness. Without sliding it is pure squeeze."),
          defaulted("tilt_along", slope, "0 deg",
                    "Slope of the pad along the sliding direction; positive: the gap is wider at the leading end."),
          defaulted("tilt_across", slope, "0 deg",
                    "Slope across the sliding direction; positive: the gap is wider at z < 0."),
      });
}

}  // namespace

std::vector<Key> plane_slider_keys() {
  const TypePtr size = quantity("m", "50 mm", Range::positive());
  std::vector<Key> keys{
      optional("pad", reference(Refers::frame, "carriage.pad"),
               "Frame on the pad's body, in the middle of its face: x from the film into the pad, y along the sliding "
               "direction.",
               "**required** to simulate"),
      optional("runner", reference(Refers::frame, "bed.way"),
               "Frame on the runner's body: its plane x = 0 is the runner's surface, x towards the pad.",
               "**required** to simulate"),
      required("length", size, "Of the pad along the sliding direction."),
      required("width", size, "Of the pad across the sliding direction."),
      optional("reference_film_thickness", quantity("m", "20 um", Range::positive()),
               "Film thickness in which steps and errors are measured; the solution does not depend on it.",
               "a two-thousandth of the length"),
      defaulted("grid", pad_grid_format(), "{}", "Nodes of the oil film."),
      defaulted("edge_pressure", pad_edges_format(), "0 Pa", "Pressure outside the edges, or walls there."),
      defaulted(
          "ambient_fill", number("0.5", {.low = 0, .high = 1}), "1",
          "Share of oil in what surrounds edges at the cavitation pressure and is drawn in there: 1 an immersed or "
          "flooded slider, 0 air."),
      optional("temperature", temperature("60 degC"), "Of the oil, where it has one temperature.",
               "that of the lubricant"),
      defaulted("thermal", flat_thermal_format({.fixed = "pad", .moving = "runner"}), "isothermal",
                "Temperature of the film."),
      optional("features", pad_features_format(), "Holes and pockets of the pad.", "none"),
      optional("shape", pad_shape_format(), "What makes the pad's face differ from a plane; all add up.", "a plane"),
      optional(
          "operating_point", pad_point_format(),
          "Speed and load, or film thickness, of the slider by itself (`hersey bearing`); a simulation has its own.",
          "given on the command line"),
  };
  const SurfaceKeys surfaces{.fixed = "pad", .of_fixed = "The pad.", .moving = "runner", .of_moving = "The runner."};
  for (Key& key : surface_keys(surfaces)) keys.push_back(std::move(key));
  return keys;
}

}  // namespace hersey::model
