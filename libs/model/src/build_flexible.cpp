#include "build_flexible.h"

#include <limits>
#include <numbers>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/mbd/nodal_body.h"

namespace hersey::model {
namespace {

fem::ElasticBody assembled(const Body& body) {
  const Flexible& flexible = *body.flexible;
  std::vector<fem::SolidMaterial> materials;
  for (const fem::ElasticMaterial& material : flexible.materials) materials.push_back(fem::isotropic(material));
  try {
    return fem::assemble(*flexible.mesh, std::move(materials));
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) {
      fault.position = flexible.position;
      fault.path = "bodies." + body.name + ".flexible.mesh";
    }
    throw InputError(std::move(faults));
  }
}

}  // namespace

BuiltFlexible build_flexible(const Body& body) {
  HERSEY_REQUIRE(body.flexible && body.flexible->mesh, "the reader checks meshes");
  const Flexible& flexible = *body.flexible;
  std::vector<fem::InterfaceFrame> frames;
  frames.reserve(body.frames.size());
  for (const Frame& frame : body.frames) {
    const bool is_average = frame.connection == fem::Connection::average;
    frames.push_back({frame.name, frame.X_BF.r, frame.nodes, frame.connection,
                      is_average ? fem::face_weights(*flexible.mesh, frame.nodes) : std::vector<double>()});
  }
  fem::ReductionOptions options;
  options.modes = flexible.modes;
  if (flexible.highest > 0) options.highest = 2 * std::numbers::pi * flexible.highest;
  fem::ElasticBody mesh = assembled(body);
  const fem::Reduction reduction = fem::reduce(mesh, frames, options);
  if (!reduction.ok)
    throw InputError({.position = flexible.position,
                      .path = "bodies." + body.name + ".flexible",
                      .found = reduction.message,
                      .expected = "a mesh that can be held at its frames",
                      .suggestion = "see `hersey mesh` for its sets and its quality"});
  BuiltFlexible built;
  built.name = body.name;
  built.mesh = flexible.mesh;
  mbd::ModalBodyData data = mbd::modal_data(reduction.body, flexible.damping, &built.shapes);
  if (flexible.nodal)
    built.body = std::make_shared<mbd::NodalBody>(std::move(mesh), reduction.body, flexible.damping);
  else
    built.body = std::make_shared<mbd::ModalBody>(std::move(data));
  for (const double omega : reduction.body.internal_omega) built.frequencies.push_back(omega / (2 * std::numbers::pi));
  return built;
}

}  // namespace hersey::model
