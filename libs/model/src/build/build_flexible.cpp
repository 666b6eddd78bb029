#include "build/build_flexible.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/mbd/nodal_body.h"

namespace hersey::model {
namespace {

constexpr int modes_of_nodal_body = 100000;  // all above the tolerance

fem::ReductionOptions options_of(const Flexible& flexible, const std::vector<const DeformingSurface*>& surfaces) {
  fem::ReductionOptions options;
  options.modes = flexible.modes;
  if (flexible.highest > 0) options.highest = 2 * std::numbers::pi * flexible.highest;
  options.static_error = flexible.static_error;
  for (const std::string& name : flexible.load_surfaces)
    options.surfaces.push_back(fem::loaded_surface(*flexible.mesh, name, flexible.load_harmonics));
  options.contact_faces = flexible.contact_faces;
  if (flexible.nodal) options.film_modes = modes_of_nodal_body;
  options.film_surfaces.reserve(surfaces.size());
  for (const DeformingSurface* surface : surfaces) {
    options.film_surfaces.push_back(*surface->surface);
    options.film_surfaces.back().modes = surface->modes;
  }
  return options;
}

/// `mesh` is null where the body comes reduced from a file.
fem::ReducedBody reduced(const Body& body, const fem::ElasticBody* mesh, const fem::ReductionOptions& options) {
  if (mesh == nullptr) return *body.flexible->reduced;
  fem::Reduction reduction = fem::reduce(*mesh, interface_frames(body), options);
  if (!reduction.solved()) throw cannot_be_held(body, reduction.message);
  return std::move(reduction.body);
}

}  // namespace

fem::ElasticBody assembled(const Body& body) {
  const Flexible& flexible = *body.flexible;
  try {
    return fem::assemble(*flexible.mesh, flexible.materials);
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) {
      fault.position = flexible.position;
      fault.path = "bodies." + body.name + ".flexible.mesh";
    }
    throw InputError(std::move(faults));
  }
}

std::vector<fem::InterfaceFrame> interface_frames(const Body& body) {
  std::vector<fem::InterfaceFrame> frames;
  frames.reserve(body.frames.size());
  for (const Frame& frame : body.frames) {
    const bool is_average = frame.connection == fem::Connection::average;
    frames.push_back(
        fem::braced(*body.flexible->mesh,
                    {frame.name, frame.X_BF.r, frame.nodes, frame.connection,
                     is_average ? fem::face_weights(*body.flexible->mesh, frame.nodes) : std::vector<double>()}));
  }
  return frames;
}

InputError cannot_be_held(const Body& body, const std::string& why) {
  return InputError({.position = body.flexible->position,
                     .path = "bodies." + body.name + ".flexible",
                     .found = why,
                     .expected = "a mesh that can be held at its frames",
                     .suggestion = "see `hersey mesh` for its sets and its quality"});
}

BuiltFlexible build_flexible(const Body& body, const std::vector<const DeformingSurface*>& surfaces, bool is_let_go,
                             std::vector<BuiltSurface>& kept) {
  HERSEY_REQUIRE(body.flexible && body.flexible->mesh, "the reader checks meshes");
  const Flexible& flexible = *body.flexible;
  std::optional<fem::ElasticBody> mesh;
  if (!flexible.reduced) mesh = assembled(body);
  const fem::ReducedBody shapes = reduced(body, mesh ? &*mesh : nullptr, options_of(flexible, surfaces));
  BuiltFlexible built;
  built.name = body.name;
  built.mesh = flexible.mesh;
  built.materials = shapes.materials;
  built.strain = flexible.strain;
  built.static_errors = shapes.static_errors;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    kept.push_back({body.name, surfaces[i]->surface->functions.around(), surfaces[i]->surface->functions.along(),
                    static_cast<int>(shapes.film_modes[i].compliance.size()), shapes.film_modes[i].lost});
  mbd::ModalBodyData data = mbd::modal_data(shapes, flexible.damping, &built.shapes);
  if (flexible.nodal) {
    auto nodal = std::make_shared<mbd::NodalBody>(std::move(*mesh), shapes, flexible.damping, flexible.strain);
    if (is_let_go) nodal->start_undeformed();
    built.body = std::move(nodal);
  } else {
    built.body = std::make_shared<mbd::ModalBody>(std::move(data));
  }
  for (const double omega : shapes.internal_omega) built.frequencies.push_back(omega / (2 * std::numbers::pi));
  return built;
}

mbd::ModalBodyData modal_shapes(const Body& body, const std::vector<const DeformingSurface*>& surfaces) {
  const Flexible& flexible = *body.flexible;
  std::optional<fem::ElasticBody> mesh;
  if (!flexible.reduced) mesh = assembled(body);
  return mbd::modal_data(reduced(body, mesh ? &*mesh : nullptr, options_of(flexible, surfaces)), flexible.damping);
}

std::vector<const DeformingSurface*> surfaces_on(const Model& model, const Body& body) {
  std::vector<const DeformingSurface*> surfaces;
  for (const Bearing& bearing : model.bearings) {
    if (bearing.shell_surface && bearing.shell.body == body.name) surfaces.push_back(&*bearing.shell_surface);
    if (bearing.journal_surface && bearing.journal.body == body.name) surfaces.push_back(&*bearing.journal_surface);
  }
  return surfaces;
}

std::shared_ptr<const bearing::ElasticSurface> elastic_surface(const DeformingSurface& surface, const Body& body,
                                                               const std::string& frame, const Eigen::MatrixXd& U) {
  const auto at = std::find_if(body.frames.begin(), body.frames.end(), [&](const Frame& f) { return f.name == frame; });
  const fem::FilmSurface& map = *surface.surface;
  // No shape moves the first frame, nor the body's own axes, which ride on it.
  const auto place = at == body.frames.end() ? 0 : at - body.frames.begin();
  const Eigen::MatrixXd D =
      place == 0 ? map.coefficients(U)
                 : fem::coefficients_from_frame(map, *body.flexible->mesh, U, at->X_BF.r, 6 * (place - 1));
  return std::make_shared<const bearing::ElasticSurface>(bearing::ElasticSurface{map.functions, D});
}

}  // namespace hersey::model
