#include "interpret/composites/pad_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "check/members.h"
#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"

namespace hersey::model {

PadInertia sector_of_ring(double r, double t, double arc, double width, double density) {
  const double outer = r + t, half = arc / 2;
  const double area = half * (outer * outer - r * r), fourth = (std::pow(outer, 4) - std::pow(r, 4)) / 4;
  PadInertia pad;
  pad.mass = density * width * area;
  pad.centre = 2.0 / 3 * std::sin(half) * (std::pow(outer, 3) - std::pow(r, 3)) / area;
  // Second moments of area about the axis of the bearing: across and along the line to the middle.
  const double across = fourth * (half - std::sin(arc) / 2), along = fourth * (half + std::sin(arc) / 2);
  const double thin = pad.mass * width * width / 12, mass_per_area = density * width;
  pad.radial = mass_per_area * across + thin;
  pad.tangential = mass_per_area * along - pad.mass * pad.centre * pad.centre + thin;
  pad.axial = mass_per_area * (across + along) - pad.mass * pad.centre * pad.centre;
  return pad;
}

PadInertia with_mass(PadInertia pad, double mass) {
  const double ratio = pad.mass > 0 ? mass / pad.mass : 0;
  for (double* moment : {&pad.radial, &pad.tangential, &pad.axial}) *moment *= ratio;
  pad.mass = mass;
  return pad;
}

void check_pivot(const Value& pivot, std::vector<Fault>& faults) {
  for (const char* outer : {"socket_radius", "cylinder_radius"}) {
    const bool is_ours = (pivot.text == "ball_in_socket" && std::string(outer) == "socket_radius") ||
                         (pivot.text == "sphere_in_cylinder" && std::string(outer) == "cylinder_radius");
    if (!is_ours || number_of(pivot, outer) > number_of(pivot, "ball_radius")) continue;
    const Value& at = *pivot.find(outer);
    faults.push_back({at.position, at.path,
                      fmt::format("{:.6g} mm, not larger than the ball", 1e3 * number_of(pivot, outer)),
                      fmt::format("more than ball_radius, {:.6g} mm", 1e3 * number_of(pivot, "ball_radius")), ""});
  }
}

namespace {

double plane_strain(const Value& material) {
  const double nu = number_of(material, "poisson_ratio");
  return (1 - nu * nu) / number_of(material, "youngs_modulus");
}

/// k of F = k d^1.5 between a ball and what it stands on, theory manual eq. (pads.2). A sphere in a cylinder is
/// taken as a sphere in a socket of the mean curvature.
double hertz_constant(const Value& pivot) {
  const double ball = 1 / number_of(pivot, "ball_radius");
  double curvature = ball;
  if (pivot.text == "ball_in_socket") curvature -= 1 / number_of(pivot, "socket_radius");
  if (pivot.text == "sphere_in_cylinder") curvature -= 0.5 / number_of(pivot, "cylinder_radius");
  const double yield = plane_strain(*pivot.find("pad_material")) + plane_strain(*pivot.find("seat_material"));
  return 4.0 / 3 / yield / std::sqrt(curvature);
}

}  // namespace

std::string pivot_law(const Value& pivot) {
  if (pivot.text == "spring") return fmt::format("stiffness: {} N/m", number_of(pivot, "stiffness"));
  return fmt::format("force: {{expression: \"{}*max(stretch, 0)^1.5\", unit: N}}", hertz_constant(pivot));
}

bool has_warm_films(const Value& bearing) {
  const Value* thermal = bearing.find("thermal");
  return thermal != nullptr && !thermal->broken && thermal->text == "film";
}

namespace {

/// True if the moving surface takes the temperature at which it gives off no heat: one for all pads.
bool is_free(const Value& bearing, const WarmedByPads& moving) {
  return bearing.find("thermal")->find(moving.key)->text == "free";
}

}  // namespace

std::string thermal_of_pads(const Value& bearing, const WarmedByPads& moving, const std::string& name,
                            const std::vector<std::string>& pads, const std::vector<double>& angles) {
  std::string text = "thermal:\n";
  if (is_free(bearing, moving)) {
    const Value &wall = *bearing.find("thermal")->find(moving.key), *start = wall.find("temperature");
    const double given = number_of(wall, "heat_capacity");
    text += fmt::format("  nodes:\n    {}: {{heat_capacity: {} J/K", moving.node, given > 0 ? given : moving.capacity);
    if (start != nullptr) text += fmt::format(", temperature: {} K", start->number);
    text += "}\n";
  }
  std::vector<std::size_t> order(pads.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto angle = [&](std::size_t k) {
    const double at = std::fmod(angles[k], two_pi);
    return at < 0 ? at + two_pi : at;
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return angle(a) < angle(b); });
  text += "  grooves:\n";
  for (std::size_t k = 0; k < order.size(); ++k)
    text += fmt::format("    {}_groove_{}: {{between: [{}, {}]}}\n", name, k + 1, pads[order[k]],
                        pads[order[(k + 1) % order.size()]]);
  return text;
}

void set_moving_wall(const Value& bearing, const WarmedByPads& moving, const SourcePosition& position, Node& tree) {
  if (!is_free(bearing, moving)) return;
  std::vector<Fault> faults;
  std::optional<Node> wall =
      parse_yaml(fmt::format("{}: {{wall: node, node: {}}}", moving.key, moving.node), position.file, faults);
  HERSEY_REQUIRE(wall && faults.empty(), "a wall that is a node");
  move_to(*wall, position);
  for (Entry& film : tree.find("bearings")->entries) {
    Node& thermal = *film.value.find("thermal");
    std::erase_if(thermal.entries, [&](const Entry& entry) { return entry.key == moving.key; });
    thermal.entries.push_back(wall->entries.front());
  }
}

void set_worn_group(const std::string& moving, const std::string& name, Node& film) {
  Node* const wear = film.find("wear");
  Node* const worn = wear != nullptr ? wear->find(moving) : nullptr;
  if (worn == nullptr || worn->kind != Node::Kind::mapping || worn->find("group") != nullptr) return;
  worn->entries.push_back(
      {"group", worn->position, Node{.kind = Node::Kind::scalar, .position = worn->position, .text = name}});
}

Node parts_tree(const std::string& text, const SourcePosition& position) {
  std::vector<Fault> faults;
  std::optional<Node> tree = parse_yaml(text, position.file, faults);
  HERSEY_REQUIRE(tree && faults.empty(), "the parts of a composite are a model's");
  move_to(*tree, position);
  return std::move(*tree);
}

}  // namespace hersey::model
