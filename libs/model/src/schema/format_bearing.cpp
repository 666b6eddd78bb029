#include <numbers>
#include <utility>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"

namespace hersey::model {

TypePtr bearing_pressure() { return quantity("Pa", "2 bar"); }
TypePtr edge_format() {
  return or_word(bearing_pressure(), {{"closed",
                                       "no oil passes: at both edges a film of infinite width, at one a cap or a plane "
                                       "of symmetry"}});
}
TypePtr seal_format() {
  return object(
      "a seal that leaks",
      {
          required("leakage", number("0.5", Range::positive()),
                   "kappa of the flow per circumference kappa c^3/(12 mu L/2) (p - outside) through it, with the "
                   "radial clearance c and the width L: 1 leaks like half of the film's own width; 0 would be a closed "
                   "edge, infinity an open one."),
          defaulted("outside", bearing_pressure(), "0 Pa", "Pressure behind it."),
      });
}

namespace {

TypePtr modulus() { return called(quantity("Pa", "57 GPa", Range::positive()), "an elastic modulus"); }

Key composite_modulus_key() {
  return optional("composite_modulus", modulus(), "E of 1/E = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.", "from `materials`");
}

TypePtr cavitation_format() {
  const auto pressure_key = defaulted("pressure", bearing_pressure(), "0 Pa",
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

TypePtr roughness_format(const SurfaceKeys& surfaces) {
  const TypePtr surface = object(
      "a rough surface",
      {
          required("sigma", quantity("m", "0.8 um", Range::positive()), "Its rms height."),
          defaulted(
              "gamma", number("1", {.low = 0.11, .high = 9}), "1",
              "Peklenik's ratio: how much longer its features are along the sliding direction than across it. Ridges "
              "around a journal, as from turning: 9; along its axis: 0.11; no direction: 1."),
      });
  return object("the roughness of both surfaces",
                {
                    optional(surfaces.fixed, surface, surfaces.of_fixed, "smooth"),
                    optional(surfaces.moving, surface, surfaces.of_moving, "smooth"),
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
                                   "a journal bearing's radius, a pad's length, the width of an annulus"),
                      }},
                 });
}

TypePtr turbulence_format() {
  const auto keys = std::vector<Key>{
      defaulted("transition", choice(transition_words), "reynolds",
                "Number of the film at a point that says whether it is laminar there."),
      optional("onset", number("900", {.low = 1, .high = 1e6}), "Number up to which the film is laminar.",
               "900; of `taylor` 41.2"),
      optional("full", number("1600", {.low = 1, .high = 1e6}),
               "Number from which the film is fully turbulent; the friction between both is a smooth mixture.",
               "1600; of `taylor` 82.4"),
      defaulted(
          "prandtl", number("0.9", {.low = 0.1, .high = 10}), "0.9",
          "Turbulent Prandtl number, eddy viscosity over eddy diffusivity of heat; for `thermal: {model: film}`."),
  };
  std::vector<Variant> models = variants_of(turbulence_words);
  for (Variant& model : models)
    if (model.tag != "none") model.keys = keys;
  return variant("a turbulence model", "model", {}, std::move(models));
}

TypePtr materials_format(const SurfaceKeys& surfaces) {
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
                                     required(surfaces.fixed, material, surfaces.of_fixed),
                                     required(surfaces.moving, material, surfaces.of_moving),
                                 });
}

TypePtr wear_format(const SurfaceKeys& surfaces) {
  const std::vector<Key> of_surface{optional("coefficient", quantity("1/Pa", "1e-16 1/Pa", Range::not_negative()),
                                             "Archard's: worn depth over contact pressure and sliding distance, k/H."),
                                    optional("energy_density", quantity("J/m^3", "1e13 J/m^3", Range::positive()),
                                             "Fleischer's: work of friction that wears off a volume."),
                                    optional("lining", quantity("m", "20 um", Range::positive()),
                                             "Depth that may wear off; a run ends there.", "no end")};
  const auto one_law = [](const TypePtr& surface) {
    return with_exactly_one(surface, {"coefficient", "energy_density"});
  };
  const TypePtr fixed = one_law(object("wear of a surface", of_surface));
  std::vector<Key> of_moving = of_surface;
  of_moving.push_back(optional("group", text("a name", "front"),
                               "Name of a surface that several films wear, as pads do: each of this name has in its "
                               "gap what all of them wear off it.",
                               "this film only; of a bearing of tilting pads its name"));
  const bool is_journal = surfaces.moving == "journal";
  if (is_journal)
    of_moving.push_back(
        defaulted("around", choice(wear_around_words), "even", "Where around the journal the contact wears it."));
  const TypePtr moving = one_law(object("wear of the moving surface", of_moving));
  const TypePtr running_in =
      object("running in of the roughness",
             {required("roughness", quantity("m", "0.4 um", Range::positive()),
                       "Composite rms height that the asperities wear to, at most `asperities.roughness`."),
              required("depth", quantity("m", "0.5 um", Range::positive()),
                       "Worn off both surfaces together where a share 1/e of the change is still to come.")});
  return object("wear",
                {optional(surfaces.fixed, fixed, "Of the fixed surface, place by place.", "none"),
                 optional(surfaces.moving, moving,
                          is_journal ? "Of the moving surface, evenly around or place by place."
                                     : "Of the moving surface, evenly around.",
                          "none"),
                 defaulted("acceleration", number("1000", {.low = 0, .high = 1e9, .low_open = true}), "1",
                           "Times that wear counts: one cycle stands for as many."),
                 optional("running_in", running_in, "Roughness that follows wear, place by place.", "it stays"),
                 optional("cycle", quantity("s", "40 ms", Range::positive()),
                          "After which loads repeat: for the uncertainty by the acceleration.", "not estimated")});
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

}  // namespace

