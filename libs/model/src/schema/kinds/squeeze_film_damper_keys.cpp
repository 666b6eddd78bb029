#include <algorithm>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"

namespace hersey::model {
namespace {

TypePtr damper_point_format() {
  const TypePtr ratio = number("0.3", {.low = 0, .high = 1, .high_open = true});
  return object(
      "an orbit or small motions",
      {
          required(
              "whirl_speed", quantity("rad/s", "6000 rpm"),
              "Angular velocity of the orbit, positive from x towards y; angular frequency of small motions. Not 0."),
          defaulted("orbit_ratio", ratio, "0",
                    "Radius of a circular orbit about the bore's axis over the radial clearance; 0: small motions, for "
                    "which stiffness, damping and added mass are found."),
          defaulted("eccentricity_ratio", ratio, "0",
                    "Of the position about which small motions go on, as on a soft centring spring under a weight."),
          defaulted("eccentricity_angle", quantity("rad", "-90 deg"), "-90 deg",
                    "Direction of that position, from x towards y."),
      });
}

}  // namespace

std::vector<Key> squeeze_film_damper_keys() {
  std::vector<Key> keys = journal_keys();
  const auto point =
      std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.name == "operating_point"; });
  *point = optional("operating_point", damper_point_format(),
                    "Orbit, or small motions, of the damper by itself (`hersey bearing`); a simulation has its own.",
                    "given on the command line");
  return keys;
}

}  // namespace hersey::model
