#include "observation/film_pressures.h"

#include <algorithm>
#include <cmath>

namespace hersey::run {

using Eigen::Index;
using Eigen::VectorXd;

FilmPressures::FilmPressures(const model::Model& model, const model::Machine& machine, const std::string& body)
    : machine_(machine) {
  const auto flexible = std::find_if(machine.flexibles.begin(), machine.flexibles.end(),
                                     [&](const model::BuiltFlexible& candidate) { return candidate.name == body; });
  nodes_ = flexible->mesh->nodes.size();
  for (std::size_t i = 0; i < model.bearings.size(); ++i) {
    const model::Bearing& bearing = model.bearings[i];
    if (bearing.shell_surface && bearing.shell.body == body) add(bearing, i, true, *flexible->mesh);
    if (bearing.journal_surface && bearing.journal.body == body) add(bearing, i, false, *flexible->mesh);
  }
}

void FilmPressures::add(const model::Bearing& bearing, std::size_t i, bool is_shell, const fem::Mesh& mesh) {
  const fem::FilmSurface& surface = *(is_shell ? bearing.shell_surface : bearing.journal_surface)->surface;
  const film::Grid& grid = bearing.film.grid;
  Surface on{i, is_shell, VectorXd(grid.size()), VectorXd(grid.size()), fem::SurfacePressure(mesh, surface)};
  for (int k = 0; k < grid.size(); ++k) {
    on.phi[k] = grid.phi(k / grid.n_z);
    on.z[k] = bearing.film.L * grid.z_over_L(k % grid.n_z);
  }
  surfaces_.push_back(std::move(on));
}

FilmPressures::AtNodes FilmPressures::at_nodes(const StepRecord& step) const {
  AtNodes nodes{VectorXd::Zero(static_cast<Index>(nodes_)), VectorXd::Zero(static_cast<Index>(nodes_))};
  for (const Surface& on : surfaces_) {
    const VectorXd& forces = step.bearings[on.bearing].film.normal_forces;
    const film::FilmFields fields = machine_.bearings[on.bearing].bearing->fields();
    // Both pressures act on the same share of the area.
    const VectorXd all = (fields.p.cwiseMax(0) + fields.p_asperity).cwiseMax(1e-300);
    const VectorXd of_contact = forces.cwiseProduct(fields.p_asperity.cwiseQuotient(all));
    // A journal's mesh has rotated relative to the film.
    const Matrix3& R_AB = step.journal_motions[on.bearing].X_AB.R;
    const double turned = on.is_shell ? 0 : std::atan2(R_AB(1, 0), R_AB(0, 0));
    const VectorXd phi = on.phi.array() - turned;
    on.mesh.add(on.mesh.coefficients(phi, on.z, forces), nodes.film);
    on.mesh.add(on.mesh.coefficients(phi, on.z, of_contact), nodes.contact);
  }
  return nodes;
}

}  // namespace hersey::run
