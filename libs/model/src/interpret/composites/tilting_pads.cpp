#include "interpret/composites/tilting_pads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/members.h"
#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"
#include "interpret/composites/pad_parts.h"
#include "schema/bearing_keys.h"
#include "schema/thermal_walls.h"

// A bearing of tilting pads: pads are bodies with a film on one arc, their pivots joints of a carrier.
namespace hersey::model {
namespace {

class TiltingPads {
 public:
  TiltingPads(const Node& node, const Value& value, std::string shell, std::string journal, CompositeParts& parts,
              std::vector<Fault>& faults)
      : node_(node),
        value_(value),
        pads_(*value.find("pads")),
        pivot_(*value.find("pivot")),
        shell_(std::move(shell)),
        journal_(std::move(journal)),
        parts_(parts),
        faults_(faults) {}

  std::optional<Node> expand() {
    const std::size_t faults_before = faults_.size();
    R_ = number_of(value_, "diameter") / 2;
    parts_.clearance = value_.find("diametral_clearance") != nullptr ? number_of(value_, "diametral_clearance") / 2
                                                                     : number_of(value_, "radial_clearance");
    arc_ = number_of(pads_, "arc");
    offset_ = number_of(pads_, "offset");
    thickness_ = pads_.find("thickness") != nullptr ? number_of(pads_, "thickness") : 0.4 * R_;
    find_pivots();
    read_preload();
    check_pads();
    check_pivot(pivot_, faults_);
    if (is_elastic())
      check_elastic();
    else
      find_inertia();
    if (faults_.size() > faults_before) return std::nullopt;
    for (std::size_t k = 0; k < parts_.pivot_angles.size(); ++k) add_pad(k);
    Node tree = written_tree();
    add_film_keys(tree);
    return tree;
  }

 private:
  void fault(const Value& at, std::string found, std::string expected, std::string suggestion = {}) {
    faults_.push_back({at.position, at.path, std::move(found), std::move(expected), std::move(suggestion)});
  }

  [[nodiscard]] bool yields() const { return pivot_.text != "rigid"; }
  [[nodiscard]] bool is_elastic() const { return pads_.find("elastic") != nullptr; }
  [[nodiscard]] static std::string foot_of(const std::string& pad) { return pad + "_foot"; }
  [[nodiscard]] std::string pad_name(std::size_t k) const { return fmt::format("{}_pad_{}", parts_.name, k + 1); }

  /// Tilt with which a pad begins [rad], theory manual eq. (pads.3): its film narrows along the sliding direction by
  /// half the clearance towards the farther end. Flat pads may have no film to begin with.
  [[nodiscard]] double opening() const {
    const double farther = std::max(offset_, 1 - offset_) * arc_;
    return std::copysign(0.5, parts_.speed) * parts_.clearance /
           ((R_ + thickness_) * std::sin(std::min(farther, 0.25 * two_pi)));
  }

  void find_pivots() {
    const int count = integer_of(pads_, "count");
    if (const Value* given = pads_.find("pivot_angles"); given != nullptr) {
      for (const Member& angle : given->members) parts_.pivot_angles.push_back(angle.value.number);
      if (static_cast<int>(parts_.pivot_angles.size()) != count)
        fault(*given, fmt::format("{} angles of {} pads", parts_.pivot_angles.size(), count), "one for each pad");
      return;
    }
    const double pitch = two_pi / count, first = pads_.find("load")->text == "on_pad" ? 0 : -0.5 * pitch;
    for (int k = 0; k < count; ++k) parts_.pivot_angles.push_back(number_of(pads_, "load_angle") + first + pitch * k);
  }

  void read_preload() {
    const Value *machined = pads_.find("machined_clearance"), *preload = pads_.find("preload");
    preload_ = machined != nullptr ? 1 - parts_.clearance / machined->number : preload != nullptr ? preload->number : 0;
    if (machined != nullptr && preload != nullptr)
      fault(*machined, "both 'machined_clearance' and 'preload'", "one of them");
    if (preload != nullptr && preload_ >= 1) fault(*preload, "a preload of 1 or more", "less than 1, such as 0.5");
  }

