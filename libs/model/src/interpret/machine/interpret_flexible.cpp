#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "hersey/core/spelling.h"
#include "hersey/core/two_pi.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/reduced_body_file.h"
#include "hersey/fem/reduction.h"
#include "hersey/fem/sector_mesh.h"
#include "hersey/fem/skin.h"
#include "interpret/context/interpret.h"
#include "schema/machine_vocabulary.h"

namespace hersey::model {
namespace {

class FlexibleReader {
 public:
  FlexibleReader(Context& context, const Value& body) : context_(context), body_(body) {}

  Flexible read(const Value& value, std::vector<Frame>& frames) {
    Flexible flexible;
    flexible.position = value.key_position;
    flexible.nodal = meaning_of(value, "form", form_words);
    flexible.parts = meaning_of(value, "parts", parts_words);
    flexible.strain = meaning_of(value, "strain", strain_words);
    refuse_finite_strain(value, flexible);
    flexible.modes = integer_of(value, "modes");
    flexible.highest = number_of(value, "highest_frequency");
    if (const Value* damping = value.find("damping"))
      flexible.damping = {number_of(*damping, "mass"), number_of(*damping, "stiffness")};
    flexible.vtu_every = number_of(value, "vtu_every");
    refuse_rigid_keys();
    if (value.find("reduced") != nullptr) {
      read_reduced(value, flexible, frames);
      return flexible;
    }
    auto mesh = value.find("sector") != nullptr ? sector_of(value) : mesh_of(value, flexible.parts);
    if (!mesh) return flexible;
    refuse_ties(value, *mesh, flexible);
    flexible.materials = materials_of(value, *mesh);
    locate_frames(*mesh, frames);
    refuse_averages(flexible, frames);
    read_load_surfaces(value, *mesh, flexible);
    if (const Value* heat = value.find("heat")) flexible.heat = body_heat_of(context_, *heat, *mesh);
    flexible.mesh = std::make_shared<const fem::Mesh>(std::move(*mesh));
    return flexible;
  }

 private:
  void refuse_finite_strain(const Value& value, const Flexible& flexible) {
    if (flexible.strain == mbd::Strain::finite && !flexible.nodal)
      context_.fault(*value.find("strain"), "finite strain of a modal body", "`form: nodal`",
                     "shapes that add up linearly strain linearly");
  }

  void refuse_ties(const Value& value, const fem::Mesh& mesh, const Flexible& flexible) {
    if (!mesh.ties.empty() && flexible.nodal)
      context_.fault(*value.find("form"), "`form: nodal` of a mesh with ties between its nodes", "`form: modal`",
                     "the shapes of a modal body obey ties; nodes that all move do not yet");
  }

  void refuse_averages(const Flexible& flexible, const std::vector<Frame>& frames) {
    if (flexible.strain == mbd::Strain::small) return;
    for (std::size_t i = 1; i < frames.size(); ++i)
      if (frames[i].connection == fem::Connection::average)
        context_.fault(*body_.find("frames")->find(frames[i].name)->find("connection"),
                       "`connection: average` of frame '" + frames[i].name + "' of a body of finite strain",
                       "`connection: rigid` of every frame but the first",
                       "averages measure turns that are small against the first frame");
  }

  void refuse_rigid_keys() {
    for (const char* key : {"inertia", "centre_of_mass"})
      if (const Value* given = body_.find(key); given != nullptr && given->given)
        context_.fault_at_key(*given, std::string("`") + key + "` of a flexible body",
                              "what the mesh and its density give", "remove the key");
  }

  void read_load_surfaces(const Value& value, const fem::Mesh& mesh, Flexible& flexible) {
    flexible.static_error = number_of(value, "static_error");
    flexible.load_harmonics = integer_of(value, "load_harmonics");
    for (const auto& [index, name] : section(value, "load_surfaces")) {
      if (name.broken || faces_of(context_, name, mesh).empty()) continue;
      flexible.load_surfaces.push_back(name.text);
    }
  }

