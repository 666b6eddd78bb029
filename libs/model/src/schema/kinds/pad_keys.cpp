#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"

// What pads that tilt have in common, around a journal and below a collar: their pivots, and which keys are those of
// the film of each.
namespace hersey::model {

TypePtr pivot_format(const std::vector<Key>& common) {
  const TypePtr radius = quantity("m", "100 mm", Range::positive());
  const TypePtr material = object(
      "an elastic material",
      {required("youngs_modulus", quantity("Pa", "210 GPa", Range::positive()), "Young's modulus."),
       required("poisson_ratio", number("0.3", {.low = 0, .high = 0.5, .high_open = true}), "Poisson's ratio.")});
  const std::vector<Key> of_contact{
      defaulted("pad_material", material, "{youngs_modulus: 210 GPa, poisson_ratio: 0.3}", "Of the pads."),
      defaulted("seat_material", material, "{youngs_modulus: 210 GPa, poisson_ratio: 0.3}",
                "Of what the pads stand on."),
  };
  const auto with = [](std::vector<Key> keys, const std::vector<Key>& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
  };
  return variant("a pivot", "type", common,
                 {
                     {"rigid", "a pivot that does not yield", {}},
                     {"spring",
                      "a pivot that yields in proportion to its force",
                      {required("stiffness", quantity("N/m", "2e8 N/m", Range::positive()), "Along the radius.")}},
                     {"ball_in_socket", "a sphere in a spherical socket, by Hertz",
                      with({required("ball_radius", radius, "Of the sphere."),
                            required("socket_radius", radius, "Of the socket, larger than the sphere.")},
                           of_contact)},
                     {"sphere_on_plane", "a sphere on a plane, by Hertz",
                      with({required("ball_radius", radius, "Of the sphere.")}, of_contact)},
                     {"sphere_in_cylinder", "a sphere in a cylindrical bore, by Hertz",
                      with({required("ball_radius", radius, "Of the sphere."),
                            required("cylinder_radius", radius, "Of the bore, larger than the sphere.")},
                           of_contact)},
                 });
}

TypePtr composite_point_format(const std::string& clearance, const std::string& parts) {
  const TypePtr angle = quantity("rad", "-90 deg");
  const std::vector<Word> not_given{{"none", "not given; for `--set`"}};
  return object(
      "an operating point",
      {
          required("journal_speed", quantity("rad/s", "3000 rpm"),
                   "Angular velocity of the journal about the bearing's z-axis."),
          optional("load", or_word(quantity("N", "2500 N", Range::positive()), not_given),
                   "Load on the journal: its position is sought."),
          defaulted("load_angle", angle, "-90 deg", "Direction of the load, from x towards y."),
          optional("eccentricity_ratio", or_word(number("0.6", Range::not_negative()), not_given),
                   "Position of the journal over " + clearance + ", instead of a load: its load is sought."),
          defaulted("eccentricity_angle", angle, "-90 deg", "Direction of that position, from x towards y."),
          defaulted(
              "whirl_ratio", number("1", Range::not_negative()), "1",
              "Frequency of the whirl at which " + parts +
                  " follow, over the journal's frequency, in stiffness and damping; 1: synchronous, 0: slow motions."),
      });
}

bool is_key_of_each_pad(const std::string& kind, const std::string& key) {
  const std::vector<std::string> of_all{"lubricant",   "grid",      "edge_pressure", "ambient_fill",
                                        "shear_force", "roughness", "materials",     "wear"},
      around_a_journal{"diameter", "width", "radial_clearance", "diametral_clearance", "thermal"},
      below_a_collar{"inner_diameter", "outer_diameter",           "sense",       "shape",
                     "edge_flow",      "reference_film_thickness", "temperature", "thermal"};
  const auto is_in = [&key](const std::vector<std::string>& keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  if (find_key(shared_bearing_keys(), key) != nullptr || is_in(of_all)) return true;
  return is_in(kind == "tilting_pad" ? around_a_journal : below_a_collar);
}

}  // namespace hersey::model
