#include <numbers>
#include <utility>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"
#include "schema/kinds/arc_keys.h"
#include "schema/thermal_walls.h"

namespace hersey::model {
namespace {

TypePtr operating_point_format() {
  const TypePtr speed = quantity("rad/s", "3000 rpm"), angle = quantity("rad", "-90 deg"),
                tilt = quantity("rad", "0.01 deg");
  const std::vector<Word> not_given{{"none", "not given; for `--set`"}};
  return object(
      "an operating point",
      {
          required("journal_speed", speed, "Angular velocity of the journal about the bearing's z-axis."),
          defaulted("shell_speed", speed, "0 rpm", "Angular velocity of the shell; the bearing's axes rest."),
          optional("load", or_word(quantity("N", "2500 N", Range::positive()), not_given),
                   "Load on the journal: its position is sought."),
          defaulted("load_angle", angle, "-90 deg", "Direction of the load, from x towards y."),
          optional("eccentricity_ratio", or_word(number("0.6", Range::not_negative()), not_given),
                   "Position of the journal, instead of a load: its load is sought. Below 1 in a round bore; in one of "
                   "lobes as far as the gap stays open."),
          defaulted("eccentricity_angle", angle, "-90 deg", "Direction of that position, from x towards y."),
          defaulted("radial_velocity", quantity("m/s", "20 mm/s"), "0 m/s",
                    "Velocity of the journal's centre in that direction, outwards; with an eccentricity_ratio. Without "
                    "rotation it is pure squeeze."),
          defaulted("journal_angle", angle, "0 deg",
                    "Rotation of the journal, with its holes and grooves: one instant of its revolution."),
          defaulted("tilt_x", tilt, "0 deg", "Slope of the journal's axis towards x."),
          defaulted("tilt_y", tilt, "0 deg", "Slope of the journal's axis towards y."),
      });
}

TypePtr deforming_surface_format() {
  const TypePtr on_mesh = with_exactly_one(
      object("a surface on the mesh of a flexible body",
             {
                 optional("faces", text("a surface or a set of nodes", "big_end"),
                          "Surface or set of nodes of the mesh. Its faces that lie in the bearing's width are taken."),
                 optional("within", quantity("m", "0.1 mm", Range::positive()),
                          "Takes all outer faces whose nodes lie this near to the bearing's cylinder."),
                 optional("functions", list("functions around and along", integer(24, {.low = 1, .high = 200}), 2),
                          "How many smooth functions describe displacement and pressure: around (at least 4) and along "
                          "the axis.",
                          "about one per 1.5 distances of nodes, at most 32 and 5"),
                 optional("modes", integer(60, {.low = 1, .high = 2000}),
                          "How many static answers to film pressures the body keeps, the most compliant ones first.",
                          "60 of a modal body, of a nodal one all above a millionth of the first"),
             }),
      {"faces", "within"});
  return any_of("`rigid`, or a mapping", {choice({{"rigid", "it keeps its shape"}}), on_mesh});
}

}  // namespace

std::vector<Key> journal_keys() {
  const TypePtr diameter = quantity("m", "45 mm", Range::positive());
  const TypePtr width = quantity("m", "20 mm", Range::positive());
  const TypePtr clearance = quantity("m", "34 um", Range::positive());
  const TypePtr edge =
      any_of("a pressure such as 2 bar, `closed`, or {leakage, outside}", {edge_format(), seal_format()});
  const TypePtr edges = any_of("a pressure such as 2 bar, `closed`, {leakage, outside} or {left, right}",
                               {edge_format(), seal_format(),
                                object("two edges", {
                                                        required("left", edge, "At the edge with z < 0."),
                                                        required("right", edge, "At the edge with z > 0."),
                                                    })});
  const TypePtr fill = number("0.5", {.low = 0, .high = 1});
  const TypePtr fills =
      any_of("a number from 0 to 1, or {left, right}",
             {fill, object("two fill fractions", {
                                                     required("left", fill, "At the edge with z < 0."),
                                                     required("right", fill, "At the edge with z > 0."),
                                                 })});
  const TypePtr supply = object(
      "a supply line",
      {
          required(
              "line", or_word(quantity("rad", "180 deg"), {{"widest_gap", "always where the gap is widest"}}),
              "Where oil enters, over the whole width: an angle from the shell's x-axis towards y, or `widest_gap`."),
          defaulted("pressure", bearing_pressure(), "0 Pa", "Supply pressure."),
          optional("temperature", temperature_or_node("50 degC"),
                   "Of its oil, in a bearing with `thermal: {model: film}`.", "`thermal.supply_temperature`"),
      });
  std::vector<Key> keys{
      optional("shell", reference(Refers::frame, "rod.big_end"),
               "Frame on the shell's body: z along the bearing's axis, angles from x towards y.",
               "**required** to simulate"),
      optional("journal", reference(Refers::frame, "crank.pin"), "Frame on the journal's body, z along its axis.",
               "**required** to simulate"),
      required("diameter", diameter, "Bore diameter."),
      required("width", width, "Length of the bearing along its axis."),
      optional("radial_clearance", clearance, "Radius of the bore minus radius of the journal."),
      optional("diametral_clearance", clearance, "Twice the radial clearance, instead of it."),
      defaulted("grid", grid_format(), "{}", "Nodes of the oil film."),
      defaulted("edge_pressure", edges, "0 Pa", "Pressure outside both edges, or walls or seals there."),
      optional("ambient_fill", fills,
               "Share of oil in what surrounds an edge at the cavitation pressure and is drawn in there: 0 air, 1 "
               "oil. An edge above that pressure is always flooded.",
               "0"),
      defaulted("thermal", thermal_format(), "isothermal", "Temperature of the film."),
      optional("supply", supply, "A line along the whole width that is kept full at a given pressure.", "none"),
      optional("features", features_format(), "Holes and grooves through which oil is fed.", "none"),
      optional("bore", bore_format(), "Equal arcs with axial grooves between them, instead of a whole bore.",
               "one whole bore"),
      optional("arcs", arcs_format(), "Arcs one by one, instead of a `bore`; the film ends where an arc does.",
               "one whole bore"),
      optional("shape", shape_format(), "What makes bore and journal differ from cylinders; all add up.", "cylinders"),
      defaulted("shell_surface", deforming_surface_format(), "rigid",
                "Whether the bore deforms as the mesh of the shell's body does."),
      defaulted("journal_surface", deforming_surface_format(), "rigid",
                "Whether the journal deforms as the mesh of its body does."),
      optional("operating_point", operating_point_format(),
               "Speeds and load, or position, of the bearing by itself (`hersey bearing`); a simulation has its "
               "own.",
               "given on the command line"),
  };
  keys.push_back(defaulted("oil_inertia", choice(oil_inertia_words), "none",
                           "Inertia of the oil as an added mass of the journal, which `hersey bearing` reports beside "
                           "stiffness and damping; machines feel that of dampers which are the same all around."));
  keys.push_back(defaulted("shear_force", choice(shear_force_words), "full", "What shear does to the bodies."));
  for (Key& key : surface_keys({})) keys.push_back(std::move(key));
  return keys;
}

}  // namespace hersey::model