std::vector<Key> shared_bearing_keys() {
  return {
      required("lubricant", reference(Refers::lubricant, "oil"), "Name of the oil."),
      defaulted("pressures", choice(pressure_scale_words), "gauge",
                "The scale on which all pressures of this bearing are given and reported."),
      defaulted("cavitation", cavitation_format(), "mass_conserving", "Where the film would be under tension."),
      defaulted("initial_fill", number("0.1", {.low = 0, .high = 1}), "1",
                "Share of the gap that is oil as a run begins, where no feed fills it: below 1 a dry start. Needs "
                "`cavitation: mass_conserving`."),
      defaulted("asperities", asperities_format(), "none", "Contact of rough surfaces."),
      defaulted("compliance", compliance_format(), "rigid", "Elastic deformation of both surfaces."),
      optional("permissible_pressure", quantity("Pa", "60 MPa", Range::positive()),
               "Peak film pressure that the bearing's lining bears; above it a run ends with a warning.",
               "200 MPa, the order of engine bearings"),
      defaulted("cavitated_shear", choice(cavitated_shear_words), "film_share", "Shear in the cavitated film."),
      defaulted("turbulence", turbulence_format(), "none",
                "Friction of the film at the speeds and thicknesses at which it is not laminar."),
      defaulted("solver", choice(film_solver_words), "auto",
                "Solver of the film. Coupled monolithically to the bodies, `sor` finds the initial film only."),
      defaulted("coupling", coupling_format(), "monolithic", "How film and bodies are solved together."),
  };
}

std::vector<Key> surface_keys(const SurfaceKeys& surfaces) {
  return {
      optional("roughness", roughness_format(surfaces), "Roughness of both surfaces, as the flow of the oil sees it.",
               "smooth"),
      optional("materials", materials_format(surfaces), "Give the composite modulus where it is not given itself."),
      optional("wear", wear_format(surfaces), "Wear of both surfaces over a run, where `asperities` touch.", "none"),
  };
}

const std::vector<BearingKindFormat>& bearing_kind_formats() {
  static const std::vector<BearingKindFormat> kinds{
      {"journal", "Journal bearing", "a journal in a bore", {}, journal_keys()},
      {"plane_slider",
       "Plane slider",
       "a rectangular pad on a plane runner that slides below it",
       {.fixed = "pad", .of_fixed = "The pad.", .moving = "runner", .of_moving = "The runner."},
       plane_slider_keys()},
      {"tilting_pad", "Tilting-pad bearing", "a journal on pads that tilt on pivots", {}, tilting_pad_keys()},
      {"thrust",
       "Thrust bearing",
       "pads in sectors of an annulus, or a washer, below a runner that turns about the axis",
       {.fixed = "stator", .of_fixed = "The pads.", .moving = "runner", .of_moving = "The runner."},
       thrust_keys()},
      {"tilting_pad_thrust",
       "Thrust bearing of tilting pads",
       "a collar on pads that tilt on pivots",
       {.fixed = "stator", .of_fixed = "The pads.", .moving = "runner", .of_moving = "The runner."},
       tilting_pad_thrust_keys()},
      {"floating_ring",
       "Floating ring",
       "a journal in a ring that floats between two films, free to rotate or locked",
       {},
       floating_ring_keys()},
      {"squeeze_film_damper",
       "Squeeze-film damper",
       "a journal that orbits in a bore without rotating",
       {},
       squeeze_film_damper_keys()},
      {"skirt",
       "Piston skirt",
       "the skirt of a piston or crosshead in its liner, with a film on either side",
       {.fixed = "skirt", .of_fixed = "The skirt.", .moving = "liner", .of_moving = "The liner."},
       skirt_keys()},
  };
  return kinds;
}

TypePtr bearings_format() {
  std::vector<Variant> kinds;
  for (const BearingKindFormat& kind : bearing_kind_formats()) kinds.push_back({kind.tag, kind.description, kind.keys});
  const TypePtr bearing =
      with_default_tag(variant("a bearing", "kind", shared_bearing_keys(), std::move(kinds)), "journal");
  return named("a mapping from names to bearings",
               with_exactly_one(bearing, {"radial_clearance", "diametral_clearance"}));
}

}  // namespace hersey::model
