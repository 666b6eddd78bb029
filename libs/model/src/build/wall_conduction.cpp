#include "hersey/model/wall_conduction.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "build/build_flexible.h"
#include "build/fingerprint.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/heated_surface.h"

namespace hersey::model {

fem::ThermalSurroundings surroundings_of(const Model& model, const Body& body) {
  fem::ThermalSurroundings surroundings = body.flexible->heat->surroundings;
  if (!body.flexible->heat->rest) return surroundings;
  std::set<std::pair<int, int>> films;
  const auto take = [&](const fem::FilmSurface& film) {
    for (const fem::ElementFace face : film.faces) films.emplace(face.element, face.face);
  };
  for (const Bearing& bearing : model.bearings) {
    if (bearing.shell.body == body.name && bearing.heated_shell) take(*bearing.heated_shell);
    if (bearing.journal.body == body.name && bearing.heated_journal) take(*bearing.heated_journal);
  }
  for (const DeformingSurface* surface : surfaces_on(model, body)) take(*surface->surface);
  std::erase_if(surroundings.cooled[*body.flexible->heat->rest].faces, [&](fem::ElementFace face) {
    return films.count({face.element, face.face}) > 0;
  });
  return surroundings;
}

namespace {

using Eigen::MatrixXd;

const Body& conducting_body(const Model& model, const std::string& name) {
  const auto found =
      std::find_if(model.bodies.begin(), model.bodies.end(), [&](const Body& body) { return body.name == name; });
  HERSEY_REQUIRE(found != model.bodies.end() && found->flexible && found->flexible->heat, "the reader checks bodies");
  return *found;
}

/// Values of the surface's functions at the nodes of the film's grid, (nodes, functions).
MatrixXd at_nodes(const SurfaceFunctions& functions, const film::FilmModel& film) {
  const film::Grid& grid = film.grid;
  MatrixXd psi = MatrixXd::Zero(grid.size(), functions.count());
  std::vector<SurfaceTerm> terms;
  for (int node = 0; node < grid.size(); ++node) {
    functions.at(grid.phi(node / grid.n_z), film.L * grid.z_over_L(node % grid.n_z), terms);
    for (const SurfaceTerm& term : terms) psi(node, term.index) = term.value;
  }
  return psi;
}

std::vector<double> angles_of(const film::Grid& grid) {
  std::vector<double> angles;
  angles.reserve(static_cast<std::size_t>(grid.n_phi));
  for (int i = 0; i < grid.n_phi; ++i) angles.push_back(grid.phi(i));
  return angles;
}

std::vector<double> stations_of(const film::FilmModel& film) {
  std::vector<double> z;
  z.reserve(static_cast<std::size_t>(film.grid.n_z));
  for (int j = 0; j < film.grid.n_z; ++j) z.push_back(film.L * film.grid.z_over_L(j));
  return z;
}

/// @param angles  as fem::HeatedSurfaceOptions has them
fem::HeatedSurface heated(const Model& model, const Body& body, const fem::FilmSurface& film,
                          std::vector<double> angles) {
  const BodyHeat& heat = *body.flexible->heat;
  const fem::HeatedSurfaceOptions options{.angles = std::move(angles),
                                          .T_reference = heat.T_reference,
                                          .fixed_dofs = fem::dofs_of(heat.fixed),
                                          .expands = heat.material.expansion > 0};
  const std::vector<fem::ThermalMaterial> materials(body.flexible->materials.size(), heat.material);
  fem::HeatedSurface found =
      fem::heated_surface(assembled(body), materials, surroundings_of(model, body), film, options);
  if (!found.solved())
    throw InputError(Fault{body.flexible->position, "bodies." + body.name + ".flexible.heat", found.message,
                           "a body that `cooling` or `temperatures` reach, and that `fixed` holds if at all", ""});
  return found;
}

/// All that heated() depends on but the angles.
void add_wall(const Model& model, const Body& body, const fem::FilmSurface& film, Fingerprint& print) {
  const BodyHeat& heat = *body.flexible->heat;
  add_mesh(*body.flexible->mesh, print);
  for (const fem::SolidMaterial& material : body.flexible->materials) print.add(material.D);
  print.add(heat.material.conductivity), print.add(heat.material.expansion), print.add(heat.T_reference);
  for (const fem::CooledFaces& cooled : surroundings_of(model, body).cooled)
    print.add(cooled.faces), print.add(cooled.transfer), print.add(cooled.T_ambient);
  for (const fem::PrescribedNodes& prescribed : heat.surroundings.prescribed)
    print.add(prescribed.nodes), print.add(prescribed.T);
  print.add(heat.fixed);
  print.add(film.cylinder.X.R), print.add(film.cylinder.X.r), print.add(film.cylinder.R), print.add(film.cylinder.L);
  print.add(film.functions.around()), print.add(film.functions.along()), print.add(film.faces);
}

}  // namespace

std::shared_ptr<const film::WallConduction> wall_conduction(const Model& model, const Bearing& bearing) {
  if (!bearing.heated_shell) return nullptr;
  const Body& body = conducting_body(model, bearing.shell.body);
  const fem::FilmSurface& film = *bearing.heated_shell;
  fem::HeatedSurface found = heated(model, body, film, angles_of(bearing.film.grid));
  auto wall = std::make_shared<film::WallConduction>();
  wall->T0 = std::move(found.T0);
  wall->rise = std::move(found.rise);
  wall->T_body0 = std::move(found.T_body0);
  wall->rise_body = std::move(found.rise_body);
  wall->T_reference = body.flexible->heat->T_reference;
  if (found.shape0.size() == 0) return wall;
  const MatrixXd psi = at_nodes(film.functions, bearing.film);
  wall->shape0 = psi * found.shape0;
  wall->shape_by_heat = psi * found.shape_by_heat;
  wall->shape_by_rise = psi * found.shape_by_rise;
  return wall;
}

std::shared_ptr<const film::JournalConduction> journal_conduction(const Model& model, const Bearing& bearing) {
  if (!bearing.heated_journal) return nullptr;
  const Body& body = conducting_body(model, bearing.journal.body);
  const fem::FilmSurface& film = *bearing.heated_journal;
  const fem::HeatedSurface found = heated(model, body, film, {});
  auto journal = std::make_shared<film::JournalConduction>();
  journal->T0 = found.T0[0];
  journal->rise = std::max(found.rise(0, 0), 0.0);
  journal->T_body0 = found.T_body0;
  journal->rise_body = found.rise_body.col(0);
  journal->T_reference = body.flexible->heat->T_reference;
  if (found.shape0.size() == 0) return journal;
  const std::vector<double> z = stations_of(bearing.film);
  journal->shape0 = fem::mean_around(film.functions, found.shape0, z);
  journal->shape_by_heat = fem::mean_around(film.functions, found.shape_by_heat, z);
  journal->shape_by_rise = fem::mean_around(film.functions, found.shape_by_rise, z);
  return journal;
}

std::string fingerprint_of_wall(const Model& model, const Bearing& bearing) {
  Fingerprint print;
  if (!bearing.heated_shell) return print.take();
  add_wall(model, conducting_body(model, bearing.shell.body), *bearing.heated_shell, print);
  for (const double phi : angles_of(bearing.film.grid)) print.add(phi);
  for (const double z : stations_of(bearing.film)) print.add(z);
  return print.take();
}

std::string fingerprint_of_journal(const Model& model, const Bearing& bearing) {
  Fingerprint print;
  if (!bearing.heated_journal) return print.take();
  add_wall(model, conducting_body(model, bearing.journal.body), *bearing.heated_journal, print);
  for (const double z : stations_of(bearing.film)) print.add(z);
  return print.take();
}

}  // namespace hersey::model
