#include "check/members.h"
#include "schema/oil_laws.h"
#include "schema/thermal_walls.h"

// Walls of flat films: pads, a stator, and the runner that slides or turns on them.
namespace hersey::model {
namespace {

TypePtr wall_temperature() { return temperature("60 degC"); }

std::optional<double> temperature_at_start(const Value& wall) {
  const Value* T = wall.find("temperature");
  return T != nullptr && !T->broken ? std::optional(T->number) : std::nullopt;
}

Key start_key() {
  return optional("temperature", wall_temperature(), "With which a simulation begins.", "that of the supply");
}

Variant insulated() { return {"insulated", "no heat passes", {}}; }

Variant given_wall() {
  return {"given", "it has a temperature", {required("temperature", wall_temperature(), "That temperature.")}};
}

Variant node() {
  return {"node",
          "it is a body of the network `thermal`, alone or with other walls",
          {required("node", reference(Refers::thermal_node, "block"), "Which.")}};
}

film::WallAtTemperature at_given(const Value& wall) { return {.T = number_of(wall, "temperature"), .around = {}}; }

}  // namespace

const std::vector<Alternative<film::ShellWall>>& pad_walls() {
  static const std::vector<Alternative<film::ShellWall>> walls{
      {insulated(), [](const Value&) { return film::InsulatedWall{}; }},
      {given_wall(), at_given},
      {{"pad",
        "each pad, or the washer, conducts heat in the sense of motion and through its thickness, and gives it off on "
        "all sides",
        {required("thickness", quantity("m", "20 mm", Range::positive()), "From its face to its back."),
         defaulted("conductivity", quantity("W/m/K", "50 W/m/K", Range::positive()), "50 W/m/K", "Of its material."),
         defaulted("heat_transfer", quantity("W/m^2/K", "80 W/m^2/K", Range::not_negative()), "80 W/m^2/K",
                   "From its back and its sides to the surroundings."),
         required("ambient", temperature_or_node("40 degC"),
                  "Temperature of these, or the node that they are and that the heat warms."),
         start_key()}},
       [](const Value& wall) {
         return film::RingWall{.outer_radius = number_of(wall, "thickness"),  // beyond R, which is not known here
                               .conductivity = number_of(wall, "conductivity"),
                               .transfer = number_of(wall, "heat_transfer"),
                               .heat_capacity = heat_of_steel,
                               .T_start = temperature_at_start(wall),
                               .closes = false};
       }},
      {node(), [](const Value&) { return film::NodeWall{}; }},
  };
  return walls;
}

const std::vector<Alternative<film::JournalWall>>& runner_walls() {
  static const std::vector<Alternative<film::JournalWall>> walls{
      {{"free",
        "one temperature, at which it takes up as much heat as it gives off",
        {optional("heat_capacity", quantity("J/K", "500 J/K", Range::positive()), "Of the runner, in a simulation.",
                  "that of steel as thick as the film is wide: a disc of the outer diameter, or a plate of the pad's "
                  "size"),
         start_key()}},
       [](const Value& wall) {
         return film::FreeJournal{number_of(wall, "heat_capacity"), temperature_at_start(wall)};
       }},
      {given_wall(), at_given},
      {insulated(), [](const Value&) { return film::InsulatedWall{}; }},
      {node(), [](const Value&) { return film::NodeWall{}; }},
  };
  return walls;
}

}  // namespace hersey::model
