#include "start/film_surface_rows.h"

#include <fmt/format.h>

#include "start/facing_surfaces.h"

namespace hersey::run {
namespace {

std::string described(const model::BuiltSurface& surface) {
  std::string text = fmt::format(
      "deforms with the mesh of {}: {} x {} functions (around x along), {} static answers to film "
      "pressure",
      surface.body, surface.around, surface.along, surface.modes);
  if (surface.lost > 0) text += fmt::format("; the next one has {:.2g} of the first one's compliance", surface.lost);
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> film_surface_rows(const model::Model& model,
                                                                   const model::Machine& machine) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (std::size_t i = 0; i < machine.bearings.size(); ++i) {
    const model::BuiltBearing& built = machine.bearings[i];
    const auto add = [&](const char* side, const model::BuiltSurface& surface, bool shell) {
      const SurfaceOffset offset = offset_of(model, model.bearings[i], shell);
      rows.emplace_back(built.bearing->name() + ": " + side + " surface",
                        fmt::format("{}; {}{}", described(surface), offset.text(),
                                    offset.is_large() ? ", WHICH THE FILM LEAVES OUT" : ""));
    };
    if (built.shell) add("shell", *built.shell, true);
    if (built.journal) add("journal", *built.journal, false);
  }
  return rows;
}

}  // namespace hersey::run
