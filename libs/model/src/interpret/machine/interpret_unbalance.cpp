#include <cmath>

#include "interpret/context/interpret.h"
#include "schema/format.h"

// Unbalances of shafts: by their moment, by a mass off the axis, or by a grade of balance quality.
namespace hersey::model {
namespace {

TypePtr mass_format() {
  return object("a mass off the axis", {required("mass", quantity("kg", "2 g", Range::positive()), "The mass."),
                                        required("eccentricity", quantity("m", "50 mm", Range::positive()),
                                                 "Distance of its centre from the axis.")});
}

TypePtr grade_format() {
  return object("a grade of balance quality",
                {required("quality", quantity("m/s", "2.5 mm/s", Range::positive()),
                          "Permissible eccentricity times speed, e.g. 2.5 mm/s for G 2.5."),
                 required("mass", quantity("kg", "40 kg", Range::positive()), "Mass of the rotor that it is for."),
                 required("speed", quantity("rad/s", "9000 rpm", Range::positive()), "Highest speed in service.")});
}

/// Mass times eccentricity [kg m].
double amount_of(const Value& value) {
  if (value.find("amount") != nullptr) return number_of(value, "amount");
  if (const Value* mass = value.find("off_axis"); mass != nullptr && !mass->broken)
    return number_of(*mass, "mass") * number_of(*mass, "eccentricity");
  const Value* grade = value.find("grade");
  if (grade == nullptr || grade->broken) return 0;
  const double speed = number_of(*grade, "speed");
  return speed > 0 ? number_of(*grade, "quality") * number_of(*grade, "mass") / speed : 0;  // (rotors.5)
}

}  // namespace

std::vector<Key> unbalance_keys() {
  return {
      required("on", reference(Refers::frame, "shaft.middle"),
               "Station: a frame of the shaft, whose z-axis is that of the shaft."),
      optional("amount", quantity("kg.m", "20 g.mm", Range::positive()), "Mass times eccentricity."),
      optional("off_axis", mass_format(), "Instead: a mass and its distance from the axis."),
      optional("grade", grade_format(), "Instead: what ISO 21940-11 permits a rotor of that grade."),
      defaulted("phase", quantity("rad", "30 deg"), "0 deg", "Its direction, from the station's x-axis towards y."),
      optional("begins", quantity("s", "0.5 s"),
               "Time at which it appears, as by the loss of a blade; there is none before. Without it: always there."),
  };
}

Unbalance unbalance_of(Context& context, const Value& value) {
  Unbalance unbalance;
  unbalance.from = FrameName{"ground", "", value.position};
  const Value* on = value.find("on");
  if (on == nullptr || on->broken) return unbalance;
  unbalance.to = frame_of(context, *on);
  if (unbalance.to.body == "ground") context.fault(*on, "an unbalance of ground", "a frame of a body that rotates");
  int given = 0;
  for (const char* key : {"amount", "off_axis", "grade"}) given += value.find(key) != nullptr ? 1 : 0;
  if (given != 1)
    context.fault_at_key(value, given == 0 ? "an unbalance of no size" : "an unbalance of several sizes",
                         "one of 'amount', 'off_axis' and 'grade'");
  const double amount = amount_of(value), phase = number_of(value, "phase");
  if (value.find("begins") != nullptr) unbalance.begins = number_of(value, "begins");
  unbalance.moment = amount * Vector3(std::cos(phase), std::sin(phase), 0);
  return unbalance;
}

}  // namespace hersey::model