  void check_pads() {
    std::vector<double> sorted = parts_.pivot_angles;
    for (double& angle : sorted) angle = std::remainder(angle, two_pi);
    std::sort(sorted.begin(), sorted.end());
    const auto degrees = [](double angle) { return angle * 180 / std::numbers::pi; };
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const bool is_last = k + 1 == sorted.size();
      const double next = is_last ? sorted.front() + two_pi : sorted[k + 1];
      constexpr double least = 1e-6;  // rad, of a groove between two pads
      if (next - sorted[k] >= arc_ + least) continue;
      fault(*pads_.find("arc"),
            fmt::format("pads of {:.5g} deg that overlap: pivots at {:.5g} and {:.5g} deg", degrees(arc_),
                        degrees(sorted[k]), degrees(next)),
            fmt::format("less than {:.5g} deg", degrees(next - sorted[k])));
      return;
    }
  }

  /// Of pads that bend, which have the mass of their mesh.
  void check_elastic() {
    const Value& elastic = *pads_.find("elastic");
    for (const char* key : {"mass", "inertia"})
      if (const Value* given = pads_.find(key); given != nullptr)
        fault(*given, fmt::format("`{}` of pads that bend", key), "what their mesh and `density` give",
              "remove the key");
    if (number_of(pads_, "density") == 0)
      fault(*pads_.find("density"), "pads that bend, without density", "a density above 0");
    const Value* given = elastic.find("seat");
    seat_ = given != nullptr ? given->number : 0.25 * thickness_;
    const double to_end = std::min(offset_, 1 - offset_) * arc_ * (R_ + thickness_), width = number_of(value_, "width");
    if (0.5 * seat_ <= to_end && seat_ <= width) return;
    fault(given != nullptr ? *given : elastic,
          fmt::format("a seat of {:.4g} mm around the pivot, outside the pad", 1e3 * seat_),
          fmt::format("at most {:.4g} mm", 1e3 * std::min(2 * to_end, width)));
  }

  void add_pad(std::size_t k) {
    const std::string pad = pad_name(k);
    parts_.pads.push_back(pad);
    const double angle = parts_.pivot_angles[k], c = std::cos(angle), s = std::sin(angle), r = R_ + thickness_;
    const std::string pivot = fmt::format("[{} m, {} m, 0 m]", r * c, r * s);
    carrier_frames_ += fmt::format("      pivot_{}: {{origin: {}}}\n", k + 1, pivot);
    if (is_elastic())
      add_elastic_body(pad, pivot, angle);
    else
      add_body(pad, pivot, angle + (0.5 - offset_) * arc_);
    std::string inboard = fmt::format("{}_carrier.pivot_{}", parts_.name, k + 1);
    if (yields()) inboard = add_seat(k, inboard, c, s);
    const bool pitches = pivot_.find("pitch")->text == "yes";
    const std::string start = pitches ? fmt::format("orientation: [0 rad, 0 rad, {} rad]", opening())
                                      : fmt::format("rotation: {} rad", opening());
    joints_ += fmt::format("  {0}_pivot: {{type: {1}, between: [{2}, {3}.pivot], initial: {{{4}}}}}\n", pad,
                           pitches ? "spherical" : "revolute", inboard, is_elastic() ? foot_of(pad) : pad, start);
    if (const double torque = number_of(pivot_, "friction_torque"); torque > 0) {
      constexpr double creep = 1e-3;  // rad/s, below which friction rises with the speed
      forces_ += fmt::format(
          "  {0}_friction: {{type: joint_friction, joint: {0}_pivot, coulomb: {1} N.m, "
          "transition_speed: {2} rad/s}}\n",
          pad, torque, creep);
    }
    const std::string preload = fmt::format("preload: {}", preload_);
    bearings_ += fmt::format("  {0}:\n    shell: {0}.face\n    journal: {1}\n", pad, journal_);
    if (is_elastic())
      bearings_ +=
          fmt::format("    shell_surface: {{faces: inner, modes: {}}}\n", integer_of(*pads_.find("elastic"), "modes"));
    bearings_ += fmt::format("    arcs: {{pad: {{middle: {} rad, arc: {} rad, {}, offset: {}}}}}\n",
                             angle + (0.5 - offset_) * arc_, arc_, preload, offset_);
  }

