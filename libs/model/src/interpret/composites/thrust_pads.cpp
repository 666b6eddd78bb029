#include "interpret/composites/thrust_pads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "check/members.h"
#include "hersey/core/two_pi.h"
#include "interpret/composites/pad_parts.h"
#include "schema/bearing_keys.h"
#include "schema/thermal_walls.h"

// A thrust bearing of pads on pivots: pads are bodies with a film on one sector, their pivots joints of a carrier.
namespace hersey::model {
namespace {

/// Film thickness over the pads' width with which a search begins where nothing else is known.
constexpr double usual_thinness = 1e-3;

class ThrustPads {
 public:
  ThrustPads(const Node& node, const Value& value, std::string stator, std::string runner, CompositeParts& parts,
             std::vector<Fault>& faults)
      : node_(node),
        value_(value),
        pads_(*value.find("pads")),
        pivot_(*value.find("pivot")),
        stator_(std::move(stator)),
        runner_(std::move(runner)),
        parts_(parts),
        faults_(faults) {}

  std::optional<Node> expand() {
    const std::size_t faults_before = faults_.size();
    inner_ = number_of(value_, "inner_diameter") / 2;
    outer_ = number_of(value_, "outer_diameter") / 2;
    if (inner_ >= outer_) {
      fault(*value_.find("outer_diameter"), fmt::format("{:.4g} mm", 2e3 * outer_),
            fmt::format("more than the inner diameter, {:.4g} mm", 2e3 * inner_));
      return std::nullopt;
    }
    parts_.clearance = usual_thinness * (outer_ - inner_);
    read_pads();
    check_pivot(pivot_, faults_);
    if (pivot_.text != "rigid" && pivot_.text != "spring" && is_line())
      fault(*pivot_.find("form"), "a line below a ball", "'point', or a pivot that is `rigid` or a `spring`",
            "contact along a line has no closed form without the depth of the bodies");
    if (faults_.size() > faults_before) return std::nullopt;
    find_inertia();
    const int count = integer_of(pads_, "count");
    for (int k = 0; k < count; ++k) add_pad(k, number_of(pads_, "angle") + two_pi * k / count);
    Node tree = written_tree();
    add_film_keys(tree);
    return tree;
  }

 private:
  void fault(const Value& at, std::string found, std::string expected, std::string suggestion = {}) {
    faults_.push_back({at.position, at.path, std::move(found), std::move(expected), std::move(suggestion)});
  }

  [[nodiscard]] bool yields() const { return pivot_.text != "rigid"; }
  [[nodiscard]] double sense() const { return value_.find("sense")->text == "negative" ? -1 : 1; }
  [[nodiscard]] bool is_line() const { return pivot_.find("form")->text == "line"; }

  void read_pads() {
    const int count = integer_of(pads_, "count");
    arc_ = number_of(pads_, "arc");
    thickness_ = pads_.find("thickness") != nullptr ? number_of(pads_, "thickness") : 0.4 * (outer_ - inner_);
    const Value* radius = pads_.find("pivot_radius");
    parts_.pivot_radius = radius != nullptr ? radius->number : 0.5 * (inner_ + outer_);
    constexpr double in_degrees = 180 / std::numbers::pi, least = 1e-6;  // rad, of a groove between two pads
    if (count * (arc_ + least) > two_pi)
      fault(*pads_.find("arc"),
            fmt::format("{} pads of {:.5g} deg that overlap, {:.5g} deg in all", count, in_degrees * arc_,
                        in_degrees * count * arc_),
            fmt::format("less than {:.5g} deg", 360.0 / count));
    if (radius != nullptr && (radius->number <= inner_ || radius->number >= outer_))
      fault(*radius, fmt::format("a pivot at {:.4g} mm from the axis, outside its pad", 1e3 * radius->number),
            fmt::format("between {:.4g} and {:.4g} mm", 1e3 * inner_, 1e3 * outer_));
  }

  /// Tilt at which a pad begins: its leading edge opened by a quarter of a usual film, from where a film carries that
  /// is not a uniform one [rad].
  [[nodiscard]] double opening() const {
    const double offset = number_of(pads_, "offset"), farther = std::max(offset, 1 - offset) * arc_;
    // A stator may face against the axis about which the shaft rotates; its sense is then given.
    return std::copysign(0.25, value_.find("sense")->given ? sense() : parts_.speed) * parts_.clearance /
           (parts_.pivot_radius * std::sin(std::min(farther, 0.25 * two_pi)));
  }

  void find_inertia() {
    inertia_ = sector_of_ring(inner_, outer_ - inner_, arc_, thickness_, number_of(pads_, "density"));
    if (const Value* mass = pads_.find("mass"); mass != nullptr) inertia_ = with_mass(inertia_, mass->number);
  }

