#include "hersey/film/cavitated_shear.h"

namespace hersey::film {

std::string choice_in_words(CavitatedShear shear) {
  return shear == CavitatedShear::full
             ? "the cavitated film is sheared over the whole gap (`cavitated_shear: full`); over the oil's share of it "
               "(`film_share`)"
             : "the cavitated film is sheared over the oil's share of the gap (`cavitated_shear: film_share`); over "
               "the whole gap (`full`)";
}

}  // namespace hersey::film
