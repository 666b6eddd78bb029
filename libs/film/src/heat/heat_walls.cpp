#include "heat/heat_walls.h"

#include <cmath>
#include <numbers>
#include <variant>

namespace hersey::film {

namespace {

// Every line of the film lies on a strip of even thickness t across the film's width. Heat passes half of t to either
// side; along the film the strips are as far apart as the rows of the film, so that heat prefers the inner radius of an
// annulus (thermal.72).
RingConductances conductances_behind_plane(const FilmModel& model, const GridGeometry& geometry, const RingWall& wall) {
  const double t = wall.outer_radius - model.R, k = wall.conductivity;
  double across = 0;  // integral of dz over the stretch, half of which each row has to its neighbours
  for (int j = 0; j + 1 < model.grid.n_z; ++j)
    across += 0.5 * geometry.dz[j] * (1 / geometry.stretch[j] + 1 / geometry.stretch[j + 1]);
  const double sides = geometry.stretch[0] + geometry.stretch[model.grid.n_z - 1];
  RingConductances c;
  c.inside = 0.5 * t / k;
  for (int i = 0; i < model.grid.n_phi; ++i) {
    double area = 0;
    for (int j = 0; j < model.grid.n_z; ++j) area += geometry.area(i, j);
    const int ends = (model.grid.next(i) < 0 ? 1 : 0) + (model.grid.before(i) < 0 ? 1 : 0);
    const double back = wall.transfer > 0 ? area / (c.inside + 1 / wall.transfer) : 0;
    c.around.push_back(model.grid.next(i) < 0 ? 0 : k * t * across / geometry.dx[i]);
    c.outside.push_back(back + wall.transfer * t * (sides * geometry.width_phi[i] + ends * model.L));
    c.capacity.push_back(wall.heat_capacity * t * area);
  }
  return c;
}

RingConductances conductances_around(const FilmModel& model, const GridGeometry& geometry, const RingWall& ring) {
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

}  // namespace

RingConductances conductances(const FilmModel& model, const GridGeometry& geometry, const RingWall& ring) {
  const bool is_around = std::holds_alternative<Cylinder>(model.surface);
  return is_around ? conductances_around(model, geometry, ring) : conductances_behind_plane(model, geometry, ring);
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
