#include "hersey/film/thermal_model.h"
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

}  // namespace

TypePtr thermal_format() {
  const TypePtr supply = temperature("50 degC");
  return variant(
      "a model of the film's temperature", "model", {},
      {
          {"isothermal",
           "one temperature everywhere, given",
           {optional("temperature", temperature("60 degC"), "Of the oil.", "that of the lubricant")}},
          {"global",
           "one effective temperature by a balance of heat (as ISO 7902, DIN 31652); of a bearing by itself",
           {optional("supply_temperature", supply,
                     "Of the oil that comes; what leaves takes all heat along. This, or `cooling`.", "no oil cools"),
            optional("cooling", cooling_format(), "The housing gives off all heat.", "the oil cools")}},
          {"film",
           "the film's energy across and along it, with viscosity from place to place",
           {required("supply_temperature", supply, "Of the oil that comes through line, holes and grooves."),
            optional("edge_temperature", supply, "Of the oil that edges draw in.", "that of the supply"),
            defaulted("layers", integer(5, {.low = 1, .high = film::most_layers}), "5",
                      "Into which the film is divided across; 1: one temperature across the film."),
            defaulted("shell", variant("a shell's wall", "wall", {}, variants_of(shell_walls())), "insulated",
                      "What the shell does with heat."),
            defaulted("journal", variant("a journal's wall", "wall", {}, variants_of(journal_walls())), "free",
                      "What the journal does with heat."),
            defaulted("carry_over", number("1", {.low = 0, .high = 1}), "1",
                      "Share of the film's oil that passes a hole or groove and is mixed there with what comes; 0: all "
                      "of it is renewed.")}},
      });
}

}  // namespace hersey::model
