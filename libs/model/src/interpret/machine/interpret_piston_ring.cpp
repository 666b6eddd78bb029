#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "interpret/context/interpret.h"
#include "schema/format.h"

// Piston rings as forces between liner and piston.
namespace hersey::model {
namespace {

/// Reports a coefficient of friction below zero: at the ends of a table and between, or for an expression where rings
/// run, up to a Hersey number of 1e-3.
void require_friction(Context& context, const Value& value, const PistonRing& ring) {
  constexpr int kPoints = 64;
  constexpr double kLargest = 1e-3;  // of rings in full film lubrication
  const double low = ring.data.lowest, high = std::isfinite(ring.data.highest) ? ring.data.highest : kLargest;
  for (int k = 0; k <= kPoints; ++k) {
    const double H = low + (high - low) * k / kPoints, mu_friction = ring.data.stribeck->value({&H, 1});
    if (mu_friction >= 0) continue;
    context.fault_at_key(
        value, fmt::format("a coefficient of friction of {:.3g} at a Hersey number of {:.3g}", mu_friction, H),
        "coefficients >= 0");
    return;
  }
}

}  // namespace

std::vector<Key> piston_ring_keys() {
  const TypePtr size = quantity("m", "1.5 mm", Range::positive());
  return {
      required(
          "between", list("two frames", reference(Refers::frame, "piston.rings"), 2),
          "Liner, whose z-axis is the axis along which the piston slides, and piston, on whose axis the frame lies."),
      required("bore", quantity("m", "75 mm", Range::positive()), "Diameter of the liner."),
      required("height", size, "Of the ring's face that bears on the liner, along the axis."),
      required("tension", quantity("N", "8 N", Range::not_negative()),
               "Force along the ring that closes its gap: the ring presses with 2 tension/(bore height)."),
      optional(
          "gas", function_format({"Pa"}, "5 bar"),
          "Mean pressure of the gas behind the ring above that before its face, a function of time or of the crank's "
          "rotation; where tension and gas are negative together, the ring has lifted off.",
          "none"),
      required("friction", law_format("1", "hersey", "1", "0.1"),
               "Coefficient of friction: a number, or the Stribeck curve over `hersey`, viscosity |speed|/(height "
               "pressure); a "
               "table's values go on beyond its ends."),
      optional("viscosity", quantity("Pa.s", "8 mPa.s", Range::positive()), "Of the oil on the liner.",
               "**required** unless `friction` is a number"),
      defaulted("transition_speed", quantity("m/s", "10 mm/s", Range::positive()), "10 mm/s",
                "Speed v_t of the smooth passage through zero, v/sqrt(v^2 + v_t^2)."),
  };
}

PistonRing piston_ring_of(Context& context, const Value& value) {
  PistonRing ring;
  std::tie(ring.from, ring.to) = pair_of(context, value);
  ring.data.bore = number_of(value, "bore");
  ring.data.height = number_of(value, "height");
  ring.data.tension = number_of(value, "tension");
  ring.data.transition_speed = number_of(value, "transition_speed");
  if (const Value* gas = value.find("gas"); gas != nullptr && !gas->broken) ring.gas = function_of(context, *gas, "Pa");
  const Value *friction = value.find("friction"), *viscosity = value.find("viscosity");
  if (viscosity != nullptr && !viscosity->broken) ring.data.viscosity = viscosity->number;
  if (friction == nullptr || friction->broken) return ring;
  const Function curve = function_of(context, *friction, "1", {"hersey", "1"});
  if (context.has_fault_in(friction->path)) return ring;
  if (!curve.is_constant() && viscosity == nullptr)
    context.fault_at_key(value, "friction over the Hersey number, and no 'viscosity'",
                         "the viscosity of the oil on the liner");
  ring.data.stribeck = curve.value;
  std::tie(ring.data.lowest, ring.data.highest) =
      curve.domain.value_or(std::pair{0.0, std::numeric_limits<double>::infinity()});
  require_friction(context, *friction, ring);
  return ring;
}

}  // namespace hersey::model