  /// A file of `hersey reduce`: its frames are the body's, in its order.
  void read_reduced(const Value& value, Flexible& flexible, std::vector<Frame>& frames) {
    for (const char* key : {"length_unit", "part", "parts", "material", "heat", "modes", "highest_frequency",
                            "load_surfaces", "static_error", "load_harmonics"})
      if (const Value* given = value.find(key); given != nullptr && given->given)
        context_.fault_at_key(*given, std::string("`") + key + "` of a reduced body", "what the file was made with",
                              "remove the key, or make the file anew");
    if (flexible.nodal)
      context_.fault_at_key(*value.find("form"), "`form: nodal` of a reduced body", "`form: modal`, or a `mesh`");
    const Value& file = *value.find("reduced");
    if (file.broken) return;
    try {
      auto body =
          std::make_shared<const fem::ReducedBody>(fem::read_reduced_body(referenced_file(context_, file.text)));
      if (body->frames.empty())
        context_.fault(file, "a reduced body without frames", "at least one, which joints and forces attach to");
      name_frames(*body, file, frames);
      if (const Value* every = value.find("vtu_every"); every != nullptr && body->mesh.elements.empty())
        context_.fault_at_key(*every, "`vtu_every` of a reduced body without elements", "a file that has them",
                              "`hersey reduce` writes them");
      flexible.mesh = {body, &body->mesh};
      flexible.reduced = std::move(body);
    } catch (const InputError& error) {
      context_.faults_in_file(file, error.faults());
    }
  }

  void name_frames(const fem::ReducedBody& body, const Value& file, std::vector<Frame>& frames) {
    std::vector<std::string> names;
    for (const fem::InterfaceFrame& frame : body.frames) names.push_back(frame.name);
    for (const Frame& frame : frames) {
      const Value& value = *body_.find("frames")->find(frame.name);
      if (std::find(names.begin(), names.end(), frame.name) == names.end())
        context_.fault_at_key(value, "frame '" + frame.name + "', which the reduced body has not",
                              "a frame of " + file.text + ": " + one_of(names), did_you_mean(frame.name, names));
      for (const char* key : {"origin", "nodes", "connection"})
        if (const Value* given = value.find(key); given != nullptr && given->given)
          context_.fault_at_key(*given, std::string("`") + key + "` of a frame of a reduced body", "what the file says",
                                "only `rotation` may be given");
    }
    std::vector<Frame> ordered;
    for (const fem::InterfaceFrame& in_file : body.frames) {
      Frame frame;
      for (const Frame& given : frames)
        if (given.name == in_file.name) frame = given;
      frame.name = in_file.name;
      frame.X_BF.r = in_file.origin;
      frame.nodes = in_file.nodes;
      frame.connection = in_file.connection;
      ordered.push_back(std::move(frame));
    }
    frames = std::move(ordered);
  }

  std::optional<fem::Mesh> mesh_of(const Value& value, fem::Parts parts) {
    const Value *file = value.find("mesh"), *unit = value.find("length_unit");
    if (unit == nullptr && file != nullptr)
      context_.fault_at_key(value, "a mesh without `length_unit`", "what a length of 1 in it means",
                            "add `length_unit: 1 mm`");
    if (file == nullptr || file->broken || unit == nullptr || unit->broken) return std::nullopt;
    const auto path = referenced_file(context_, file->text);
    try {
      std::vector<Fault> warnings;
      fem::Mesh mesh = fem::read_mesh(path, unit->number, &warnings, &material_faults_, part_of(value));
      check_elements(mesh, *file);
      const fem::MeshQuality quality = fem::quality_of(mesh);
      context_.faults_in_file(*file, fem::faults_of(quality, path.string(), parts));
      context_.warnings_in_file(*file, warnings);
      context_.warnings_in_file(*file, fem::warnings_of(quality, path.string(), parts));
      return mesh;
    } catch (const InputError& error) {
      context_.faults_in_file(*file, error.faults());
      return std::nullopt;
    }
  }

  /// A sector of a ring, meshed here.
  std::optional<fem::Mesh> sector_of(const Value& value) {
    for (const char* key : {"length_unit", "part", "parts"})
      if (const Value* given = value.find(key); given != nullptr && given->given)
        context_.fault_at_key(*given, std::string("`") + key + "` of a sector", "what `sector` says",
                              "remove the key: only files of meshes have it");
    if (value.find("material") == nullptr)
      context_.fault_at_key(value, "a sector without `material`", "an elastic material",
                            "add `material: {youngs_modulus: ..., poisson_ratio: ..., density: ...}`");
    const Value& sector = *value.find("sector");
    if (sector.broken || value.find("material") == nullptr || context_.has_fault_in(sector.path)) return std::nullopt;
    const double middle = number_of(sector, "middle"), half = 0.5 * number_of(sector, "arc");
    fem::RingSector ring{.inner = number_of(sector, "inner_radius"),
                         .outer = number_of(sector, "inner_radius") + number_of(sector, "thickness"),
                         .width = number_of(sector, "width"),
                         .from = middle - half,
                         .to = middle + half};
    const std::vector<Member>& elements = sector.find("elements")->members;
    for (std::size_t k = 0; k < ring.elements.size(); ++k)
      ring.elements[k] = static_cast<int>(elements[k].value.number);
    if (const Value* seat = sector.find("seat")) {
      ring.seat = seat_of(*seat, ring);
      if (!ring.seat) return std::nullopt;
    }
    return fem::sector_mesh(ring);
  }

