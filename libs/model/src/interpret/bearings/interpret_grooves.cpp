#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "hersey/core/spelling.h"
#include "interpret/context/interpret.h"

// Grooves between the films of several bearings.
namespace hersey::model {
namespace {

/// Index of a bearing on an arc or a pad whose film has temperatures; reports any other.
std::optional<std::size_t> film_on_groove(Context& context, const Value& name) {
  if (name.broken) return std::nullopt;
  const std::vector<Bearing>& bearings = context.model.bearings;
  const auto found =
      std::find_if(bearings.begin(), bearings.end(), [&](const Bearing& b) { return b.name == name.text; });
  if (found == bearings.end()) {
    const std::vector<std::string> names = names_in(context.root, "bearings");
    context.fault(name, "unknown bearing '" + name.text + "'", one_of(names), did_you_mean(name.text, names));
    return std::nullopt;
  }
  const auto* heat = std::get_if<film::ThermalModel>(&found->heat);
  if (heat == nullptr || found->film.ends.empty()) {
    context.fault(name, heat == nullptr ? "a film without temperatures" : "a film that has no ends",
                  "a bearing with `arcs`, or of pads, and `thermal: {model: film, ...}`");
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - bearings.begin());
}

}  // namespace

void interpret_grooves(Context& context) {
  const Value* thermal = context.root.find("thermal");
  if (thermal == nullptr || thermal->broken) return;
  std::vector<Groove>& grooves = context.model.thermal.grooves;
  for (const auto& [name, value] : section(*thermal, "grooves")) {
    const Value* between = value.find("between");
    if (between == nullptr || between->broken || between->members.size() != 2) continue;
    const auto before = film_on_groove(context, between->members[0].value),
               after = film_on_groove(context, between->members[1].value);
    if (!before || !after) continue;
    for (const Groove& other : grooves) {
      if (other.before != *before && other.after != *after) continue;
      context.fault(*between, "an end of a film that lies on groove '" + other.name + "' already",
                    "one groove at each end of a film");
    }
    const auto& heat = std::get<film::ThermalModel>(context.model.bearings[*after].heat);
    const Value *T = value.find("temperature"), *carry_over = value.find("carry_over");
    grooves.push_back(
        {.name = name,
         .before = *before,
         .after = *after,
         .T_fresh = T != nullptr && !T->broken ? std::optional(T->number) : std::nullopt,
         .carry_over = carry_over != nullptr && !carry_over->broken ? carry_over->number : heat.carry_over});
  }
  for (const Groove& groove : grooves)
    for (const std::size_t k : {groove.before, groove.after})
      std::get<film::ThermalModel>(context.model.bearings[k].heat).has_grooves = false;
}

}  // namespace hersey::model
