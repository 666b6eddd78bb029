#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "hersey/fem/beam_section.h"
#include "interpret/context/interpret.h"

namespace hersey::model {
namespace {

/// Positions along the beam closer than this, over its length, coincide.
constexpr double kCoincident = 1e-9;

/// Points and what lies between them.
struct Axis {
  std::vector<Vector3> points;
  std::vector<double> distance;  ///< of each point from the first, along the axis
  [[nodiscard]] double length() const { return distance.back(); }
};

std::vector<Eigen::Vector2d> ellipse(double half_y, double half_z) {
  constexpr int corners = 16;
  std::vector<Eigen::Vector2d> outline;
  outline.reserve(corners);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    outline.emplace_back(half_y * std::cos(angle), half_z * std::sin(angle));
  }
  return outline;
}

class BeamReader {
 public:
  BeamReader(Context& context, const Value& body) : context_(context), body_(body) {}

  Beam read(const Value& value, std::vector<Frame>& frames) {
    Beam beam;
    beam.position = value.key_position;
    refuse_rigid_keys();
    if (const Value* material = value.find("material"))
      beam.material = {number_of(*material, "youngs_modulus"), number_of(*material, "poisson_ratio"),
                       number_of(*material, "density")};
    if (const Value* damping = value.find("damping")) beam.damping = number_of(*damping, "stiffness");
    if (const Value* section = value.find("section"); section != nullptr && !section->broken)
      read_section(*section, beam);
    read_inertia(value, beam);
    const std::optional<Axis> axis = axis_of(value);
    if (!axis) return beam;
    read_positions(*axis, frames);
    divide(*axis, integer_of(value, "elements"), beam);
    for (Frame& frame : frames) frame.nodes = {node_at(positions_[frame.name], *axis)};
    orient(value, beam);
    return beam;
  }

 private:
  void refuse_rigid_keys() {
    for (const char* key : {"inertia", "centre_of_mass", "shapes"})
      if (const Value* given = body_.find(key); given != nullptr && given->given)
        context_.fault_at_key(*given, std::string("`") + key + "` of a beam", "what its section and material give",
                              "remove the key; fix a rigid body to one of its frames for more mass or a shape");
  }

  void read_section(const Value& value, Beam& beam) {
    const double nu = beam.material.poisson_ratio;
    if (const Value* circle = value.find("circle"); circle != nullptr && !circle->broken) {
      const double diameter = number_of(*circle, "diameter"), bore = number_of(*circle, "bore");
      if (diameter > bore) {
        beam.section = fem::circular_section(diameter, bore, nu);
        beam.outline = ellipse(diameter / 2, diameter / 2);
      } else if (diameter > 0) {
        context_.fault(*circle->find("bore"), fmt::format("a bore of {:g} mm", 1e3 * bore),
                       fmt::format("less than the diameter, {:g} mm", 1e3 * diameter));
      }
    }
    if (const Value* rectangle = value.find("rectangle"); rectangle != nullptr && !rectangle->broken) {
      const double width = number_of(*rectangle, "width"), height = number_of(*rectangle, "height");
      if (width > 0 && height > 0) beam.section = fem::rectangular_section(width, height, nu);
      beam.outline = {
          {width / 2, height / 2}, {-width / 2, height / 2}, {-width / 2, -height / 2}, {width / 2, -height / 2}};
    }
    if (const Value* given = value.find("properties"); given != nullptr && !given->broken) {
      fem::BeamSection& s = beam.section;
      s = {number_of(*given, "area"), number_of(*given, "shear_y"), number_of(*given, "shear_z"),
           number_of(*given, "I_y"),  number_of(*given, "I_z"),     number_of(*given, "J")};
      // The ellipse of that area's radii of gyration.
      if (s.area > 0) beam.outline = ellipse(2 * std::sqrt(s.I_z / s.area), 2 * std::sqrt(s.I_y / s.area));
    }
  }

  /// Those of section and density, unless they are given.
  void read_inertia(const Value& value, Beam& beam) {
    const fem::BeamSection& s = beam.section;
    const double density = beam.material.density;
    beam.mass_per_length = density * s.area;
    beam.inertia_per_length = density * Vector3(s.I_y + s.I_z, s.I_y, s.I_z);
    const Value *whole = value.find("inertia"), *section = value.find("section");
    const Value* rotary = section != nullptr && !section->broken ? section->find("rotary_inertia") : nullptr;
    if (whole != nullptr && rotary != nullptr)
      context_.fault_at_key(*rotary, "`rotary_inertia` of a section beside `inertia` of the beam", "one of them",
                            "remove `inertia` to keep density times area as the mass, or `rotary_inertia`");
    if (whole != nullptr && !whole->broken) {
      beam.mass_per_length = number_of(*whole, "mass_per_length");
      beam.inertia_per_length = rotary_inertia_of(*whole);
    } else if (rotary != nullptr && !rotary->broken) {
      beam.inertia_per_length = rotary_inertia_of(*rotary);
    }
  }

  /// Moments about x, y and z; xx that of a thin slice unless it is given.
  Vector3 rotary_inertia_of(const Value& given) {
    const double yy = number_of(given, "yy"), zz = number_of(given, "zz");
    const double xx = given.find("xx") != nullptr ? number_of(given, "xx") : yy + zz;
    if (!context_.has_fault_in(given.path) && 2 * std::max({xx, yy, zz}) > (1 + 1e-9) * (xx + yy + zz))
      context_.fault_at_key(given,
                            fmt::format("moments of inertia {:g}, {:g} and {:g} kg.m about x, y and z", xx, yy, zz),
                            "each at most the sum of the other two", "of a thin slice xx is yy + zz");
    return {xx, yy, zz};
  }