  /// Reported where it lies outside the sector.
  std::optional<fem::SectorSeat> seat_of(const Value& value, const fem::RingSector& ring) {
    const double half = 0.5 * number_of(value, "arc"),
                 turns = std::round((0.5 * (ring.from + ring.to) - number_of(value, "angle")) / two_pi),
                 angle = number_of(value, "angle") + two_pi * turns;
    fem::SectorSeat seat{angle - half, angle + half, ring.width};
    if (const Value* width = value.find("width")) seat.width = width->number;
    if (seat.from >= ring.from && seat.to <= ring.to && seat.width <= ring.width) return seat;
    context_.fault_at_key(value, "a seat that reaches beyond its sector", "one on the sector's outer face");
    return std::nullopt;
  }

  static std::string part_of(const Value& value) {
    const Value* const part = value.find("part");
    return part == nullptr || part->broken ? "" : part->text;
  }

  void check_elements(const fem::Mesh& mesh, const Value& file) {
    const auto is_beam = [](const fem::Element& e) { return e.type == fem::ElementType::beam2; };
    if (std::any_of(mesh.elements.begin(), mesh.elements.end(), is_beam))
      context_.fault(file, "a mesh with beams", "solid elements alone: tetrahedra, wedges, hexahedra");
    if (mesh.elements.empty()) context_.fault(file, "a mesh without solid elements", "tetrahedra, wedges or hexahedra");
  }

  /// The one material that the model file gives; none where it is broken.
  std::vector<fem::SolidMaterial> material_of(const Value& given) {
    const double E = number_of(given, "youngs_modulus"), nu = number_of(given, "poisson_ratio"),
                 density = number_of(given, "density");
    const Value* nine = given.find("orthotropic");
    if (nine == nullptr) {
      if (!(E > 0 && nu > -1 && nu < 0.5)) return {};  // reported already
      return {fem::isotropic({E, nu, density})};
    }
    const Value* ratios = nine->find("poisson_ratios");
    if (nine->broken || ratios == nullptr || ratios->broken || ratios->members.size() != 3) return {};
    const Vector3 moduli = vector_of(*nine, "youngs_moduli"), shear = vector_of(*nine, "shear_moduli");
    fem::OrthotropicMaterial material{.E_1 = moduli[0],
                                      .E_2 = moduli[1],
                                      .E_3 = moduli[2],
                                      .nu_12 = ratios->members[0].value.number,
                                      .nu_23 = ratios->members[1].value.number,
                                      .nu_13 = ratios->members[2].value.number,
                                      .G_12 = shear[0],
                                      .G_23 = shear[1],
                                      .G_13 = shear[2],
                                      .density = density};
    if (const Value* axes = nine->find("axes"); axes != nullptr && !axes->broken)
      material.R =
          Eigen::AngleAxisd(number_of(*axes, "angle"), direction_of(context_, *axes, "axis")).toRotationMatrix();
    if (fem::is_stable(material)) return {fem::orthotropic(material)};
    context_.fault_at_key(*nine, "constants of no material: some strain would store no energy",
                          "moduli > 0 and Poisson's ratios small enough, nu_12^2 < E_1/E_2 and the like",
                          "nu_12 = contraction along 2 under tension along 1; nu_21 = nu_12 E_2/E_1");
    return {};
  }

