#include <utility>

#include "schema/bearing_keys.h"
#include "schema/oil_laws.h"

// Keys of a piston's skirt in its liner.
namespace hersey::model {
namespace {

TypePtr skirt_shape_format() {
  const TypePtr drop = quantity("m", "30 um", Range::not_negative());
  return list(
      "a list of deviations of a skirt from a cylinder",
      variant(
          "a deviation of a skirt from a cylinder", "profile", {},
          {
              {"barrel",
               "two parabolas along the axis that meet where the skirt is widest",
               {required("top", drop, "By how much the skirt lies back at the end next to the crown."),
                required("bottom", drop, "The same at the other end."),
                defaulted("apex", quantity("m", "-2 mm"), "0 mm",
                          "z of the widest place, from the middle of the skirt's length towards the crown.")}},
              {"ovality",
               "a skirt that is narrower along the pin than across it: drop sin^2 of the angle from the thrust side",
               {required("top", drop, "How far it lies back in the pin's direction, at the end next to the crown."),
                required("bottom", drop, "The same at the other end; linear in between.")}},
              {"table",
               "a measured profile: columns angle (from the thrust side), z and opening, as of a journal's shape",
               {required("file", text("a file name", "skirt.csv"),
                         "CSV file beside the model; an opening for every angle at every z, over both sides and the "
                         "whole length, smooth around and straight along.")}},
          }));
}

TypePtr skirt_point_format() {
  const TypePtr offset = or_word(quantity("m", "20 um"), {{"none", "not given; for `--set`"}});
  const TypePtr velocity = quantity("m/s", "20 mm/s");
  return object(
      "an operating point",
      {
          required("speed", quantity("m/s", "-8 m/s"), "Of the skirt along its z-axis: positive towards the crown."),
          optional(
              "offset_top", offset,
              "How far the skirt's axis is off the liner's towards the thrust side, at the end next to the crown."),
          optional("offset_bottom", offset, "The same at the other end; both are given, or a side_force."),
          defaulted("velocity_top", velocity, "0 m/s", "At which offset_top grows; with offsets."),
          defaulted("velocity_bottom", velocity, "0 m/s", "At which offset_bottom grows; with offsets."),
          optional("side_force", or_word(quantity("N", "1 kN"), {{"none", "not given; for `--set`"}}),
                   "That presses the skirt towards the thrust side, negative towards the other: its offset is sought."),
          defaulted("tilt", quantity("rad", "0.01 deg"), "0 deg",
                    "With a side_force: slope of the skirt's axis; positive: its top is nearer to the thrust side."),
      });
}

TypePtr skirt_edges_format(const TypePtr& edge, const std::string& what) {
  return any_of(what + ", or {top, bottom, sides}",
                {edge, object("three edges", {
                                                 required("top", edge, "At the end next to the crown."),
                                                 required("bottom", edge, "At the other end."),
                                                 required("sides", edge, "At the ends of both sides' arcs."),
                                             })});
}

TypePtr skirt_oil_format() {
  const TypePtr layer = or_word(quantity("m", "5 um", Range::not_negative()),
                                {{"flooded", "the liner there lies in oil: the film draws in what it can"}});
  return any_of(
      "the thickness of a layer of oil on the liner, `flooded`, or {top, bottom, sides}",
      {layer,
       object(
           "the oil that each edge meets",
           {
               required("top", layer,
                        "Layer on the liner that the edge next to the crown runs into on its way up: what the oil "
                        "ring has left."),
               required("bottom", layer,
                        "Layer that the other edge runs into on its way down: what the crankcase has thrown onto the "
                        "liner."),
               defaulted("sides",
                         choice({{"dry", "no oil comes in there"},
                                 {"flooded", "beside the arcs there is oil that the film draws in"}}),
                         "dry", "Ends of both sides' arcs."),
           })});
}

}  // namespace

std::vector<Key> skirt_keys() {
  const TypePtr size = quantity("m", "85 mm", Range::positive());
  const TypePtr clearance = quantity("m", "40 um", Range::positive());
  const TypePtr arc = quantity("rad", "80 deg", {.low = 0, .high = 3.1, .low_open = true});
  std::vector<Key> keys{
      optional("skirt", reference(Refers::frame, "piston.skirt"),
               "Frame on the piston's body: origin on the skirt's axis at half of its length, x towards the thrust "
               "side, z along the axis towards the crown.",
               "**required** to simulate"),
      optional("liner", reference(Refers::frame, "ground.liner"),
               "Frame whose z-axis is the liner's axis, along the skirt's; its origin may lie anywhere on it.",
               "**required** to simulate"),
      required("diameter", size, "Of the liner."),
      required("length", quantity("m", "45 mm", Range::positive()), "Of the skirt along its axis."),
      optional(
          "radial_clearance", clearance,
          "Difference of the radii of liner and skirt where the skirt is widest. Give this or diametral_clearance."),
      optional("diametral_clearance", clearance, "The same of the diameters."),
      defaulted("arc", arc, "80 deg", "Angle that the film of the thrust side covers, half of it on either side."),
      optional("arc_antithrust", arc, "Angle of the film on the opposite side.", "`arc`"),
      defaulted("grid",
                object("a grid",
                       {
                           defaulted("around", integer(25, {.low = 4, .high = 100000}), "25",
                                     "Nodes around each of both sides, both ends included."),
                           defaulted("along", integer(41, {.low = 3, .high = 100000}), "41",
                                     "Nodes along the axis, both ends included."),
                       }),
                "{}", "Nodes of the oil film."),
      defaulted("edge_pressure", skirt_edges_format(edge_format(), "a pressure such as 0.1 bar, `closed`"), "0 Pa",
                "Pressure outside the edges, or walls there."),
      defaulted("ambient_fill", skirt_edges_format(number("0.5", {.low = 0, .high = 1}), "a number from 0 to 1"), "1",
                "Fraction of oil in what surrounds edges at the cavitation pressure and is drawn in there: 1 a flooded "
                "skirt, 0 a dry liner."),
      optional("oil", skirt_oil_format(),
               "Oil on the liner before the skirt, in place of `ambient_fill`: a layer brings its thickness times the "
               "skirt's speed over the edge that leads. What finds no room is scraped off, and where it does not fill "
               "the gap the skirt is starved.",
               "as `ambient_fill` says"),
      optional("temperature", temperature("100 degC"), "Of the oil.", "that of the lubricant"),
      optional("shape", skirt_shape_format(), "What makes the skirt differ from a cylinder; all add up.", "a cylinder"),
      optional("liner_shape",
               object("a measured bore",
                      {required("file", text("a file name", "liner.csv"),
                                "CSV file beside the model with the columns angle, z and opening, in the axes of the "
                                "liner's frame: an opening for every angle at every z; constant beyond these z.")}),
               "How the liner differs from a cylinder, distorted or hot; by itself the skirt's middle is at its z = 0.",
               "a cylinder"),
      optional("operating_point", skirt_point_format(),
               "Position and motion of the skirt by itself (`hersey bearing`); a simulation has its own.",
               "given on the command line"),
  };
  const SurfaceKeys surfaces{.fixed = "skirt", .of_fixed = "The skirt.", .moving = "liner", .of_moving = "The liner."};
  for (Key& key : surface_keys(surfaces)) keys.push_back(std::move(key));
  return keys;
}

}  // namespace hersey::model
