#include <algorithm>

#include "hersey/core/contract.h"
#include "hersey/film/film_solver.h"
#include "interpret/bearings/film_reader.h"
#include "interpret/bearings/kinds/kinds.h"
#include "schema/film_vocabulary.h"

namespace hersey::model {

void interpret_bearings(Context& context) {
  const std::vector<KindReader> kinds = bearing_kinds();
  for (const auto& [name, value] : section(context.root, "bearings")) {
    const std::string& tag = value.text;
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&tag](const KindReader& k) { return k.kind == tag; });
    if (kind == kinds.end()) continue;  // an unknown kind has been reported
    Bearing bearing;
    bearing.name = name;
    bearing.position = value.key_position;
    kind->read(context, value, bearing);
    bearing.solver = value.find("solver") != nullptr ? meaning_of(value, "solver", film_solver_words)
                                                     : film::usual_solver(bearing.film.grid);
    bearing.coupling = coupling_of(value);
    kind->read_point(context, value, bearing);
    context.model.bearings.push_back(std::move(bearing));
  }
}

ShortNames short_names(const Model& model, const Bearing& bearing) {
  const std::string name = bearing.kind->name();
  for (const KindReader& kind : bearing_kinds())
    if (kind.kind == name) return kind.short_names(model, bearing);
  HERSEY_REQUIRE(false, "every kind of bearing has a reader");
}

}  // namespace hersey::model
