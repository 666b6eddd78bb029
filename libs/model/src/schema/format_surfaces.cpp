#include <numbers>

#include "schema/film_vocabulary.h"
#include "schema/format.h"
#include "schema/oil_laws.h"
#include "schema/profile_shapes.h"
#include "schema/restrictor_laws.h"
#include "schema/thermal_walls.h"

// Format of the two surfaces of a bearing and of the grid between them.
namespace hersey::model {

TypePtr features_format() {
  const TypePtr extent = quantity("m", "5 mm", Range::positive());
  const Range full_circle{.low = 0, .high = 2 * std::numbers::pi + 1e-9, .low_open = true};
  const TypePtr arc = quantity("rad", "20 deg", full_circle);
  const std::vector<Key> common = {
      defaulted("on", choice(feature_surface_words), "shell", "The surface it is made in."),
      defaulted("angle", quantity("rad", "90 deg"), "0 deg",
                "Its middle, from the x-axis of that surface's frame towards y."),
      defaulted("z", quantity("m", "0 mm"), "0 mm", "Its middle along the axis, from the middle of the bearing."),
      optional(
          "pressure", function_format({"Pa"}, "2 bar"),
          "Supply pressure; a function of time or of the rotation of `simulation.crank`. Where feeds touch, a supply "
          "line or an edge included, they need one pressure: what flows between two depends on the grid.",
          "not fed: a pocket of the given depth"),
      circuit_node_key(),
      restrictor_key(),
      defaulted("depth", quantity("m", "0.5 mm", Range::not_negative()), "0 mm",
                "By how much it widens the gap, and its friction falls; 0 leaves the gap as it is."),
      optional("temperature", temperature_or_node("50 degC"),
               "Of the oil that feeds it, in a bearing with `thermal: {model: film}`.", "`thermal.supply_temperature`"),
  };
  return named("a mapping from names to holes, grooves and pockets",
               variant("a hole, groove or pocket", "shape", common,
                       {
                           {"hole", "a round hole", {required("diameter", extent, "Its diameter.")}},
                           {"oval_hole",
                            "an elliptical hole",
                            {required("around", extent, "Its axis around the bearing, measured along the surface."),
                             required("along", extent, "Its axis along the bearing.")}},
                           {"axial_groove",
                            "a rectangle, over the whole width unless a length is given",
                            {required("arc", arc, "Its extent around the bearing."),
                             optional("length", extent, "Its extent along the axis.", "the bearing's width")}},
                           {"circumferential_groove",
                            "a rectangle, all around unless an arc is given",
                            {required("length", extent, "Its extent along the axis."),
                             defaulted("arc", arc, "360 deg", "Its extent around the bearing.")}},
                           {"pocket",
                            "a rectangular recess",
                            {required("arc", arc, "Its extent around the bearing."),
                             required("length", extent, "Its extent along the axis.")}},
                       }));
}

TypePtr shape_format() {
  std::vector<Variant> shapes = variants_of(profile_shapes());
  shapes.push_back(
      {"table",
       "a measured surface: smooth around the bearing, straight lines along it",
       {required(
           "file", text("a file", "bore.csv"),
           "CSV file beside the model file with the columns `angle`, `z` and `opening`, units in brackets: by how "
           "much the gap is wider than that of the clearance at every combination of the angles, which lie "
           "within 360 deg, and the heights.")}});
  const Key on = defaulted("on", choice(profile_surface_words), "shell", "The surface that has it.");
  return list("a list of deviations from a cylinder",
              variant("a deviation from a cylinder", "profile", {on}, std::move(shapes)));
}

TypePtr grid_format() {
  const TypePtr reach = quantity("m", "2 mm", Range::positive());
  const Key factor = defaulted("factor", number("3", {.low = 1, .high = 100}), "3",
                               "By how much cells are smaller there than far away, about.");
  const TypePtr refine = list(
      "a list of regions towards which cells get smaller",
      variant("a region to refine", "towards", {factor},
              {
                  {"edges",
                   "both edges of the bearing",
                   {optional("reach", reach, "How far from there half of it has gone.", "an eighth of the width")}},
                  {"features",
                   "the borders of holes and grooves; around the bearing of those in the shell only",
                   {optional("reach", reach, "How far from there half of it has gone.", "a quarter of the feature")}},
                  {"angle",
                   "an angle, such as that of the thinnest film to be expected",
                   {required("angle", quantity("rad", "180 deg"), "From the shell's x-axis towards y."),
                    defaulted("reach", quantity("rad", "20 deg", Range::positive()), "20 deg",
                              "How far from there half of it has gone.")}},
              }));
  return object(
      "a grid",
      {
          defaulted("circumferential", integer(60, {.low = 4, .high = 100000}), "60", "Nodes around the bearing."),
          defaulted("axial", integer(13, {.low = 3, .high = 100000}), "13",
                    "Nodes over the width, both edges included."),
          optional("refine", refine, "Where cells are smaller; the numbers of nodes stay.", "equal spacing"),
      });
}

}  // namespace hersey::model
