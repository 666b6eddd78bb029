#include "hersey/bearing/quantities.h"

#include <algorithm>
#include <array>

#include "hersey/core/contract.h"

namespace hersey::bearing {

std::span<const QuantityList> bearing_quantities() {
  static const std::array lists{QuantityList{"Film", film_quantities()},
                                QuantityList{"Heat", heat_quantities()},
                                QuantityList{"Journal bearings", journal_quantities()},
                                QuantityList{"Plane sliders", plane_slider_quantities()},
                                QuantityList{"Thrust bearings", thrust_quantities()},
                                QuantityList{"Squeeze-film dampers", squeeze_film_damper_quantities()},
                                QuantityList{"Piston skirts", skirt_quantities()}};
  return lists;
}

const Quantity& quantity(std::string_view id) {
  const Quantity* found = nullptr;
  for (const QuantityList& list : bearing_quantities()) {
    const auto in_list = std::find_if(list.quantities.begin(), list.quantities.end(),
                                      [&](const Quantity& candidate) { return candidate.id == id; });
    if (in_list != list.quantities.end()) found = &*in_list;
  }
  HERSEY_REQUIRE(found != nullptr, "the table of quantities has " + std::string(id));
  return *found;
}

}  // namespace hersey::bearing
