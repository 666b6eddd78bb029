#include "schema/thermal_walls.h"

#include "check/members.h"
#include "schema/oil_laws.h"

namespace hersey::model {
namespace {

std::optional<double> start_of(const Value& wall) {
  const Value* T = wall.find("temperature");
  return T != nullptr && !T->broken ? std::optional(T->number) : std::nullopt;
}

/// A shell's own temperature: one, or over the angle.
TypePtr temperature_around() {
  const TypePtr inline_table = object(
      "temperatures over the angle",
      {
          required("angles", list("angles", quantity("rad", "90 deg"), 0),
                   "From the shell's x-axis towards y, ascending, within 360 deg; straight lines between them and "
                   "around from the last to the first."),
          required("temperatures", list("temperatures", temperature("60 degC"), 0), "As many."),
      });
  const TypePtr from_file = object(
      "a table in a file",
      {required("file", text("a file", "shell.csv"),
                "CSV file beside the model file with the columns `angle` and `temperature`, units in brackets.")});
  return any_of("a temperature such as 60 degC, or a table over the angle",
                {temperature("60 degC"), inline_table, from_file});
}

Variant node_wall() {
  return {"node",
          "it is a body of the network `thermal`, alone or with other walls",
          {required("node", reference(Refers::thermal_node, "block"), "Which.")}};
}

}  // namespace

TypePtr temperature_or_node(const std::string& example) {
  return any_of("a temperature such as " + example + ", or {node: NAME}",
                {temperature(example),
                 object("a node's temperature",
                        {required("node", reference(Refers::thermal_node, "sump"), "Of the network `thermal`.")})});
}

const std::vector<Alternative<film::ShellWall>>& shell_walls() {
  static const std::vector<Alternative<film::ShellWall>> walls{
      {{"insulated", "no heat passes", {}}, [](const Value&) { return film::InsulatedWall{}; }},
      {{"given",
        "it has a temperature",
        {required("temperature", temperature_around(), "That temperature, everywhere or over the angle.")}},
       [](const Value&) { return film::WallAtTemperature{}; }},  // as read_temperature_around finds it
      {{"ring",
        "a ring conducts heat around the bearing and out to its surroundings",
        {required("outer_diameter", quantity("m", "80 mm", Range::positive()), "Of the ring."),
         defaulted("conductivity", quantity("W/m/K", "50 W/m/K", Range::positive()), "50 W/m/K", "Of its material."),
         defaulted("heat_transfer", quantity("W/m^2/K", "80 W/m^2/K", Range::not_negative()), "80 W/m^2/K",
                   "From its outside and its ends to the surroundings."),
         required("ambient", temperature_or_node("40 degC"),
                  "Temperature of these, or the node that they are and that the heat warms."),
         optional("temperature", temperature("60 degC"), "With which a simulation begins.", "that of the supply")}},
       [](const Value& wall) {
         return film::RingWall{.outer_radius = number_of(wall, "outer_diameter") / 2,
                               .conductivity = number_of(wall, "conductivity"),
                               .transfer = number_of(wall, "heat_transfer"),
                               .heat_capacity = heat_of_steel,
                               .T_start = start_of(wall)};
       }},
      {{"pad",
        "each arc lies on a pad that conducts heat along its arc and through its thickness, and gives it off on all "
        "sides",
        {required("thickness", quantity("m", "20 mm", Range::positive()), "Of the pad."),
         defaulted("conductivity", quantity("W/m/K", "50 W/m/K", Range::positive()), "50 W/m/K", "Of its material."),
         defaulted("heat_transfer", quantity("W/m^2/K", "80 W/m^2/K", Range::not_negative()), "80 W/m^2/K",
                   "From its back, its sides and its faces beside the grooves to the surroundings."),
         required("ambient", temperature_or_node("40 degC"),
                  "Temperature of these, or the node that they are and that the heat warms."),
         optional(
             "carrier", temperature("45 degC"),
             "Of what the pads stand in: with `expansion` their pivots move outwards with it, their faces inwards with "
             "the pad.",
             "that of the pads"),
         optional("temperature", temperature("60 degC"), "With which a simulation begins.", "that of the supply")}},
       [](const Value& wall) {
         return film::RingWall{
             .outer_radius = number_of(wall, "thickness"),  // over the bore's, which is not known here
             .conductivity = number_of(wall, "conductivity"),
             .transfer = number_of(wall, "heat_transfer"),
             .heat_capacity = heat_of_steel,
             .T_start = start_of(wall),
             .closes = false};
       }},
      {{"body",
        "the mesh of the shell's body conducts the heat, steadily: its `heat` says how and where to",
        {optional("faces", text("a surface or a set of nodes", "bore"),
                  "Surface or set of nodes of the mesh that the film lies on.",
                  "those of `shell_surface`, or all faces on the bearing's cylinder"),
         optional("temperature", temperature("60 degC"),
                  "Of all of the body as a simulation begins. It stays so, but for cycles with `walls: cycle_mean`, at "
                  "whose ends it takes the temperatures that their mean heat gives it.",
                  "that of the supply")}},
       [](const Value& wall) {
         const Value* T = wall.find("temperature");
         return film::BodyWall{.conduction = {},
                               .T_start = T != nullptr && !T->broken ? std::optional<double>(T->number) : std::nullopt};
       }},
      {node_wall(), [](const Value&) { return film::NodeWall{}; }},
  };
  return walls;
}

const std::vector<Alternative<film::JournalWall>>& journal_walls() {
  static const std::vector<Alternative<film::JournalWall>> walls{
      {{"free",
        "one temperature, at which it takes up as much heat as it gives off",
        {optional("heat_capacity", quantity("J/K", "500 J/K", Range::positive()),
                  "Of the whole journal, in a simulation.", "that of its cylinder of steel in the bearing"),
         optional("temperature", temperature("60 degC"), "With which a simulation begins.", "that of the supply")}},
       [](const Value& wall) {
         return film::FreeJournal{number_of(wall, "heat_capacity"), start_of(wall)};
       }},
      {{"given", "it has a temperature", {required("temperature", temperature("60 degC"), "That temperature.")}},
       [](const Value& wall) {
         return film::WallAtTemperature{number_of(wall, "temperature"), {}};
       }},
      {{"insulated", "no heat passes", {}}, [](const Value&) { return film::InsulatedWall{}; }},
      {{"body",
        "the mesh of the journal's body conducts the heat, steadily: its `heat` says how and where to; the journal "
        "rotates, so that heat enters it evenly around",
        {optional("faces", text("a surface or a set of nodes", "pin"),
                  "Surface or set of nodes of the mesh that the film lies on.",
                  "those of `journal_surface`, or all faces on the bearing's cylinder"),
         optional("temperature", temperature("60 degC"),
                  "Of all of the body as a simulation begins. It stays so, but for cycles with `walls: cycle_mean`, at "
                  "whose ends it takes the temperatures that their mean heat gives it.",
                  "that of the supply")}},
       [](const Value& wall) { return film::BodyJournal{.conduction = {}, .T_start = start_of(wall)}; }},
      {node_wall(), [](const Value&) { return film::NodeWall{}; }},
  };
  return walls;
}

}  // namespace hersey::model
