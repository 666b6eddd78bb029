#include "start/start_changes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace hersey::run {
namespace {

constexpr double kLargestStartShare = 1e-3;

using Changes = std::vector<mbd::ChangedStart>;

struct Display {
  double factor;
  const char* unit;
};

Display display_of(const mbd::ChangedStart& change) {
  if (change.is_rate) return {1, change.coordinate.rotational ? "rad/s" : "m/s"};
  if (change.coordinate.rotational) return {180 / std::numbers::pi, "deg"};
  return {1e3, "mm"};
}

// "44.9995 deg", "0 0 12.5 deg": with the digits that show the change.
std::string text_of(const mbd::ChangedStart& change, const std::vector<double>& values) {
  const Display display = display_of(change);
  double size = 0, difference = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    size = std::max(size, std::abs(values[i]));
    difference = std::max(difference, std::abs(change.found[i] - change.given[i]));
  }
  const int digits = difference > 0 && size > 0 ? static_cast<int>(std::ceil(std::log10(size / difference))) + 3 : 6;
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values)
    texts.push_back(fmt::format("{:.{}g}", display.factor * value, std::clamp(digits, 6, 15)));
  return fmt::format("{} {}", fmt::join(texts, " "), display.unit);
}

std::string joint_of(const mbd::Mechanism& mechanism, const mbd::ChangedStart& change) {
  return mechanism.spec().joints[static_cast<std::size_t>(change.joint.index)].name;
}

std::string coordinate_of(const mbd::ChangedStart& change) {
  return change.is_rate ? mbd::rate_name(change.coordinate) : std::string(change.coordinate.name);
}

Fault fault_of(const model::Model& model, const mbd::Mechanism& mechanism, const mbd::ChangedStart& change) {
  Fault fault;
  fault.path = fmt::format("joints.{}.initial.{}", joint_of(mechanism, change), coordinate_of(change));
  fault.position = model.position_of(fault.path);
  return fault;
}

}  // namespace

bool keeps_start(const model::Simulation& plan) {
  using model::Analysis;
  if (plan.analysis == Analysis::equilibrium || plan.analysis == Analysis::steady) return false;
  return plan.analysis != Analysis::modes || plan.modes_about == model::ModesAbout::start ||
         plan.modes_about == model::ModesAbout::end;
}

std::string gaps_text(const std::vector<solver::OpenConstraint>& open) {
  std::vector<std::string> gaps;
  gaps.reserve(open.size());
  for (const solver::OpenConstraint& one : open) {
    const std::string what = one.name.substr(0, one.name.find(','));
    if (one.name.ends_with("position")) {
      gaps.push_back(fmt::format("{} is {:.4g} mm apart", what, 1e3 * one.size));
    } else if (one.name.ends_with("orientation")) {
      const double degrees = std::asin(std::min(one.size, 1.0)) * 180 / std::numbers::pi;
      gaps.push_back(fmt::format("{} is {:.4g} deg out of line", what, degrees));
    } else {
      gaps.push_back(fmt::format("{} is {:.4g} (rad or m) off", what, one.size));
    }
  }
  return fmt::format("{}", fmt::join(gaps, ", "));
}

void require_given_start(const model::Model& model, mbd::Mechanism& mechanism, const solver::State& start,
                         const solver::InitialiseSummary& summary) {
  if (!keeps_start(model.simulation)) return;
  Changes changes = mechanism.changed_values(start);
  std::erase_if(changes, [](const mbd::ChangedStart& change) { return change.share <= kLargestStartShare; });
  // Rates follow positions: if positions do not fit, the rates are not the cause.
  const auto is_position = [](const mbd::ChangedStart& change) { return !change.is_rate; };
  if (std::any_of(changes.begin(), changes.end(), is_position)) std::erase_if(changes, std::not_fn(is_position));
  std::vector<Fault> faults;
  for (const mbd::ChangedStart& change : changes) {
    Fault fault = fault_of(model, mechanism, change);
    fault.found = fmt::format("{}, which the rest of the mechanism does not allow", text_of(change, change.given));
    if (!change.is_rate && !summary.conflict.empty())
      fault.found += fmt::format(" (with all initial values kept, {})", gaps_text(summary.conflict));
    fault.expected = "initial values that loops, drives and couplings can fulfil together; the nearest found has " +
                     text_of(change, change.found);
    fault.suggestion = change.is_rate
                           ? "give rates that drives, loops and films allow, or leave out those that follow from others"
                           : "correct a value, leave out those that follow from others, or give them under `guess`";
    faults.push_back(std::move(fault));
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

std::vector<Fault> start_warnings(const model::Model& model, mbd::Mechanism& mechanism, const solver::State& start) {
  std::vector<Fault> warnings;
  if (!keeps_start(model.simulation)) return warnings;
  for (const mbd::ChangedStart& change : mechanism.changed_values(start)) {
    Fault warning = fault_of(model, mechanism, change);
    warning.found =
        fmt::format("{} given, {} at the start", text_of(change, change.given), text_of(change, change.found));
    warning.expected = "values that loops, drives, couplings and gears can fulfil together";
    warning.suggestion = "leave out what follows from other values, or write it with all of its digits";
    warnings.push_back(std::move(warning));
  }
  return warnings;
}

std::vector<std::pair<std::string, std::string>> start_rows(const model::Model& model, mbd::Mechanism& mechanism,
                                                            const solver::State& start) {
  std::vector<std::pair<std::string, std::string>> rows;
  if (!keeps_start(model.simulation)) return rows;
  for (const mbd::ChangedStart& change : mechanism.changed_values(start)) {
    rows.emplace_back(
        fmt::format("start moved: joint {}, {}", joint_of(mechanism, change), coordinate_of(change)),
        fmt::format("{} given, {} taken: the least change with which loops, drives, couplings and gears fit",
                    text_of(change, change.given), text_of(change, change.found)));
  }
  return rows;
}

}  // namespace hersey::run
