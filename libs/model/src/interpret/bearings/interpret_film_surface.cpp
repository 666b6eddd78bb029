#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/core/two_pi.h"
#include "hersey/fem/load_distributions.h"
#include "interpret/context/interpret.h"

// Surfaces of bearings that lie on the mesh of a flexible body.
namespace hersey::model {
namespace {

constexpr double near_radius = 0.01;  // by which named faces may lie off the bearing's radius

double millimetres(double length) { return 1e3 * length; }

/// One side of one bearing.
class FilmSurfaceReader {
 public:
  FilmSurfaceReader(Context& context, const Value& value, const FrameName& on, const film::FilmModel& film,
                    bool is_shell)
      : context_(context), value_(value), on_(on), film_(film), is_shell_(is_shell) {}

  std::optional<DeformingSurface> read() {
    const Body* body = flexible_body();
    if (body == nullptr) return std::nullopt;
    const Value *named = value_.find("faces"), *within = value_.find("within");
    if (named == nullptr && within == nullptr) return std::nullopt;  // reported already
    const Value& choice = named != nullptr ? *named : *within;
    if (choice.broken || !has_enough_functions()) return std::nullopt;
    const std::optional<fem::FilmSurface> found =
        surface_of(*body, named, within != nullptr ? within->number : 0, choice);
    if (!found) return std::nullopt;
    refuse_if_supported(*body, *found, choice);
    DeformingSurface surface;
    surface.surface = std::make_shared<const fem::FilmSurface>(*found);
    if (const Value* modes = value_.find("modes")) surface.modes = static_cast<int>(modes->number);
    surface.position = choice.position;
    return surface;
  }

  /// The wall of a heat-conducting body: if no faces are named, those near the cylinder.
  std::shared_ptr<const fem::FilmSurface> read_wall() {
    is_wall_ = true;
    what_ = "a wall that conducts";
    remedy_ = (is_shell_ ? "a `ring`" : "`free`, `given` or a `node`") +
              std::string(", or a flexible body with a `mesh` and `heat`");
    const Body* body = flexible_body();
    if (body == nullptr) return nullptr;
    const Value* named = value_.find("faces");
    const std::optional<fem::FilmSurface> found =
        surface_of(*body, named, near_radius * film_.R, named != nullptr ? *named : value_);
    return found ? std::make_shared<const fem::FilmSurface>(*found) : nullptr;
  }

 private:
  /// The film's faces of a body: those named, or all within a distance [m] of its cylinder. Reported where there are
  /// none.
  std::optional<fem::FilmSurface> surface_of(const Body& body, const Value* named, double within, const Value& at) {
    if (film_.R <= 0 || film_.L <= 0) return std::nullopt;
    const fem::FilmCylinder cylinder{
        .X = pose_in(body), .R = film_.R, .L = film_.L, .is_bore = is_shell_, .arc = arc_of_film()};
    const fem::Mesh& mesh = *body.flexible->mesh;
    if (context_.has_fault_in(value_.path)) return std::nullopt;
    std::vector<fem::ElementFace> faces;
    if (named != nullptr) faces = faces_of(context_, *named, mesh);
    if (named != nullptr && faces.empty()) return std::nullopt;  // reported already
    const double tolerance = named != nullptr ? near_radius * film_.R : within;
    if (named == nullptr) faces = fem::faces_on_cylinder(mesh, cylinder, tolerance);
    const fem::FilmSurfaceResult result =
        fem::film_surface(mesh, faces, cylinder, functions_of(mesh, faces, cylinder), tolerance);
    if (!result.solved()) context_.fault(at, result.message, expected(), result.remedy);
    return result.surface;
  }

  /// The one arc of a pad's film, which its shell has to be; a journal passes all of it as it rotates, and the shell
  /// of several arcs goes all around.
  [[nodiscard]] std::optional<SurfaceArc> arc_of_film() const {
    const film::Arcs* arcs = film::arcs_of(film_);
    if (!is_shell_ || is_wall_ || arcs == nullptr || arcs->arcs.size() != 1) return std::nullopt;
    const film::Arc& arc = arcs->arcs.front();
    if (arc.to - arc.from >= two_pi) return std::nullopt;
    return SurfaceArc{arc.from, arc.to - arc.from};
  }

  [[nodiscard]] std::string side() const { return is_shell_ ? "shell" : "journal"; }

  [[nodiscard]] std::string expected() const {
    return fmt::format("faces of the mesh that are a {} of {:.4g} mm radius, {:.4g} mm wide, about the z-axis of {}",
                       is_shell_ ? "bore" : "shaft", millimetres(film_.R), millimetres(film_.L), on_name());
  }

  [[nodiscard]] std::string on_name() const { return on_.frame.empty() ? on_.body : on_.body + "." + on_.frame; }

