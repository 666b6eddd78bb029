// Keywords as in the CalculiX 2.20 manual, chapter 7, and the Abaqus 2016 keywords reference guide.
#include "mesh/abaqus_block.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "mesh/mesh_text.h"

namespace hersey::fem {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr long kMostTerms = 100000;  // of one equation

long integer_of(const RawMesh& raw, FileLocation location, std::string_view text) {
  long value = 0;
  if (!parse_integer(text, value)) raw.fail(location, fmt::format("'{}'", text.substr(0, 40)), "a whole number");
  return value;
}

double number_of(const RawMesh& raw, FileLocation location, std::string_view text) {
  double value = 0;
  if (!text.empty() && !parse_number(text, value))
    raw.fail(location, fmt::format("'{}'", text.substr(0, 40)), "a number");
  return value;
}

/// "4", then four times "node, component, coefficient", over as many lines as it takes.
void add_equations(RawMesh& raw, const AbaqusBlock& block, const Spelling& spelled) {
  RawEquation equation;
  long left = 0;
  const auto take = [&](const AbaqusBlock::Line& line, std::size_t k) {
    RawEquation::Term term;
    if (!parse_label(line.parts[k], term.node)) term.set = spelled(line.parts[k]);
    term.component = static_cast<int>(integer_of(raw, line.location, line.parts[k + 1])) - 1;
    if (term.component < 0 || term.component > 5)
      raw.fail(line.location, fmt::format("degree of freedom {} in *EQUATION", line.parts[k + 1]),
               "1 to 3 along the axes, 4 to 6 about them");
    term.coefficient = number_of(raw, line.location, line.parts[k + 2]);
    equation.terms.push_back(std::move(term));
  };
  for (const AbaqusBlock::Line& line : block.lines) {
    if (left == 0) {
      left = integer_of(raw, line.location, line.parts[0]);
      if (left < 1 || left > kMostTerms || line.parts.size() > 1)
        raw.fail(line.location, fmt::format("'{}' as the number of terms of an equation", line.parts[0]),
                 "a line with how many terms there are, then the terms");
      equation = {line.location, {}};
      continue;
    }
    if (line.parts.size() % 3 != 0 || static_cast<long>(line.parts.size() / 3) > left)
      raw.fail(line.location, fmt::format("{} entries, and {} terms are left", line.parts.size(), left),
               "node, degree of freedom, coefficient of each term");
    for (std::size_t k = 0; k < line.parts.size(); k += 3) take(line, k);
    left -= static_cast<long>(line.parts.size() / 3);
    if (left == 0) raw.equations.push_back(std::exchange(equation, {}));
  }
  if (left > 0)
    raw.fail(block.location, fmt::format("an equation that lacks {} terms", left), "as many terms as it says");
}

void add_surface_ties(RawMesh& raw, const AbaqusBlock& block, const Spelling& spelled) {
  RawSurfaceTie tie;
  if (const std::string tolerance = block.value("POSITIONTOLERANCE"); !tolerance.empty()) {
    tie.tolerance = number_of(raw, block.location, tolerance);
    if (!(*tie.tolerance >= 0))
      raw.fail(block.location, fmt::format("POSITION TOLERANCE = {}", tolerance), "a distance >= 0");
  }
  tie.adjusts = !equal_ignoring_case(block.value("ADJUST"), "NO");
  for (const AbaqusBlock::Line& line : block.lines) {
    if (line.parts.size() < 2)
      raw.fail(line.location, fmt::format("'{}' in *TIE", line.parts[0]), "the slave's surface, the master's surface");
    tie.location = line.location;
    tie.slave = spelled(line.parts[0]);
    tie.master = spelled(line.parts[1]);
    raw.surface_ties.push_back(tie);
  }
}

void add_rigid_body(RawMesh& raw, const AbaqusBlock& block, const Spelling& spelled) {
  RawRigidBody body;
  body.location = block.location;
  for (const char* parameter : {"NSET", "TIENSET", "PINNSET"})
    if (const std::string name = block.value(parameter); !name.empty()) {
      if (!body.node_set.empty())
        raw.fail(block.location, fmt::format("*RIGID BODY with {} beside '{}'", parameter, body.node_set),
                 "one set of nodes: NSET, TIE NSET or PIN NSET");
      body.node_set = spelled(name);
    }
  if (const std::string name = block.value("ELSET"); !name.empty()) body.element_set = spelled(name);
  if (!block.value("ANALYTICALSURFACE").empty() && body.node_set.empty() && body.element_set.empty())
    return raw.warn(block.location, "*RIGID BODY of an analytical surface", "rigid bodies of nodes", "it is ignored");
  if (body.node_set.empty() && body.element_set.empty())
    raw.fail(block.location, "*RIGID BODY without a set", "NSET=name or ELSET=name");
  if (const std::string node = block.value("REFNODE"); !node.empty()) {
    long label = 0;
    if (!parse_label(node, label)) raw.fail(block.location, fmt::format("REF NODE = {}", node), "the number of a node");
    body.reference = label;
  }
  raw.rigid_bodies.push_back(std::move(body));
}

/// TIE and PIN: the first node of a line moves as the second does; BEAM: as on a rigid body.
void add_multi_point(RawMesh& raw, const AbaqusBlock& block) {
  for (const AbaqusBlock::Line& line : block.lines) {
    const std::string type = upper(line.parts[0]);
    std::vector<long> nodes;
    for (std::size_t k = 1; k < line.parts.size(); ++k) {
      long label = 0;
      if (!parse_label(line.parts[k], label)) break;
      nodes.push_back(label);
    }
    const bool is_whole = nodes.size() == 2 && line.parts.size() == 3;
    if ((type != "TIE" && type != "PIN") || !is_whole) {
      raw.warn(line.location, fmt::format("*MPC {} of {} nodes", type.substr(0, 20), line.parts.size() - 1),
               "TIE or PIN of two nodes, *EQUATION, *TIE or *RIGID BODY", "it is ignored: these nodes are not tied");
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
      raw.equations.push_back({line.location, {{nodes[0], "", axis, 1}, {nodes[1], "", axis, -1}}});
  }
}

}  // namespace

bool ties_nodes(std::string_view keyword) {
  return keyword == "EQUATION" || keyword == "TIE" || keyword == "RIGIDBODY" || keyword == "MPC";
}

void add_abaqus_ties(RawMesh& raw, const AbaqusBlock& block, const Spelling& spelled) {
  if (block.name == "EQUATION") return add_equations(raw, block, spelled);
  if (block.name == "TIE") return add_surface_ties(raw, block, spelled);
  if (block.name == "RIGIDBODY") return add_rigid_body(raw, block, spelled);
  add_multi_point(raw, block);
}

void AbaqusSystem::set(const RawMesh& raw, const AbaqusBlock& block) {
  std::vector<double> numbers;
  for (const AbaqusBlock::Line& line : block.lines)
    for (const std::string& part : line.parts) numbers.push_back(number_of(raw, line.location, part));
  if (numbers.size() > 9) raw.fail(block.location, "*SYSTEM with more than nine numbers", "three points");
  origin_.setZero();
  axes_.setIdentity();
  numbers.resize(numbers.size() <= 3 ? 3 : 9);
  origin_ = {numbers[0], numbers[1], numbers[2]};
  if (numbers.size() == 3) return;
  const Vector3 to_x = Vector3(numbers[3], numbers[4], numbers[5]) - origin_;
  Vector3 to_y = Vector3(numbers[6], numbers[7], numbers[8]) - origin_;
  // Without a third point the z-axis stays as upright as it can.
  if (block.lines.size() < 2) to_y = Vector3::UnitZ().cross(to_x);
  const Vector3 normal = to_x.cross(to_y);
  constexpr double on_a_line = 1e-10;  // sine of the angle between them
  if (!(normal.norm() > on_a_line * to_x.norm() * to_y.norm()))
    raw.fail(block.location, "*SYSTEM with its three points on one line",
             "an origin, a point on the x-axis and one beside it");
  axes_.col(0) = to_x.normalized();
  axes_.col(2) = normal.normalized();
  axes_.col(1) = axes_.col(2).cross(axes_.col(0));
}

Vector3 AbaqusSystem::in_basic(char kind, const Vector3& q) const {
  Vector3 own = q;
  const double angle = kRadiansPerDegree * q[1], up = kRadiansPerDegree * q[2];
  if (kind == 'C') own = {q[0] * std::cos(angle), q[0] * std::sin(angle), q[2]};
  if (kind == 'S')
    own = {q[0] * std::cos(up) * std::cos(angle), q[0] * std::cos(up) * std::sin(angle), q[0] * std::sin(up)};
  return origin_ + axes_ * own;
}

bool parse_label(std::string_view text, long& label) {
  if (parse_integer(text, label)) return true;
  const std::size_t point = text.rfind('.');
  return point != std::string_view::npos && parse_integer(text.substr(point + 1), label);
}

}  // namespace hersey::fem