  void find_inertia() {
    inertia_ = sector_of_ring(R_, thickness_, arc_, number_of(value_, "width"), number_of(pads_, "density"));
    if (const Value* mass = pads_.find("mass"); mass != nullptr) inertia_ = with_mass(inertia_, mass->number);
    const Value* about_pivot = pads_.find("inertia");
    if (about_pivot == nullptr) return;
    const double r = R_ + thickness_, centre = inertia_.centre;
    const double lever_square = r * r + centre * centre - 2 * r * centre * std::cos((0.5 - offset_) * arc_);
    inertia_.axial = about_pivot->number - inertia_.mass * lever_square;
    if (inertia_.axial < 0) {
      fault(*about_pivot,
            fmt::format("{:.4g} kg.m^2, less than the pad's mass has by its distance from the pivot",
                        about_pivot->number),
            fmt::format("at least {:.4g} kg.m^2", inertia_.mass * lever_square));
    }
    // No moment exceeds the sum of the other two.
    for (double* moment : {&inertia_.radial, &inertia_.tangential}) *moment = std::max(*moment, 0.5 * inertia_.axial);
  }

  void add_body(const std::string& pad, const std::string& pivot, double middle) {
    const double c = std::cos(middle), s = std::sin(middle);
    const double xx = inertia_.radial * c * c + inertia_.tangential * s * s,
                 yy = inertia_.radial * s * s + inertia_.tangential * c * c,
                 xy = (inertia_.radial - inertia_.tangential) * s * c;
    bodies_ += fmt::format(
        "  {}:\n    mass: {} kg\n    centre_of_mass: [{} m, {} m, 0 m]\n"
        "    inertia: {{xx: {} kg.m^2, yy: {} kg.m^2, zz: {} kg.m^2, xy: {} kg.m^2}}\n"
        "    frames: {{pivot: {{origin: {}}}, face: {{origin: [0 m, 0 m, 0 m]}}}}\n",
        pad, inertia_.mass, inertia_.centre * c, inertia_.centre * s, xx, yy, inertia_.axial, xy, pivot);
  }

  /// A pad that bends: a mesh that stands on its seat, which a foot without mass bears. The film's frame follows the
  /// mean of the seat.
  void add_elastic_body(const std::string& pad, const std::string& pivot, double angle) {
    const Value& elastic = *pads_.find("elastic");
    const double width = number_of(value_, "width");
    const bool pitches = pivot_.find("pitch")->text == "yes";
    bodies_ += fmt::format("  {}: {{mass: 0 kg, frames: {{pivot: {{origin: {}}}}}}}\n", foot_of(pad), pivot);
    bodies_ += fmt::format("  {}:\n    flexible:\n      modes: 0\n", pad);
    bodies_ += fmt::format("      material: {{youngs_modulus: {} Pa, poisson_ratio: {}, density: {} kg/m^3}}\n",
                           number_of(elastic, "youngs_modulus"), number_of(elastic, "poisson_ratio"),
                           number_of(pads_, "density"));
    const std::vector<Member>& elements = elastic.find("elements")->members;
    bodies_ += fmt::format(
        "      sector:\n        inner_radius: {} m\n        thickness: {} m\n        width: {} m\n"
        "        middle: {} rad\n        arc: {} rad\n        elements: [{}, {}, {}]\n"
        "        seat: {{angle: {} rad, arc: {} rad, width: {} m}}\n",
        R_, thickness_, width, angle + (0.5 - offset_) * arc_, arc_, elements[0].value.number, elements[1].value.number,
        elements[2].value.number, angle, seat_ / (R_ + thickness_), pitches ? seat_ : width);
    bodies_ += "    frames: {face: {nodes: seat, connection: average, origin: [0 m, 0 m, 0 m]}}\n";
    joints_ += fmt::format("  {0}: {{type: fixed, between: [{0}, {1}.face]}}\n", foot_of(pad), pad);
  }

