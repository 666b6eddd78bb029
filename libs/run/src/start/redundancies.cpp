#include "start/redundancies.h"

#include <fmt/format.h>

namespace hersey::run {
namespace {

constexpr std::size_t kMostWarnings = 3;

std::string name_of(const mbd::Mechanism& mechanism, mbd::JointId id) {
  return mechanism.spec().joints[static_cast<std::size_t>(id.index)].name;
}

// "left, pin and knee"
std::string listed(const mbd::Mechanism& mechanism, const std::vector<mbd::JointId>& joints) {
  std::string text;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (i > 0) text += i + 1 == joints.size() ? " and " : ", ";
    text += name_of(mechanism, joints[i]);
  }
  return text;
}

// "3 of the constraints that close the loop of left, pin and knee follow from the others (...)"
std::string described(const mbd::Mechanism& mechanism, const mbd::Redundancy& redundancy) {
  return fmt::format(
      "{} of the constraints that close the loop of {} follow from the others ({} on positions, {} on orientations) "
      "and "
      "were left out; of the reactions that balance the bodies, those of smallest norm are given",
      redundancy.positions + redundancy.orientations, listed(mechanism, redundancy.loop), redundancy.positions,
      redundancy.orientations);
}

// Summarises many loops, which are usually alike, in one warning; the assumptions in results and report list each of
// them.
Fault summary_of(const model::Model& model, const mbd::Mechanism& mechanism) {
  const std::vector<mbd::Redundancy>& all = mechanism.redundancies();
  const std::string path = "joints." + name_of(mechanism, all.front().joint);
  return {model.position_of(path), path,
          fmt::format("redundant: {} loops have constraints that follow from the others; in the first, {}", all.size(),
                      described(mechanism, all.front())),
          "as many constraints as motions, where single reactions matter",
          "free a motion in each loop, or connect elastically with bushings; the assumptions in the report name all"};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> redundancies(const mbd::Mechanism& mechanism) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const mbd::Redundancy& redundancy : mechanism.redundancies()) {
    rows.emplace_back("redundant constraints: joint " + name_of(mechanism, redundancy.joint),
                      described(mechanism, redundancy));
  }
  return rows;
}

std::vector<Fault> redundancy_warnings(const model::Model& model, const mbd::Mechanism& mechanism) {
  std::vector<Fault> warnings;
  if (mechanism.redundancies().size() > kMostWarnings) return {summary_of(model, mechanism)};
  for (const mbd::Redundancy& redundancy : mechanism.redundancies()) {
    const std::string path = "joints." + name_of(mechanism, redundancy.joint);
    warnings.push_back({model.position_of(path), path, "redundant: " + described(mechanism, redundancy),
                        "as many constraints as motions, where single reactions matter",
                        "free a motion in the loop, or connect elastically with a bushing"});
  }
  return warnings;
}

}  // namespace hersey::run
