#include "schema/film_vocabulary.h"
#include "schema/format.h"
#include "schema/oil_laws.h"
#include "schema/thermal_walls.h"

namespace hersey::model {
namespace {

TypePtr pressure() { return quantity("Pa", "2 bar"); }
TypePtr modulus() { return called(quantity("Pa", "57 GPa", Range::positive()), "an elastic modulus"); }

Key composite_modulus_key() {
  return optional("composite_modulus", modulus(), "E of 1/E = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.", "from `materials`");
}

TypePtr cavitation_format() {
  const auto pressure_key = defaulted("pressure", pressure(), "0 Pa",
                                      "Pressure in the cavitated film, on the scale of all other pressures of the "
                                      "bearing (gauge or absolute).");
  return variant("a cavitation model", "model", {pressure_key}, variants_of(cavitation_words));
}

TypePtr asperities_format() {
  const auto keys = std::vector<Key>{
      optional("roughness", quantity("m", "1 um", Range::positive()),
               "sigma, rms height of the asperity summits of both surfaces together.",
               "rms height of both surfaces in the bearing's `roughness`"),
      defaulted("mean_summit_height", quantity("m", "1.5 um", Range::not_negative()), "0 um",
                "delta, of the summits' mean plane above the mean planes of both surfaces together, at most 4 sigma: "
                "contact sees (h - delta)/sigma."),
      defaulted("elastic_factor", number("3e-3", Range::not_negative()), "3e-3", "K in p = K E F((h - delta)/sigma)."),
      composite_modulus_key(),
      defaulted("friction", number("0.1", Range::not_negative()), "0.1", "Coefficient of boundary friction."),
  };
  std::vector<Variant> models = variants_of(asperity_words);
  for (Variant& model : models)
    if (model.tag != "none") model.keys = keys;
  return variant("an asperity model", "model", {}, std::move(models));
}

TypePtr roughness_format() {
  const TypePtr surface = object(
      "a rough surface",
      {
          required("sigma", quantity("m", "0.8 um", Range::positive()), "Its rms height."),
          defaulted("gamma", number("1", {.low = 0.11, .high = 9}), "1",
                    "Peklenik's ratio: how much longer its features are around the bearing than along it. Ridges "
                    "around, as from turning: 9; along the axis: 0.11; no direction: 1."),
      });
  return object("the roughness of both surfaces",
                {
                    optional("shell", surface, "The bore.", "smooth"),
                    optional("journal", surface, "The journal.", "smooth"),
                    defaulted("flow_factors", choice(flow_factor_words), "patir_cheng", "What it does to the oil."),
                });
}

TypePtr compliance_format() {
  return variant("a compliance model", "model", {},
                 {
                     {"rigid", "surfaces keep their shape", {}},
                     {"column",
                      "each point deforms independently, as a column: dh = p length/E",
                      {
                          composite_modulus_key(),
                          optional("length", quantity("m", "22.5 mm", Range::positive()), "Length of the columns.",
                                   "the bearing's radius"),
                      }},
                 });
}

TypePtr materials_format() {
  const TypePtr material = with_together(
      object("a material",
             {
                 required("youngs_modulus", modulus(), "Young's modulus."),
                 required("poisson_ratio", number("0.3", {.low = -1, .high = 0.5, .low_open = true, .high_open = true}),
                          "Poisson's ratio."),
                 defaulted("density", quantity("kg/m^3", "7850 kg/m^3", Range::not_negative()), "0",
                           "Density; not used by rigid bodies."),
                 optional("conductivity", quantity("W/m/K", "50 W/m/K", Range::positive()),
                          "Of heat, at the surface that rubs (of the lining): both surfaces share the heat that "
                          "asperities make by sqrt(conductivity density specific_heat).",
                          "steel: 50 W/m/K, 3.6 MJ/m^3/K"),
                 optional("specific_heat", quantity("J/kg/K", "460 J/kg/K", Range::positive()), "Likewise.",
                          "that of steel"),
             }),
      {"conductivity", "specific_heat"});
  return object("two materials", {
                                     required("shell", material, "Of the bearing shell."),
                                     required("journal", material, "Of the journal."),
                                 });
}

TypePtr coupling_format() {
  return variant(
      "a coupling", "scheme", {},
      {
          {"monolithic", "bodies and film in one Newton system", {}},
          {"partitioned",
           "bodies and film alternately, exchanging force and motion until both agree",
           {
               defaulted("acceleration", choice(acceleration_words), "quasi_newton",
                         "How the exchanged force is corrected."),
               defaulted("relaxation", number("0.1", {.low = 0, .high = 1, .low_open = true}), "0.1",
                         "Share of the first correction of the force that is taken."),
               defaulted("max_iterations", integer(50, {.low = 1, .high = 10000}), "50", "Exchanges per step."),
           }},
      });
}

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

TypePtr bearings_format() {
  const TypePtr diameter = quantity("m", "45 mm", Range::positive());
  const TypePtr width = quantity("m", "20 mm", Range::positive());
  const TypePtr clearance = quantity("m", "34 um", Range::positive());
  const TypePtr edge =
      or_word(pressure(), {{"closed",
                            "no oil passes: at both edges a bearing of infinite width, at one a cap or a "
                            "plane of symmetry"}});
  const TypePtr edges = any_of("a pressure such as 2 bar, `closed`, or {left, right}",
                               {edge, object("two edges", {
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
          defaulted("pressure", pressure(), "0 Pa", "Supply pressure."),
          optional("temperature", temperature_or_node("50 degC"),
                   "Of its oil, in a bearing with `thermal: {model: film}`.", "`thermal.supply_temperature`"),
      });
  const TypePtr bearing = object(
      "a bearing",
      {
          optional("shell", reference(Refers::frame, "rod.big_end"),
                   "Frame on the shell's body: z along the bearing's axis, angles from x towards y.",
                   "**required** to simulate"),
          optional("journal", reference(Refers::frame, "crank.pin"), "Frame on the journal's body, z along its axis.",
                   "**required** to simulate"),
          required("diameter", diameter, "Bore diameter."),
          required("width", width, "Length of the bearing along its axis."),
          optional("radial_clearance", clearance, "Radius of the bore minus radius of the journal."),
          optional("diametral_clearance", clearance, "Twice the radial clearance, instead of it."),
          required("lubricant", reference(Refers::lubricant, "oil"), "Name of the oil."),
          defaulted("grid", grid_format(), "{}", "Nodes of the oil film."),
          defaulted("pressures", choice(pressure_scale_words), "gauge",
                    "The scale on which all pressures of this bearing are given and reported."),
          defaulted("cavitation", cavitation_format(), "mass_conserving", "Where the film would be under tension."),
          defaulted("edge_pressure", edges, "0 Pa", "Pressure outside both edges, or walls there."),
          optional("ambient_fill", fills,
                   "Share of oil in what surrounds an edge at the cavitation pressure and is drawn in there: 0 air, 1 "
                   "oil. An edge above that pressure is always flooded.",
                   "0"),
          defaulted("thermal", thermal_format(), "isothermal", "Temperature of the film."),
          optional("supply", supply, "A line along the whole width that is kept full at a given pressure.", "none"),
          optional("features", features_format(), "Holes and grooves through which oil is fed.", "none"),
          optional("shape", shape_format(), "What makes bore and journal differ from cylinders; all add up.",
                   "cylinders"),
          optional("roughness", roughness_format(), "Roughness of both surfaces, as the flow of the oil sees it.",
                   "smooth"),
          defaulted("asperities", asperities_format(), "none", "Contact of rough surfaces."),
          defaulted("compliance", compliance_format(), "rigid", "Elastic deformation of both surfaces."),
          defaulted("shell_surface", deforming_surface_format(), "rigid",
                    "Whether the bore deforms as the mesh of the shell's body does."),
          defaulted("journal_surface", deforming_surface_format(), "rigid",
                    "Whether the journal deforms as the mesh of its body does."),
          optional("materials", materials_format(), "Give the composite modulus where it is not given itself."),
          optional("permissible_pressure", quantity("Pa", "60 MPa", Range::positive()),
                   "Peak film pressure that the bearing's lining bears; above it a run ends with a warning.",
                   "200 MPa, the order of engine bearings"),
          defaulted("cavitated_shear", choice(cavitated_shear_words), "film_share", "Shear in the cavitated film."),
          defaulted("shear_force", choice(shear_force_words), "full", "What shear does to the bodies."),
          optional("solver", choice(film_solver_words),
                   "Solver of the film. Coupled monolithically to the bodies, `sor` finds the initial film only.",
                   "newton; of grids of more than 15,000 nodes multigrid"),
          optional("operating_point", operating_point_format(),
                   "Speeds and load, or position, of the bearing by itself (`hersey bearing`); a simulation has its "
                   "own.",
                   "given on the command line"),
          defaulted("coupling", coupling_format(), "monolithic", "How film and bodies are solved together."),
      });
  return named("a mapping from names to bearings",
               with_exactly_one(bearing, {"radial_clearance", "diametral_clearance"}));
}

}  // namespace hersey::model
