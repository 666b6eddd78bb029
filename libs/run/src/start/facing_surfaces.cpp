#include "start/facing_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "hersey/bearing/clearance.h"
#include "hersey/fem/film_radii.h"

namespace hersey::run {
namespace {

constexpr double least_facing = 0.9;  // share of the width
constexpr double round_off = 1e-3;    // of the clearance

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

const fem::Mesh& mesh_of(const model::Model& model, const std::string& body) {
  return *std::find_if(model.bodies.begin(), model.bodies.end(), [&](const model::Body& candidate) {
            return candidate.name == body;
          })->flexible->mesh;
}

std::optional<fem::SurfaceRadii> radii_of(const model::Model& model, const model::Bearing& bearing, bool shell) {
  const auto& surface = shell ? bearing.shell_surface : bearing.journal_surface;
  if (!surface) return std::nullopt;
  return fem::surface_radii(mesh_of(model, (shell ? bearing.shell : bearing.journal).body), *surface->surface);
}

/// Between the nodes of the film's grid; phi in 0..2 pi.
double interpolated(const Eigen::VectorXd& field, const film::FilmModel& film, double phi, double z) {
  const film::Grid& grid = film.grid;
  int i = 0, j = 0;
  while (i + 1 < grid.n_phi && grid.phi(i + 1) <= phi) ++i;
  while (j + 2 < grid.n_z && film.L * grid.z_over_L(j + 1) <= z) ++j;
  const int next = (i + 1) % grid.n_phi;
  const double end = next == 0 ? grid.phi(0) + 2 * std::numbers::pi : grid.phi(next);
  const double a = std::clamp((phi - grid.phi(i)) / (end - grid.phi(i)), 0.0, 1.0);
  const double z_j = film.L * grid.z_over_L(j);
  const double b = (z - z_j) / (film.L * grid.z_over_L(j + 1) - z_j);
  const auto along = [&](int column) {
    return (1 - b) * field[grid.index(column, j)] + b * field[grid.index(column, j + 1)];
  };
  return (1 - a) * along(i) + a * along(next);
}

/// Least clearance that the meshes leave between shell and journal.
struct LeastClearance {
  double value = std::numeric_limits<double>::infinity();
  double phi = 0, z = 0;
  double shell = 0, journal = 0;  ///< deviations of both sides' radii there [m]
  double negative = 0;            ///< share of the film without clearance
};

LeastClearance least_clearance(const model::Bearing& bearing, const std::optional<fem::SurfaceRadii>& shell,
                               const std::optional<fem::SurfaceRadii>& journal, const Eigen::VectorXd& gap,
                               const Pose& X_AB) {
  using fem::SurfaceRadii;
  const film::FilmModel& film = bearing.film;
  const double turned = std::atan2(X_AB.R(1, 0), X_AB.R(0, 0));
  LeastClearance least;
  for (int i = 0; i < SurfaceRadii::around; ++i)
    for (int k = 0; k < SurfaceRadii::along; ++k) {
      const double phi = SurfaceRadii::phi_of(i), z = ((k + 0.5) / SurfaceRadii::along - 0.5) * film.L;
      const double of_shell = shell ? shell->at(phi, z) : 0;
      // The mesh of a journal has its own radius, less than the bore's by the clearance.
      const double of_journal = journal ? journal->at(phi - turned, z - X_AB.r.z()) + bearing::clearance(film) : 0;
      const double clearance = interpolated(gap, film, phi, z) + of_shell - of_journal;
      if (clearance < 0) least.negative += 1.0 / (SurfaceRadii::around * SurfaceRadii::along);
      if (clearance < least.value) least = {clearance, phi, z, of_shell, of_journal, least.negative};
    }
  return least;
}

std::string side_text(const char* side, double nominal, double deviation) {
  if (std::abs(deviation) < 1e-9) return fmt::format("the {}'s mesh has the bearing's {:.6g} mm", side, 1e3 * nominal);
  return fmt::format("the {}'s mesh has a radius of {:.6g} mm there, {:.3g} um {} than the bearing's {:.6g} mm", side,
                     1e3 * (nominal + deviation), 1e6 * std::abs(deviation), deviation < 0 ? "less" : "more",
                     1e3 * nominal);
}

Fault fault_of(const model::Model& model, const model::Bearing& bearing, const LeastClearance& least) {
  const double R = bearing.film.R;
  std::string found =
      fmt::format("a clearance of {:.3g} um at {:.0f} deg, z = {:.3g} mm once the meshes are put together",
                  1e6 * least.value, degrees(least.phi), 1e3 * least.z);
  found += fmt::format(" (negative on {:.2g} % of the film): ", 100 * least.negative);
  if (bearing.shell_surface) found += side_text("shell", R, least.shell);
  if (bearing.shell_surface && bearing.journal_surface) found += ", ";
  if (bearing.journal_surface) found += side_text("journal", R - bearing::clearance(bearing.film), least.journal);
  const bool blames_shell = bearing.shell_surface && (!bearing.journal_surface || -least.shell > least.journal);
  const std::string path = "bearings." + bearing.name + (blames_shell ? ".shell_surface" : ".journal_surface");
  return {model.position_of(path), path, std::move(found), "meshes with a gap between them everywhere at the start",
          "check the meshes' radii and roundness there (nodes in the middle of edges on the curve too), their length "
          "unit, the frames' origins, and where the journal starts"};
}

void require_facing_widths(const model::Model& model, const model::Bearing& bearing, double offset) {
  if (!bearing.journal_surface) return;
  const double share = std::max(0.0, 1 - std::abs(offset) / bearing.film.L);
  if (share >= least_facing) return;
  const std::string path = "bearings." + bearing.name + ".journal_surface";
  throw InputError(
      Fault{model.position_of(path), path,
            fmt::format("surfaces that do not face each other: the journal's lies {:.4g} mm along the axis from the "
                        "shell's, so that {:.0f} % of the width face it",
                        1e3 * offset, 100 * share),
            "frames of shell and journal with the same middle of the width at the start",
            fmt::format("move the origin of {}.{} along its z-axis, or the bodies", bearing.journal.body,
                        bearing.journal.frame)});
}

}  // namespace

std::string SurfaceOffset::text() const {
  return fmt::format(
      "nodes at a radius of {:.6g} mm in the mean, {:.2g} um {} the bearing's {:.6g} mm ({:.2g} % of the "
      "clearance)",
      1e3 * (nominal + mean), 1e6 * std::abs(mean), mean < 0 ? "below" : "above", 1e3 * nominal, 100 * share);
}

SurfaceOffset offset_of(const model::Model& model, const model::Bearing& bearing, bool shell) {
  const double c = bearing::clearance(bearing.film);
  SurfaceOffset offset{.nominal = shell ? bearing.film.R : bearing.film.R - c};
  if (const auto radii = radii_of(model, bearing, shell)) offset.mean = bearing.film.R + radii->mean - offset.nominal;
  offset.share = std::abs(offset.mean) / c;
  return offset;
}

void require_clearance(const model::Model& model, model::Machine& machine, const solver::State& start) {
  for (std::size_t i = 0; i < model.bearings.size(); ++i) {
    const model::Bearing& bearing = model.bearings[i];
    const auto shell = radii_of(model, bearing, true), journal = radii_of(model, bearing, false);
    if (!shell && !journal) continue;
    const model::BuiltBearing& built = machine.bearings[i];
    const Pose X_AB = machine.mechanism->relative_motion(start, built.force).X_AB;
    require_facing_widths(model, bearing, X_AB.r.z());
    if (bearing.film.compliance > 0) continue;  // a liner may be pushed in
    const LeastClearance least = least_clearance(bearing, shell, journal, built.bearing->fields().h, X_AB);
    if (least.value < -round_off * bearing::clearance(bearing.film)) throw InputError(fault_of(model, bearing, least));
  }
}

std::vector<Fault> offset_warnings(const model::Model& model) {
  std::vector<Fault> warnings;
  for (const model::Bearing& bearing : model.bearings)
    for (const bool shell : {true, false}) {
      if (!(shell ? bearing.shell_surface : bearing.journal_surface)) continue;
      const SurfaceOffset offset = offset_of(model, bearing, shell);
      if (!offset.is_large()) continue;
      const std::string path = "bearings." + bearing.name + (shell ? ".shell_surface" : ".journal_surface");
      warnings.push_back(
          {model.position_of(path), path, offset.text(),
           fmt::format("a mesh of the bearing's size, to {:.0f} % of the clearance", 100 * SurfaceOffset::warned_from),
           "the film reckons with the bearing's radius and clearance; from the mesh come deformations alone"});
    }
  return warnings;
}

}  // namespace hersey::run