  std::optional<Axis> axis_of(const Value& value) {
    const Value* points = value.find("points");
    if (points == nullptr || points->broken) return std::nullopt;
    if (points->members.size() < 2) {
      context_.fault(*points, "a beam with one point", "at least two points", "add the position of its other end");
      return std::nullopt;
    }
    Axis axis;
    for (const auto& [index, item] : points->members) {
      if (item.broken) return std::nullopt;
      const Vector3 point(item.numbers[0], item.numbers[1], item.numbers[2]);
      const double step = axis.points.empty() ? 0 : (point - axis.points.back()).norm();
      if (!axis.points.empty() && step == 0) {
        context_.fault(item, "the position of the point before it", "a point elsewhere", "remove it");
        return std::nullopt;
      }
      axis.distance.push_back(axis.points.empty() ? 0 : axis.distance.back() + step);
      axis.points.push_back(point);
    }
    return axis;
  }

  void read_positions(const Axis& axis, const std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      const Value& value = *body_.find("frames")->find(frame.name);
      if (const Value* origin = value.find("origin"); origin != nullptr)
        context_.fault_at_key(*origin, "`origin` of a frame on a beam", "`along`, a distance on its axis",
                              "fix a rigid body to the beam for what lies beside it");
      const Value* along = value.find("along");
      if (along == nullptr) {
        context_.fault_at_key(value, "a frame of a beam without `along`", "where on the beam it sits",
                              "add `along: start`, `along: end` or a distance from its start");
        continue;
      }
      if (along->broken) continue;
      const double position = along->text == "end" ? axis.length() : along->text == "start" ? 0 : along->number;
      if (position > axis.length() * (1 + kCoincident))
        context_.fault(*along,
                       fmt::format("a position {:g} mm along a beam of {:g} mm", 1e3 * position, 1e3 * axis.length()),
                       "a position on the beam", "for its last point write `along: end`");
      positions_[frame.name] = std::min(position, axis.length());
    }
  }

  /// Elements of about one length with ends on all points and frames.
  void divide(const Axis& axis, int elements, Beam& beam) {
    std::vector<double> ends = axis.distance;
    for (const auto& [name, position] : positions_) ends.push_back(position);
    std::sort(ends.begin(), ends.end());
    const auto same = [&](double a, double b) { return b - a < kCoincident * axis.length(); };
    ends.erase(std::unique(ends.begin(), ends.end(), same), ends.end());
    nodes_ = {0};
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double piece = ends[i] - ends[i - 1];
      const int count = std::max(1, static_cast<int>(std::lround(elements * piece / axis.length())));
      for (int k = 1; k <= count; ++k) nodes_.push_back(ends[i - 1] + piece * k / count);
    }
    for (const double position : nodes_) beam.nodes.push_back(point_at(axis, position) - axis.points.front());
  }

  static Vector3 point_at(const Axis& axis, double position) {
    std::size_t i = 1;
    while (i + 1 < axis.points.size() && axis.distance[i] < position) ++i;
    const double share = (position - axis.distance[i - 1]) / (axis.distance[i] - axis.distance[i - 1]);
    return (1 - share) * axis.points[i - 1] + share * axis.points[i];
  }

  [[nodiscard]] int node_at(double position, const Axis& axis) const {
    const auto near = std::find_if(nodes_.begin(), nodes_.end(), [&](double node) {
      return std::abs(node - position) < 2 * kCoincident * axis.length();
    });
    return near == nodes_.end() ? 0 : static_cast<int>(near - nodes_.begin());
  }

  void orient(const Value& value, Beam& beam) {
    const Vector3 first = (beam.nodes[1] - beam.nodes[0]).normalized();
    const bool along_z = std::abs(first.z()) > 1 - 1e-6;
    const Value* const given = value.find("up");
    const Vector3 up = given != nullptr ? direction_of(context_, value, "up")
                       : along_z        ? Vector3::UnitX()
                                        : Vector3::UnitZ();
    for (std::size_t i = 1; i < beam.nodes.size(); ++i) {
      const Vector3 x = (beam.nodes[i] - beam.nodes[i - 1]).normalized(), y = up.cross(x);
      if (y.norm() < 1e-6) {
        context_.fault_at_key(given != nullptr ? *given : value, "a beam that runs along the section's z-axis",
                              "a direction across the beam everywhere", "give another `up`");
        return;
      }
      Matrix3 axes;
      axes << x, y.normalized(), x.cross(y.normalized());
      beam.axes.push_back(axes);
    }
  }

  Context& context_;
  const Value& body_;
  std::map<std::string, double> positions_;  ///< of frames along the beam
  std::vector<double> nodes_;                ///< their positions along it
};

/// Bodies that are no beams have no length along which a frame could sit.
void refuse_along(Context& context, const Value& body) {
  for (const auto& [name, value] : section(body, "frames"))
    if (const Value* given = value.find("along"); given != nullptr)
      context.fault_at_key(*given, "`along` of a frame on a body that is no beam", "an `origin`, or `nodes` of a mesh",
                           "only beams have a length along which it could sit");
}

}  // namespace

std::optional<Beam> beam_of(Context& context, const Value& body, std::vector<Frame>& frames) {
  if (!body.has("beam")) {  // as ground never does
    refuse_along(context, body);
    return std::nullopt;
  }
  const Value* value = body.find("beam");
  if (value->broken) return std::nullopt;
  return BeamReader(context, body).read(*value, frames);
}

}  // namespace hersey::model