  /// The body of this side where it has a mesh; null where there is none, reported.
  const Body* flexible_body() {
    if (on_.body.empty()) {
      context_.fault_at_key(value_, what_ + " of a bearing without bodies", "`" + side() + ": BODY.FRAME`",
                            "a bearing by itself has rigid surfaces, or columns: 'compliance'");
      return nullptr;
    }
    if (context_.has_fault_in("bodies." + on_.body)) return nullptr;
    const auto& bodies = context_.model.bodies;
    const auto body =
        std::find_if(bodies.begin(), bodies.end(), [&](const Body& candidate) { return candidate.name == on_.body; });
    if (body == bodies.end() && on_.body != "ground") return nullptr;  // reported already
    if (body == bodies.end() || !body->flexible) {
      const bool is_beam = body != bodies.end() && body->beam;
      context_.fault_at_key(
          value_, what_ + " on " + std::string(is_beam ? "the beam '" : "rigid body '") + on_.body + "'", remedy_,
          "give 'flexible: {mesh: ...}' to the body, or " +
              (is_wall_ ? "another wall to the " + side() : "leave '" + side() + "_surface' out"));
      return nullptr;
    }
    if (body->flexible->reduced) {
      context_.fault_at_key(
          value_, what_ + " on the reduced body '" + on_.body + "', whose file holds no answers to film pressure",
          remedy_, "give the body its 'mesh' instead of 'reduced'");
      return nullptr;
    }
    if (body->flexible->strain == mbd::Strain::finite) {
      context_.fault_at_key(value_, what_ + " on '" + on_.body + "', a body of finite strain",
                            "`rigid`, or a body of `strain: small`",
                            "surfaces move by static shapes, which a large bend is not; give the bearing a rigid frame "
                            "of its own on the body");
      return nullptr;
    }
    return body->flexible->mesh ? &*body : nullptr;
  }

  /// The bearing's frame in the mesh's axes.
  [[nodiscard]] Pose pose_in(const Body& body) const {
    for (const Frame& frame : body.frames)
      if (frame.name == on_.frame) return frame.X_BF;
    return {};
  }

  [[nodiscard]] SurfaceFunctions functions_of(const fem::Mesh& mesh, const std::vector<fem::ElementFace>& faces,
                                              const fem::FilmCylinder& cylinder) const {
    const Value* given = is_wall_ ? nullptr : value_.find("functions");
    if (given != nullptr && given->members.size() == 2)
      return {static_cast<int>(given->members[0].value.number), static_cast<int>(given->members[1].value.number),
              cylinder.L, cylinder.arc};
    if (faces.empty()) return {4, 1, cylinder.L, cylinder.arc};
    return fem::functions_for(mesh, faces, cylinder);
  }

  /// A periodic cubic spline has four functions or more.
  bool has_enough_functions() {
    const Value* given = value_.find("functions");
    if (given == nullptr || given->members.size() != 2 || given->members[0].value.number >= 4) return true;
    context_.fault(given->members[0].value, "fewer than 4 functions around", "at least 4, such as [24, 5]");
    return false;
  }

  /// Nodes that a rigid frame carries do not move against it: no pressure would deform the surface.
  void refuse_if_supported(const Body& body, const fem::FilmSurface& surface, const Value& at) {
    const fem::Mesh& mesh = *body.flexible->mesh;
    std::vector<const Frame*> holder(mesh.nodes.size(), nullptr);
    for (const Frame& frame : body.frames)
      if (frame.connection == fem::Connection::rigid)
        for (const int node : frame.nodes) holder[static_cast<std::size_t>(node)] = &frame;
    const std::vector<int> nodes = fem::nodes_on(mesh, surface.faces);
    const Frame* frame = holder[static_cast<std::size_t>(nodes.front())];
    if (!std::all_of(nodes.begin(), nodes.end(), [&](int n) { return holder[static_cast<std::size_t>(n)] != nullptr; }))
      return;
    context_.fault(at, "a surface whose nodes all belong to the rigid frame '" + frame->name + "'",
                   "nodes that can move", "give the frame 'connection: average'");
  }

