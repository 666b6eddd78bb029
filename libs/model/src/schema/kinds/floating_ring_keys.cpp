#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"

// Keys of a floating ring: its two films and the ring between them.
namespace hersey::model {
namespace {

/// One of the films, by keys that a journal bearing has.
TypePtr ring_film_format(const std::string& which) {
  const std::vector<std::string> of_film{"diameter", "width",         "radial_clearance", "diametral_clearance",
                                         "grid",     "edge_pressure", "ambient_fill",     "supply",
                                         "features"};
  std::vector<Key> keys;
  for (Key& key : journal_keys())
    if (std::find(of_film.begin(), of_film.end(), key.name) != of_film.end()) keys.push_back(std::move(key));
  keys.push_back(optional("lubricant", reference(Refers::lubricant, "warm_oil"),
                          "Oil of this film, which may be warmer than that of the other.", "that of the bearing"));
  return with_exactly_one(object("the " + which + " film", std::move(keys)),
                          {"radial_clearance", "diametral_clearance"});
}

TypePtr ring_format() {
  return object(
      "the ring",
      {
          defaulted("rotation",
                    choice({{"free", "full-floating: the torques of both films rotate it"},
                            {"locked", "semi-floating: a pin keeps it from rotating"}}),
                    "free", "Whether the ring rotates."),
          defaulted("density", quantity("kg/m^3", "8800 kg/m^3", Range::not_negative()), "8800 kg/m^3",
                    "Gives its mass and moments of inertia, as wide as the wider film; 0: a ring without mass."),
          optional("mass", quantity("kg", "5 g", Range::not_negative()), "Of the ring.", "from `density`"),
          defaulted("centring_stiffness", quantity("N/m", "1e5 N/m", Range::not_negative()), "0 N/m",
                    "Of springs between ring and shell, such as a squirrel cage or O-rings, in every direction."),
          optional("initial_speed", quantity("rad/s", "10000 rpm"),
                   "Speed of the ring where a run begins, and a first guess of a steady motion.",
                   "a quarter of the journal's, where a drive rotates that"),
      });
}

}  // namespace

std::vector<Key> floating_ring_keys() {
  std::vector<Key> keys;
  for (Key& key : journal_keys())
    if (key.name == "shell" || key.name == "journal" || key.name == "shear_force") keys.push_back(std::move(key));
  keys.insert(keys.begin() + 2, {required("inner", ring_film_format("inner"), "Film between journal and ring."),
                                 required("outer", ring_film_format("outer"), "Film between ring and shell."),
                                 defaulted("ring", ring_format(), "{}", "What floats between them.")});
  keys.push_back(optional("operating_point", composite_point_format("the sum of both clearances", "the ring"),
                          "Speed and load, or position, of the bearing by itself (`hersey bearing`); a simulation has "
                          "its own.",
                          "given on the command line"));
  return keys;
}

}  // namespace hersey::model
