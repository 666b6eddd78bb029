#include "hersey/film/thermal_model.h"
#include "schema/bearing_keys.h"
#include "schema/format.h"
#include "schema/oil_laws.h"
#include "schema/thermal_walls.h"

namespace hersey::model {
namespace {

TypePtr cooling_format() {
  return object("cooling by the surroundings",
                {
                    required("area", quantity("m^2", "0.3 m^2", Range::positive()), "Surface of the housing."),
                    defaulted("heat_transfer", quantity("W/m^2/K", "20 W/m^2/K", Range::positive()), "20 W/m^2/K",
                              "From it to the air."),
                    required("ambient", temperature("20 degC"), "Temperature of the air."),
                });
}

/// @param of_film  whose walls have temperatures of their own
TypePtr expansion_format(bool of_film) {
  const TypePtr coefficient = quantity("1/K", "12e-6 1/K");
  std::vector<Key> keys{
      required("shell", coefficient, "Coefficient of linear expansion of what holds the bore; 0: it keeps its size."),
      required("journal", coefficient, "Of the journal."),
      defaulted("reference", temperature("20 degC"), "20 degC",
                "Temperature of both at which the clearance is as given."),
  };
  if (!of_film) {
    keys.push_back(optional("shell_temperature", temperature("80 degC"), "Mean of the shell.", "that of the oil"));
    keys.push_back(optional("journal_temperature", temperature("90 degC"), "Mean of the journal.", "that of the oil"));
  }
  return object("thermal expansion of the walls", std::move(keys));
}

Key expansion_key(bool of_film) {
  return optional("expansion", expansion_format(of_film),
                  "How the clearance follows the walls' mean temperatures; eccentricity ratios and bearing numbers are "
                  "then over that clearance.",
                  "the clearance is as given");
}

/// Keys of a film with temperatures. @param carry_over  what its share means in such a film
std::vector<Key> film_heat_keys(const Key& fixed, const Key& moving, const std::string& carry_over) {
  const TypePtr supply_or_node = temperature_or_node("50 degC");
  return {required("supply_temperature", supply_or_node,
                   "Of the oil that comes through line, holes and grooves; of a node, it follows the node."),
          optional("edge_temperature", supply_or_node, "Of the oil that edges draw in.", "that of the supply"),
          optional("drains_to", reference(Refers::thermal_node, "sump"),
                   "Node of the network that the oil warms which leaves the film.", "its heat goes away with it"),
          defaulted("layers", integer(5, {.low = 1, .high = film::most_layers}), "5",
                    "Into which the film is divided across; 1: one temperature across the film."),
          fixed,
          moving,
          defaulted("carry_over", number("1", {.low = 0, .high = 1}), "1", carry_over)};
}

}  // namespace

TypePtr flat_thermal_format(const SurfaceKeys& surfaces) {
  const Key fixed = defaulted(surfaces.fixed, variant("a wall of pads", "wall", {}, variants_of(pad_walls())),
                              "insulated", "What the " + surfaces.fixed + " does with heat.");
  const Key moving = defaulted(surfaces.moving, variant("a runner's wall", "wall", {}, variants_of(runner_walls())),
                               "free", "What the " + surfaces.moving + " does with heat.");
  return variant("a model of the film's temperature", "model", {},
                 {{"isothermal", "one temperature everywhere: `temperature`, or that of the lubricant", {}},
                  {"film", "the film's energy across and along it, with locally varying viscosity",
                   film_heat_keys(fixed, moving,
                                  "Share of the oil behind a pad, or of what passes a hole or pocket, that is mixed "
                                  "there with fresh oil and comes to the next; 0: all of it is renewed.")}});
}

TypePtr thermal_format() {
  const TypePtr supply = temperature("50 degC");
  const Key shell = defaulted("shell", variant("a shell's wall", "wall", {}, variants_of(shell_walls())), "insulated",
                              "What the shell does with heat."),
            journal = defaulted("journal", variant("a journal's wall", "wall", {}, variants_of(journal_walls())),
                                "free", "What the journal does with heat.");
  const auto with_expansion = [](std::vector<Key> keys) {
    keys.push_back(expansion_key(true));
    return keys;
  };
  return variant(
      "a model of the film's temperature", "model", {},
      {
          {"isothermal",
           "one temperature everywhere, given",
           {optional("temperature", temperature("60 degC"), "Of the oil.", "that of the lubricant"),
            expansion_key(false)}},
          {"global",
           "one effective temperature by a balance of heat (as ISO 7902, DIN 31652); of a bearing by itself",
           {optional("supply_temperature", supply,
                     "Of the oil that comes; what leaves takes all heat along. This, or `cooling`.", "no oil cools"),
            optional("cooling", cooling_format(), "The housing gives off all heat.", "the oil cools"),
            expansion_key(false)}},
          {"film", "the film's energy across and along it, with locally varying viscosity",
           with_expansion(
               film_heat_keys(shell, journal,
                              "Share of the film's oil that passes a hole or groove and is mixed there with what "
                              "comes; 0: all of it is renewed."))},
      });
}

}  // namespace hersey::model