  void add_pad(int k, double middle) {
    const std::string pad = fmt::format("{}_pad_{}", parts_.name, k + 1);
    parts_.pads.push_back(pad);
    // The offset counts from the leading edge.
    const double angle = middle + sense() * (number_of(pads_, "offset") - 0.5) * arc_;
    parts_.pivot_angles.push_back(angle);
    // x of a pivot points along the radius, y around the axis.
    const std::string pivot =
        fmt::format("origin: [{} m, {} m, {} m], rotation: {{axis: z, angle: {} rad}}",
                    parts_.pivot_radius * std::cos(angle), parts_.pivot_radius * std::sin(angle), -thickness_, angle);
    carrier_frames_ += fmt::format("      pivot_{}: {{{}}}\n", k + 1, pivot);
    add_body(pad, pivot, middle);
    std::string inboard = fmt::format("{}_carrier.pivot_{}", parts_.name, k + 1);
    if (yields()) inboard = add_seat(pad, inboard);
    joints_ +=
        fmt::format("  {0}_pivot: {{type: {1}, between: [{2}, {0}.pivot], axis: {3}, initial: {{{4}: {5} rad}}}}\n",
                    pad, is_line() ? "revolute" : "universal", inboard, is_line() ? "x" : "z",
                    is_line() ? "rotation" : "rotation_1", opening());
    bearings_ += fmt::format(
        "  {0}:\n    kind: thrust\n    stator: {0}.face\n    runner: {1}\n"
        "    pads: {{count: 1, arc: {2} rad, angle: {3} rad}}\n",
        pad, runner_, arc_, middle);
  }

  void add_body(const std::string& pad, const std::string& pivot, double middle) {
    const double c = std::cos(middle), s = std::sin(middle);
    const double xx = inertia_.radial * c * c + inertia_.tangential * s * s,
                 yy = inertia_.radial * s * s + inertia_.tangential * c * c,
                 xy = (inertia_.radial - inertia_.tangential) * s * c;
    bodies_ += fmt::format(
        "  {}:\n    mass: {} kg\n    centre_of_mass: [{} m, {} m, {} m]\n"
        "    inertia: {{xx: {} kg.m^2, yy: {} kg.m^2, zz: {} kg.m^2, xy: {} kg.m^2}}\n"
        "    frames: {{pivot: {{{}}}, face: {{origin: [0 m, 0 m, 0 m]}}}}\n",
        pad, inertia_.mass, inertia_.centre * c, inertia_.centre * s, -0.5 * thickness_, xx, yy, inertia_.axial, xy,
        pivot);
  }

  /// A pivot that yields: a seat without mass that slides away from the collar against a spring.
  std::string add_seat(const std::string& pad, const std::string& inboard) {
    const std::string seat = pad + "_seat", travel = pad + "_travel";
    bodies_ += fmt::format("  {}: {{mass: 0 kg}}\n", seat);
    joints_ += fmt::format("  {}: {{type: prismatic, between: [{}, {}], axis: [0, 0, -1]}}\n", travel, inboard, seat);
    forces_ += fmt::format("  {0}: {{type: sliding_spring, joint: {0}, damping: {1} N.s/m, {2}}}\n", travel,
                           number_of(pivot_, "damping"), pivot_law(pivot_));
    return seat;
  }

  [[nodiscard]] Node written_tree() const {
    std::string text =
        "bodies:\n  " + parts_.name + "_carrier:\n    mass: 0 kg\n    frames:\n" + carrier_frames_ + bodies_;
    text += fmt::format("joints:\n  {0}_carrier: {{type: fixed, between: [{1}, {0}_carrier]}}\n{2}", parts_.name,
                        stator_, joints_);
    if (!forces_.empty()) text += "forces:\n" + forces_;
    text += "bearings:\n" + bearings_;
    if (has_warm_films(value_))
      text += thermal_of_pads(value_, warmed(), parts_.name, parts_.pads, parts_.pivot_angles);
    return parts_tree(text, parts_.position);
  }

  /// The collar that all films warm: a disc as thick as the pads are wide.
  [[nodiscard]] WarmedByPads warmed() const {
    return {.key = "runner",
            .node = parts_.name + "_runner",
            .capacity = heat_of_steel * std::numbers::pi * outer_ * outer_ * (outer_ - inner_)};
  }

  /// What each film has of the bearing, as it stands in the file.
  void add_film_keys(Node& tree) const {
    for (Entry& film : tree.find("bearings")->entries) {
      for (const Entry& own : node_.entries)
        if (is_key_of_each_pad(parts_.kind, own.key)) film.value.entries.push_back(own);
      set_worn_group("runner", parts_.name, film.value);
      if (const Node* runner = node_.find("runner")) film.value.find("runner")->position = runner->position;
    }
    if (has_warm_films(value_)) set_moving_wall(value_, warmed(), parts_.position, tree);
  }

  const Node& node_;
  const Value &value_, &pads_, &pivot_;
  std::string stator_, runner_;
  CompositeParts& parts_;
  std::vector<Fault>& faults_;
  double inner_ = 0, outer_ = 0, arc_ = 0, thickness_ = 0;
  PadInertia inertia_;
  std::string bodies_, carrier_frames_, joints_, forces_, bearings_;
};

}  // namespace

std::optional<Node> thrust_pads(const Node& node, const Value& value, const std::string& stator,
                                const std::string& runner, CompositeParts& parts, std::vector<Fault>& faults) {
  return ThrustPads(node, value, stator, runner, parts, faults).expand();
}

}  // namespace hersey::model