  std::vector<fem::SolidMaterial> materials_of(const Value& value, fem::Mesh& mesh) {
    if (const Value* given = value.find("material")) {
      for (fem::Element& element : mesh.elements) element.material = 0;
      return material_of(*given);
    }
    std::vector<fem::SolidMaterial> materials;
    const Value& at = *value.find("mesh");
    if (!material_faults_.empty()) {
      context_.faults_in_file(at, material_faults_);
      return materials;
    }
    std::set<int> used;
    for (const fem::Element& element : mesh.elements) used.insert(element.material);
    if (mesh.materials.empty()) {
      context_.fault_at_key(value, "a mesh without materials", "a `material`, or a mesh file whose elements have one",
                            "add `material: {youngs_modulus: ..., poisson_ratio: ..., density: ...}`");
      return materials;
    }
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
      const fem::MeshMaterial& m = mesh.materials[i];
      const bool complete = m.youngs_modulus && m.poisson_ratio && m.density;
      if (!complete && used.count(static_cast<int>(i)) > 0)
        context_.fault(at, "material '" + m.name + "' of the mesh file without " + missing_of(m),
                       "Young's modulus, Poisson's ratio and density", "complete it there, or give `material` here");
      const double nu = m.poisson_ratio.value_or(0);
      if (m.youngs_modulus.value_or(1) > 0 && nu > -1 && nu < 0.5)
        materials.push_back(fem::isotropic({m.youngs_modulus.value_or(1), nu, m.density.value_or(1)}));
      else
        context_.fault(at, "material '" + m.name + "' of the mesh file, which no solid has",
                       "a modulus > 0 and a Poisson's ratio between -1 and 0.5");
    }
    return materials;
  }

  static std::string missing_of(const fem::MeshMaterial& m) {
    if (!m.youngs_modulus) return "Young's modulus";
    return m.poisson_ratio ? "density" : "Poisson's ratio";
  }

  void locate_frames(const fem::Mesh& mesh, std::vector<Frame>& frames) {
    if (frames.empty())
      context_.fault_at_key(body_, "a flexible body without frames", "at least one frame on a set of its nodes",
                            "add `frames: {name: {nodes: set}}`");
    for (Frame& frame : frames) {
      const Value& value = *body_.find("frames")->find(frame.name);
      const Value* nodes = value.find("nodes");
      if (nodes == nullptr) {
        context_.fault_at_key(value, "a frame of a flexible body without `nodes`", "the set of nodes it is attached to",
                              expected_set(mesh));
        continue;
      }
      if (nodes->broken) continue;
      const auto set = mesh.node_sets.find(nodes->text);
      if (set == mesh.node_sets.end() || set->second.empty()) {
        std::vector<std::string> names;
        for (const auto& [name, members] : mesh.node_sets) names.push_back(name);
        context_.fault(*nodes,
                       (set == mesh.node_sets.end() ? "unknown node set '" : "empty node set '") + nodes->text + "'",
                       expected_set(mesh), did_you_mean(nodes->text, names));
        continue;
      }
      frame.nodes = set->second;
      claim(mesh, frame, *nodes);
      frame.connection = meaning_of(value, "connection", connection_words);
      if (value.find("origin") == nullptr) frame.X_BF.r = fem::face_centre(mesh, frame.nodes);
    }
  }

  /// Reports nodes to which another frame is attached already.
  void claim(const fem::Mesh& mesh, const Frame& frame, const Value& at) {
    for (int n : frame.nodes) {
      const auto [owner, is_new] = owners_.try_emplace(n, frame.name);
      if (is_new) continue;
      context_.fault(at,
                     "node " + std::to_string(mesh.node_labels[static_cast<std::size_t>(n)]) + ", on which frame '" +
                         owner->second + "' stands too",
                     "sets of nodes that do not overlap");
      return;
    }
  }

  static std::string expected_set(const fem::Mesh& mesh) {
    if (mesh.node_sets.empty()) return "a mesh file with named sets; this one has none";
    std::vector<std::string> names;
    for (const auto& [name, members] : mesh.node_sets) names.push_back(name);
    return "a set of the mesh: " + one_of(names);
  }

  Context& context_;
  const Value& body_;
  std::vector<Fault> material_faults_;  ///< of the mesh file
  std::map<int, std::string> owners_;   ///< frames by their nodes
};

/// Nodes belong to a mesh, which a rigid body does not have.
void refuse_nodes(Context& context, const Value& body) {
  for (const auto& [name, value] : section(body, "frames"))
    for (const char* key : {"nodes", "connection"})
      if (const Value* given = value.find(key); given != nullptr)
        context.fault_at_key(*given, std::string("`") + key + "` of a frame on a rigid body", "an `origin`",
                             "only flexible bodies have nodes");
}

}  // namespace

std::optional<Flexible> flexible_of(Context& context, const Value& body, std::vector<Frame>& frames) {
  if (!body.has("flexible")) {  // as ground never does
    refuse_nodes(context, body);
    return std::nullopt;
  }
  const Value* value = body.find("flexible");
  if (value->broken) return std::nullopt;
  return FlexibleReader(context, body).read(*value, frames);
}

}  // namespace hersey::model
