#include "build/build_flexible.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "build/known_reductions.h"
#include "build/reduction_folder.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/core/stopwatch.h"
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

// Rods and cranks of an engine fit; of a mesh of a hundred thousand nodes with a hundred shapes, 240 MB each, one.
constexpr std::size_t kBytesKept = 500'000'000;

constexpr double kWorthAFile = 0.1;  // [s] of reducing: less is done again as fast as a file is read and compared

KnownReductions& known_reductions() {
  static KnownReductions known(kBytesKept);
  return known;
}

std::shared_ptr<const fem::ReducedBody> kept_by_another_process(const Body& body, const std::string& fingerprint) {
  const std::shared_ptr<const ReductionFolder> folder = reduction_folder();
  std::optional<fem::ReducedBody> kept = folder ? folder->find(fingerprint) : std::nullopt;
  if (!kept) return nullptr;
  kept->mesh = *body.flexible->mesh;
  kept->nodes = kept->mesh.nodes;
  kept->materials = body.flexible->materials;
  kept->frames = interface_frames(body);
  return std::make_shared<const fem::ReducedBody>(std::move(*kept));
}

// Reduces the body, and keeps what took long for later processes.
std::shared_ptr<const fem::ReducedBody> reduced_anew(const Body& body,
                                                     const std::vector<const DeformingSurface*>& surfaces,
                                                     const std::string& fingerprint,
                                                     std::optional<fem::ElasticBody>& mesh) {
  double seconds = 0;
  mesh = assembled(body);
  fem::Reduction reduction;
  {
    const Stopwatch stopwatch(seconds);
    reduction = fem::reduce(*mesh, interface_frames(body), options_of(*body.flexible, surfaces));
  }
  if (!reduction.solved()) throw insufficient_supports(body, reduction.message);
  const std::shared_ptr<const ReductionFolder> folder = reduction_folder();
  if (folder && seconds > kWorthAFile) folder->keep(reduction.body, fingerprint);
  return std::make_shared<const fem::ReducedBody>(std::move(reduction.body));
}

// @param mesh  receives the assembled mesh where the body had to be reduced for this
std::shared_ptr<const fem::ReducedBody> reduced(const Body& body, const std::vector<const DeformingSurface*>& surfaces,
                                                std::optional<fem::ElasticBody>& mesh) {
  if (body.flexible->reduced) return body.flexible->reduced;
  Fingerprint print;
  add_reduction(body, surfaces, print);
  std::string fingerprint = print.take();
  if (auto known = known_reductions().find(fingerprint)) return known;
  std::shared_ptr<const fem::ReducedBody> shapes = kept_by_another_process(body, fingerprint);
  if (!shapes) shapes = reduced_anew(body, surfaces, fingerprint, mesh);
  known_reductions().keep(std::move(fingerprint), shapes);
  return shapes;
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

InputError insufficient_supports(const Body& body, const std::string& why) {
  return InputError({.position = body.flexible->position,
                     .path = "bodies." + body.name + ".flexible",
                     .found = why,
                     .expected = "a mesh without rigid motion once its frames are fixed",
                     .suggestion = "see `hersey mesh` for its sets and its quality"});
}

BuiltFlexible build_flexible(const Body& body, const std::vector<const DeformingSurface*>& surfaces,
                             bool starts_undeformed, std::vector<BuiltSurface>& kept) {
  HERSEY_REQUIRE(body.flexible && body.flexible->mesh, "the reader checks meshes");
  const Flexible& flexible = *body.flexible;
  std::optional<fem::ElasticBody> mesh;
  const std::shared_ptr<const fem::ReducedBody> known = reduced(body, surfaces, mesh);
  const fem::ReducedBody& shapes = *known;
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
    if (!mesh) mesh = assembled(body);
    auto nodal = std::make_shared<mbd::NodalBody>(std::move(*mesh), shapes, flexible.damping, flexible.strain);
    if (starts_undeformed) nodal->start_undeformed();
    built.body = std::move(nodal);
  } else {
    built.body = std::make_shared<mbd::ModalBody>(std::move(data));
  }
  for (const double omega : shapes.internal_omega) built.frequencies.push_back(omega / (2 * std::numbers::pi));
  return built;
}

mbd::ModalBodyData modal_shapes(const Body& body, const std::vector<const DeformingSurface*>& surfaces) {
  std::optional<fem::ElasticBody> mesh;
  return mbd::modal_data(*reduced(body, surfaces, mesh), body.flexible->damping);
}

void add_reduction(const Body& body, const std::vector<const DeformingSurface*>& surfaces, Fingerprint& print) {
  const Flexible& flexible = *body.flexible;
  add_mesh(*flexible.mesh, print);
  for (const fem::SolidMaterial& material : flexible.materials) print.add(material.D), print.add(material.density);
  print.add(static_cast<int>(flexible.nodal));
  print.add(flexible.modes);
  print.add(flexible.highest);
  print.add(flexible.static_error);
  print.add(flexible.load_harmonics);
  for (const std::string& name : flexible.load_surfaces) print.add(name);
  for (const auto& faces : flexible.contact_faces) print.add(faces);
  for (const Frame& frame : body.frames) {
    print.add(frame.name), print.add(frame.X_BF.R), print.add(frame.X_BF.r), print.add(frame.nodes);
    print.add(static_cast<int>(frame.connection));
  }
  for (const DeformingSurface* surface : surfaces) {
    const fem::FilmSurface& film = *surface->surface;
    print.add(film.cylinder.X.R), print.add(film.cylinder.X.r), print.add(film.cylinder.R), print.add(film.cylinder.L);
    print.add(film.functions.around()), print.add(film.functions.along()), print.add(film.faces);
    print.add(static_cast<int>(film.cylinder.is_bore));
    if (const auto& arc = film.cylinder.arc) print.add(arc->from), print.add(arc->over);
    print.add(surface->modes.value_or(-1));
  }
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
  const auto index = at == body.frames.end() ? 0 : at - body.frames.begin();
  const Eigen::MatrixXd D =
      index == 0 ? map.coefficients(U)
                 : fem::coefficients_from_frame(map, *body.flexible->mesh, U, at->X_BF.r, 6 * (index - 1));
  return std::make_shared<const bearing::ElasticSurface>(bearing::ElasticSurface{map.functions, D});
}

}  // namespace hersey::model