  /// A pivot that yields: a seat without mass that slides along the radius against a spring.
  std::string add_seat(std::size_t k, const std::string& inboard, double c, double s) {
    const std::string pad = pad_name(k), seat = pad + "_seat", travel = pad + "_travel";
    bodies_ += fmt::format("  {}: {{mass: 0 kg}}\n", seat);
    joints_ +=
        fmt::format("  {}: {{type: prismatic, between: [{}, {}], axis: [{}, {}, 0]}}\n", travel, inboard, seat, c, s);
    forces_ += fmt::format("  {0}: {{type: sliding_spring, joint: {0}, damping: {1} N.s/m, {2}}}\n", travel,
                           number_of(pivot_, "damping"), pivot_law(pivot_));
    return seat;
  }

  /// The journal that all films warm.
  [[nodiscard]] WarmedByPads warmed() const {
    return {.key = "journal",
            .node = parts_.name + "_journal",
            .capacity = heat_of_steel * std::numbers::pi * R_ * R_ * number_of(value_, "width")};
  }

  [[nodiscard]] Node written_tree() {
    std::string text =
        "bodies:\n  " + parts_.name + "_carrier:\n    mass: 0 kg\n    frames:\n" + carrier_frames_ + bodies_;
    text += fmt::format("joints:\n  {0}_carrier: {{type: fixed, between: [{1}, {0}_carrier]}}\n{2}", parts_.name,
                        shell_, joints_);
    if (!forces_.empty()) text += "forces:\n" + forces_;
    text += "bearings:\n" + bearings_;
    if (has_warm_films(value_))
      text += thermal_of_pads(value_, warmed(), parts_.name, parts_.pads, parts_.pivot_angles);
    return parts_tree(text, parts_.position);
  }

  /// What each film has of the bearing, as it stands in the file.
  void add_film_keys(Node& tree) const {
    const Node* pads = node_.find("pads");
    for (Entry& film : tree.find("bearings")->entries) {
      for (const Entry& own : node_.entries)
        if (is_key_of_each_pad(parts_.kind, own.key)) film.value.entries.push_back(own);
      set_worn_group("journal", parts_.name, film.value);
      if (const Node* journal = node_.find("journal")) film.value.find("journal")->position = journal->position;
      Node* arc = film.value.find("arcs")->find("pad");
      for (const char* key : {"edge_pressure", "ambient_fill", "edge_flow"}) {
        const auto given = std::find_if(pads->entries.begin(), pads->entries.end(),
                                        [&](const Entry& entry) { return entry.key == key; });
        if (given != pads->entries.end()) arc->entries.push_back(*given);
      }
    }
    if (has_warm_films(value_)) set_moving_wall(value_, warmed(), parts_.position, tree);
  }

  const Node& node_;
  const Value &value_, &pads_, &pivot_;
  std::string shell_, journal_;
  CompositeParts& parts_;
  std::vector<Fault>& faults_;
  double R_ = 0, arc_ = 0, offset_ = 0, thickness_ = 0, preload_ = 0, seat_ = 0;
  PadInertia inertia_;
  std::string bodies_, carrier_frames_, joints_, forces_, bearings_;
};

}  // namespace

std::optional<Node> tilting_pads(const Node& node, const Value& value, const std::string& shell,
                                 const std::string& journal, CompositeParts& parts, std::vector<Fault>& faults) {
  return TiltingPads(node, value, shell, journal, parts, faults).expand();
}

}  // namespace hersey::model
