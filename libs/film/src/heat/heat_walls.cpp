#include "heat/heat_walls.h"

#include <cmath>
#include <numbers>

namespace hersey::film {

RingConductances conductances(const FilmModel& model, const GridGeometry& geometry, const RingWall& ring) {
  const double R = model.R, Ro = ring.outer_radius, middle = 0.5 * (R + Ro), k = ring.conductivity, L = model.L;
  RingConductances c;
  c.inside = R * std::log(middle / R) / k;
  // Heat flows from the middle through the outer half, then over the surface.
  const double outwards = ring.transfer > 0 ? 1 / (std::log(Ro / middle) / (k * L) + 1 / (ring.transfer * Ro * L)) : 0;
  for (int i = 0; i < model.grid.n_phi; ++i) {
    const double angle = geometry.width_phi[i] / R, both_ends = (Ro * Ro - R * R) * angle;
    const bool is_last = model.grid.next(i) < 0, is_first = model.grid.before(i) < 0;
    // Behind the groove after a patch the ring runs on to the next one.
    const int next = (i + 1) % model.grid.n_phi;
    const double to_next =
        is_last ? std::remainder(geometry.phi[next] - geometry.phi[i], 2 * std::numbers::pi) : geometry.dx[i] / R;
    const double step = to_next > 0 ? to_next : to_next + 2 * std::numbers::pi;
    c.around.push_back(is_last && !ring.closes ? 0 : k * (Ro - R) * L / (middle * step));
    // A pad gives off heat with its leading and trailing faces as well.
    const double free_faces = ring.closes ? 0 : ((is_last ? 1 : 0) + (is_first ? 1 : 0)) * (Ro - R) * L;
    c.outside.push_back(outwards * angle + ring.transfer * (both_ends + free_faces));
    c.capacity.push_back(ring.heat_capacity * L * 0.5 * both_ends);
  }
  return c;
}

bool has_own_temperatures(const ShellWall& shell) {
  return std::holds_alternative<RingWall>(shell) || std::holds_alternative<BodyWall>(shell);
}

const WallConduction* conduction_of(const ShellWall& shell) {
  const auto* body = std::get_if<BodyWall>(&shell);
  return body == nullptr ? nullptr : body->conduction.get();
}

const JournalConduction* conduction_of(const JournalWall& journal) {
  const auto* body = std::get_if<BodyJournal>(&journal);
  return body == nullptr ? nullptr : body->conduction.get();
}

bool has_own_temperature(const JournalWall& journal) {
  return std::holds_alternative<FreeJournal>(journal) || std::holds_alternative<BodyJournal>(journal);
}

bool conducts(const ShellWall& shell) { return !std::holds_alternative<InsulatedWall>(shell); }

bool conducts(const JournalWall& journal) { return !std::holds_alternative<InsulatedWall>(journal); }

}  // namespace hersey::film
