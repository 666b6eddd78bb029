#include "film_surface_rows.h"

#include <fmt/format.h>

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

std::vector<std::pair<std::string, std::string>> film_surface_rows(const model::Machine& machine) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const model::BuiltBearing& built : machine.bearings) {
    if (built.shell) rows.emplace_back(built.bearing->name() + ": shell surface", described(*built.shell));
    if (built.journal) rows.emplace_back(built.bearing->name() + ": journal surface", described(*built.journal));
  }
  return rows;
}

}  // namespace hersey::run
