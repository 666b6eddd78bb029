#include <numbers>
#include <utility>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"
#include "schema/oil_laws.h"
#include "schema/restrictor_laws.h"
#include "schema/thermal_walls.h"

// Keys of pads in sectors of an annulus, below a runner that turns about the axis.
namespace hersey::model {
namespace {

TypePtr sector_arc() {
  return quantity("rad", "50 deg", {.low = 0, .high = 2 * std::numbers::pi + 1e-9, .low_open = true});
}

TypePtr sector_shape_format() {
  const TypePtr drop = quantity("m", "20 um", Range::not_negative());
  const TypePtr part = sector_arc(), slope = quantity("rad", "0.02 deg");
  return list(
      "a list of deviations from the stator's plane",
      variant(
          "a deviation from the stator's plane", "profile", {},
          {
              {"ramp",
               "a ramp at the leading edge, equally high at all radii; without an arc the whole pad is a taper, with "
               "one it is a taper with a land",
               {required("rise", drop, "By how much the gap is wider at the leading edge."),
                optional("arc", part, "How far the ramp goes from the leading edge.", "the pad's arc")}},
              {"step",
               "a step over the whole width, deep at the leading edge (Rayleigh)",
               {required("depth", quantity("m", "15 um", Range::positive()), "Its height."),
                required("arc", part, "How far the deep part goes from the leading edge.")}},
              {"crown",
               "a parabola in the sense of rotation, highest in the middle of the pad",
               {required("drop", drop, "By how much the gap is wider at leading and trailing edge.")}},
              {"barrel",
               "a parabola along the radius, highest at the mean radius",
               {required("drop", drop, "By how much the gap is wider at inner and outer edge.")}},
              {"cone",
               "a gap that widens linearly with the radius",
               {required("rise", quantity("m", "10 um"),
                         "From the inner to the outer edge; negative: it widens towards the inner edge.")}},
              {"incline",
               "a flat face, inclined about the point at the pad's mean angle and mean radius",
               {defaulted("along", slope, "0 deg",
                          "Slope in the sense of rotation; positive: the gap is wider at the leading edge."),
                defaulted("across", slope, "0 deg",
                          "Slope along the radius; positive: the gap is wider at the outer edge.")}},
          }));
}

TypePtr sector_features_format() {
  const TypePtr extent = quantity("m", "8 mm", Range::positive());
  const std::vector<Key> common = {
      required("angle", quantity("rad", "20 deg"), "Its middle, from the stator's x-axis towards y."),
      optional("radius", quantity("m", "75 mm", Range::positive()), "Its middle, from the axis.", "the mean radius"),
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
  return named("a mapping from names to holes, pockets and grooves of the stator",
               variant("a hole, pocket or groove", "shape", common,
                       {
                           {"hole", "a round hole", {required("diameter", extent, "Its diameter.")}},
                           {"pocket",
                            "a recess in a sector",
                            {required("arc", sector_arc(), "Its extent around the axis."),
                             optional("width", extent, "Its extent along the radius.", "that of the annulus")}},
                       }));
}

TypePtr sector_edges_format() {
  const TypePtr edge = edge_format();
  return any_of(
      "a pressure such as 2 bar, `closed`, or {leading, trailing, inner, outer}",
      {edge,
       object("four edges", {
                                defaulted("leading", edge, "0 Pa", "In the grooves before the leading edges of pads."),
                                defaulted("trailing", edge, "0 Pa", "In the grooves behind the trailing edges."),
                                defaulted("inner", edge, "0 Pa", "At the inner radius."),
                                defaulted("outer", edge, "0 Pa", "At the outer radius."),
                            })});
}

TypePtr sector_fills_format() {
  const TypePtr fill = number("0.5", {.low = 0, .high = 1});
  return any_of("a number from 0 to 1, or {leading, trailing, inner, outer}",
                {fill, object("four fill fractions",
                              {
                                  defaulted("leading", fill, "1", "In the grooves before the leading edges of pads."),
                                  defaulted("trailing", fill, "1", "In the grooves behind the trailing edges."),
                                  defaulted("inner", fill, "1", "At the inner radius."),
                                  defaulted("outer", fill, "1", "At the outer radius."),
                              })});
}

TypePtr thrust_grid_format() {
  return object("a grid", {
                              optional("along", integer(40, {.low = 4, .high = 100000}),
                                       "Nodes along each pad, both edges included; of a washer, around it.",
                                       "41; of a washer 120"),
                              defaulted("radial", integer(21, {.low = 3, .high = 100000}), "21",
                                        "Nodes along the radius, both edges included."),
                          });
}

TypePtr thrust_point_format() {
  const TypePtr slope = quantity("rad", "0.01 deg");
  const std::vector<Word> not_given{{"none", "not given; for `--set`"}};
  return object(
      "an operating point",
      {
          required("speed", quantity("rad/s", "3000 rpm"),
                   "Of the runner about the stator's z-axis: positive from x towards y."),
          optional("load", or_word(quantity("N", "5 kN", Range::positive()), not_given),
                   "Load that presses runner and stator together: the film thickness is sought."),
          optional("film_thickness", or_word(quantity("m", "20 um", Range::positive()), not_given),
                   "Smallest distance of the surfaces before anything deforms, instead of a load: its load is sought."),
          defaulted("approach_speed", quantity("m/s", "10 mm/s"), "0 m/s",
                    "Of runner and stator towards each other; with a film_thickness. Without rotation it is pure "
                    "squeeze."),
          defaulted("tilt_x", slope, "0 deg",
                    "Slope of the runner's axis towards x; positive: the gap is narrower at x > 0."),
          defaulted("tilt_y", slope, "0 deg",
                    "Slope of the runner's axis towards y; positive: the gap is narrower at y > 0."),
      });
}

}  // namespace

std::vector<Key> thrust_keys() {
  const TypePtr size = quantity("m", "100 mm", Range::positive()), angle = quantity("rad", "0 deg");
  const std::vector<Word> senses{{"positive", "from x towards y"}, {"negative", "from y towards x"}};
  std::vector<Key> keys{
      optional("stator", reference(Refers::frame, "housing.thrust"),
               "Frame on the body that carries the pads: its origin on the axis in their plane, z from there into the "
               "film, towards the runner.",
               "**required** to simulate"),
      optional("runner", reference(Refers::frame, "shaft.collar"),
               "Frame on the runner's body: its plane z = 0 is the runner's face, z along the stator's.",
               "**required** to simulate"),
      required("inner_diameter", size, "Of the pads."),
      required("outer_diameter", size, "Of the pads."),
      optional(
          "pads",
          object("equal pads",
                 {
                     required("count", integer(6, {.low = 1, .high = 1000}), "How many there are."),
                     required("arc", sector_arc(), "Angle of each; what is left are grooves between them."),
                     defaulted("angle", angle, "0 deg", "Middle of the first pad, from the stator's x-axis towards y."),
                 }),
          "Equal pads with radial grooves between them.", "a whole washer"),
      optional("sectors",
               named("a mapping from names to pads",
                     object("a pad",
                            {
                                required("middle", angle, "Its middle, from the stator's x-axis towards y."),
                                required("arc", sector_arc(), "Its whole angle."),
                            })),
               "Pads at places and of sizes of their own, instead of `pads`.", "none"),
      defaulted("sense", choice(senses), "positive",
                "Sense of rotation that the pads are made for: it tells the leading from the trailing edge."),
      optional("shape", sector_shape_format(), "What makes the pads' faces differ from the stator's plane; all add up.",
               "a plane"),
      optional("reference_film_thickness", quantity("m", "20 um", Range::positive()),
               "Film thickness in which steps and errors are measured; the solution does not depend on it.",
               "a thousandth of the annulus' width"),
      defaulted("grid", thrust_grid_format(), "{}", "Nodes of the oil film."),
      defaulted("edge_pressure", sector_edges_format(), "0 Pa", "Pressure outside the edges, or walls there."),
      defaulted("ambient_fill", sector_fills_format(), "1",
                "Share of oil in what surrounds edges at the cavitation pressure and is drawn in there: 1 a flooded "
                "bearing, 0 air."),
      optional("edge_flow", quantity("m^3/s", "0.4 L/min", Range::not_negative()),
               "All the oil that reaches each leading edge, at the cavitation pressure: what a pad has no room for is "
               "lost, and where it could draw more it is starved; in place of the leading `ambient_fill`.",
               "as much as the film draws"),
      optional("temperature", temperature("60 degC"), "Of the oil, where it has one temperature.",
               "that of the lubricant"),
      defaulted("thermal", flat_thermal_format({.fixed = "stator", .moving = "runner"}), "isothermal",
                "Temperature of the film."),
      optional("features", sector_features_format(), "Holes, pockets and grooves of the stator.", "none"),
      optional("operating_point", thrust_point_format(),
               "Speed and load, or film thickness, of the bearing by itself (`hersey bearing`); a simulation has its "
               "own.",
               "given on the command line"),
      defaulted("shear_force", choice(shear_force_words), "full", "What the film's shear does to the bodies."),
  };
  const SurfaceKeys surfaces{
      .fixed = "stator", .of_fixed = "The pads.", .moving = "runner", .of_moving = "The runner."};
  for (Key& key : surface_keys(surfaces)) keys.push_back(std::move(key));
  return keys;
}

}  // namespace hersey::model