  Context& context_;
  const Value& value_;
  const FrameName& on_;
  const film::FilmModel& film_;
  bool is_shell_;
  bool is_wall_ = false;  ///< asked for its heat, not for how it deforms
  std::string what_ = "a deforming surface", remedy_ = "`rigid`, or a flexible body with a `mesh`";
};

/// Mean radius of the nodes of a surface.
double mean_radius(const fem::Mesh& mesh, const fem::FilmSurface& surface) {
  const Pose to_cylinder = surface.cylinder.X.inverse();
  const std::vector<int> nodes = fem::nodes_on(mesh, surface.faces);
  double sum = 0;
  for (const int node : nodes) sum += (to_cylinder * mesh.nodes[static_cast<std::size_t>(node)]).head<2>().norm();
  return sum / static_cast<double>(nodes.size());
}

const fem::Mesh& mesh_of(const Context& context, const std::string& body) {
  const auto& bodies = context.model.bodies;
  return *std::find_if(bodies.begin(), bodies.end(), [&](const Body& candidate) {
            return candidate.name == body;
          })->flexible->mesh;
}

}  // namespace

std::optional<DeformingSurface> deforming_surface_of(Context& context, const Value& bearing, const std::string& side,
                                                     const FrameName& on, const film::FilmModel& film) {
  const Value* value = bearing.find(side + "_surface");
  if (value == nullptr || value->broken || value->members.empty()) return std::nullopt;
  const Value& choice = value->members.front().value;
  if (choice.broken || choice.text == "rigid") return std::nullopt;
  return FilmSurfaceReader(context, choice, on, film, side == "shell").read();
}

namespace {

/// Faults of a wall in a body that does not conduct, or whose film lies on what `cooling` names.
bool conducts(Context& context, const Value& wall, const Body& body, const fem::FilmSurface& surface) {
  if (!body.flexible->heat) {
    context.fault_at_key(wall, "a wall in body '" + body.name + "', which does not say how it conducts heat",
                         "`heat` of `bodies." + body.name + ".flexible`",
                         "add `heat: {conductivity: 46 W/m/K, cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: "
                         "40 degC}}}` there");
    return false;
  }
  const auto is_same = [](fem::ElementFace a, fem::ElementFace b) {
    return a.element == b.element && a.face == b.face;
  };
  const BodyHeat& of_body = *body.flexible->heat;
  for (std::size_t s = 0; s < of_body.surroundings.cooled.size(); ++s)
    for (const fem::ElementFace face :
         s == of_body.rest ? std::vector<fem::ElementFace>() : of_body.surroundings.cooled[s].faces)
      if (std::any_of(surface.faces.begin(), surface.faces.end(), [&](auto film) { return is_same(face, film); })) {
        context.fault_at_key(wall, "a film on faces of '" + body.name + "' that `cooling` names too",
                             "surfaces of `cooling` that no film lies on");
        return false;
      }
  return true;
}

/// Of the wall of a bearing's shell or journal that is a body.
std::shared_ptr<const fem::FilmSurface> heated_surface_of(Context& context, const Value& value, const Bearing& bearing,
                                                          bool is_shell) {
  const Value& wall = *value.find("thermal")->find(is_shell ? "shell" : "journal");
  const FrameName& on = is_shell ? bearing.shell : bearing.journal;
  const std::optional<DeformingSurface>& deforming = is_shell ? bearing.shell_surface : bearing.journal_surface;
  std::shared_ptr<const fem::FilmSurface> surface;
  if (deforming && deforming->surface->cylinder.arc) {
    context.fault_at_key(wall, "a wall in a body under a film on one arc", "a bore all around, or `wall: pad`");
    return nullptr;
  }
  if (deforming && wall.find("faces") == nullptr)
    surface = deforming->surface;
  else
    surface = FilmSurfaceReader(context, wall, on, bearing.film, is_shell).read_wall();
  if (!surface) return nullptr;
  const Body& body = *std::find_if(context.model.bodies.begin(), context.model.bodies.end(),
                                   [&](const Body& candidate) { return candidate.name == on.body; });
  return conducts(context, wall, body, *surface) ? surface : nullptr;
}

}  // namespace

std::shared_ptr<const fem::FilmSurface> heated_shell_of(Context& context, const Value& value, const Bearing& bearing) {
  const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
  if (heat == nullptr || !std::holds_alternative<film::BodyWall>(heat->shell)) return nullptr;
  return heated_surface_of(context, value, bearing, true);
}

std::shared_ptr<const fem::FilmSurface> heated_journal_of(Context& context, const Value& value,
                                                          const Bearing& bearing) {
  const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
  if (heat == nullptr || !std::holds_alternative<film::BodyJournal>(heat->journal)) return nullptr;
  return heated_surface_of(context, value, bearing, false);
}

void require_facing_surfaces(Context& context, const Value& value, const Bearing& bearing) {
  if (!bearing.shell_surface || !bearing.journal_surface) return;
  const double shell = mean_radius(mesh_of(context, bearing.shell.body), *bearing.shell_surface->surface);
  const double journal = mean_radius(mesh_of(context, bearing.journal.body), *bearing.journal_surface->surface);
  if (std::abs(shell - journal - bearing.film.c) <= near_radius * bearing.film.R) return;
  context.fault_at_key(*value.find("journal_surface"),
                       fmt::format("surfaces that do not face each other: the shell's nodes have a mean radius of "
                                   "{:.5g} mm, the journal's one of {:.5g} mm, with a clearance of {:.3g} mm",
                                   millimetres(shell), millimetres(journal), millimetres(bearing.film.c)),
                       "meshes of a bore and of the shaft in it", "choose the right faces, or make 'within' smaller");
}

}  // namespace hersey::model
