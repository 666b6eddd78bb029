#include "series/group_record.h"

#include <algorithm>
#include <limits>
#include <string>

namespace hersey::run {
namespace {

using GroupStatistic = SummaryEntry::Statistic;

std::vector<std::size_t> films_of(const model::Model& model, const model::Composite& composite) {
  std::vector<std::size_t> films;
  for (std::size_t i = 0; i < model.bearings.size(); ++i)
    if (std::find(composite.pads.begin(), composite.pads.end(), model.bearings[i].name) != composite.pads.end())
      films.push_back(i);
  return films;
}

GroupPlan plan_of(const model::Model& model, const model::Machine& machine, const model::Composite& composite) {
  GroupPlan plan{model, composite, machine.mechanism->spec(), films_of(model, composite), {}, {}};
  for (const std::size_t film : plan.films) {
    const auto force = static_cast<std::size_t>(machine.bearings[film].force.index);
    plan.wrenches.push_back(force);
    plan.forces.push_back(plan.mechanism.forces[force]);
  }
  return plan;
}

std::string films_text(const GroupPlan& plan) {
  std::string text;
  for (const std::size_t film : plan.films) text += (text.empty() ? "" : " ") + plan.model.bearings[film].name;
  return text;
}

std::size_t body_of_frame(const GroupPlan& plan, mbd::FrameId frame) {
  return static_cast<std::size_t>(plan.mechanism.frames[static_cast<std::size_t>(frame.index)].body.index);
}

const bearing::BearingObservation& observed(const GroupRow& row, std::size_t k) {
  return row.step.bearings[row.plan.films[k]];
}

/// Force in ground's axes of all films on the body on which the first one acts: of a floating ring only its inner film
/// acts on the shaft.
Vector3 force_on_moving(const GroupRow& row) {
  const GroupPlan& plan = row.plan;
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < plan.films.size(); ++k) {
    const mbd::MechanismSpec::Force& force = plan.forces[k];
    if (body_of_frame(plan, force.b) != body_of_frame(plan, plan.forces.front().b)) continue;
    const mbd::FrameSpec& frame = plan.mechanism.frames[static_cast<std::size_t>(force.a.index)];
    const Matrix3 R = row.step.mechanism.bodies[body_of_frame(plan, force.a)].X_WF.R * frame.X_BF.R;
    sum += R * row.step.mechanism.force_wrenches[plan.wrenches[k]].tail<3>();
  }
  return sum;
}

double load(const GroupRow& row) { return force_on_moving(row).norm(); }

std::size_t thinnest(const GroupRow& row) {
  std::size_t least = 0;
  for (std::size_t k = 1; k < row.plan.films.size(); ++k)
    if (observed(row, k).film.h_min < observed(row, least).film.h_min) least = k;
  return least;
}

double least_film(const GroupRow& row) { return observed(row, thinnest(row)).film.h_min; }

double largest_pressure(const GroupRow& row) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < row.plan.films.size(); ++k) largest = std::max(largest, observed(row, k).film.p_max);
  return largest;
}

/// Sum over the films of a member of their observables.
auto sum_of(double film::FilmObservables::*member) {
  return [member](const GroupRow& row) {
    double sum = 0;
    for (std::size_t k = 0; k < row.plan.films.size(); ++k) sum += observed(row, k).film.*member;
    return sum;
  };
}

bool pads_wear(const GroupPlan& plan) { return plan.model.bearings[plan.films.front()].wear.has_value(); }

auto worn_by_all(double bearing::WearObservation::*volume) {
  return [volume](const GroupRow& row) {
    double sum = 0;
    for (std::size_t k = 0; k < row.plan.films.size(); ++k) sum += *observed(row, k).wear.*volume;
    return sum;
  };
}

double largest_wear(const GroupRow& row) {
  double largest = 0;
  for (std::size_t k = 0; k < row.plan.films.size(); ++k)
    largest = std::max(largest, observed(row, k).wear->fixed_depth);
  return largest;
}

double side_flow(const GroupRow& row) {
  return sum_of(&film::FilmObservables::flow_left)(row) + sum_of(&film::FilmObservables::flow_right)(row);
}

const std::vector<Attribute<GroupPlan>>& group_attributes() {
  static const std::vector<Attribute<GroupPlan>> table{
      {"kind", "", "of the bearing, as in the model file", [](const GroupPlan& plan) { return plan.composite.kind; }},
      {"films", "", "names of its films, which are bearings of these results", films_text},
  };
  return table;
}

const QuantityTable<GroupRow, GroupPlan>& group_quantities() {
  static const QuantityTable<GroupRow, GroupPlan> table{
      {"force", "N", "of all films on the shaft, in ground's axes; of a floating ring that of its inner film",
       force_on_moving},
      {"load",
       "N",
       "amount of that force",
       load,
       {.summary_entries = {{GroupStatistic::largest, "largest load on all films", "N"}}}},
      {"h_min",
       "m",
       "smallest film thickness of all films",
       least_film,
       {.symbol = "h_min", .summary_entries = {{GroupStatistic::smallest, "smallest film of all", "µm"}}}},
      {"thinnest_film", "1", "number of the film that is thinnest, among `films`, from 1",
       [](const GroupRow& row) { return static_cast<double>(thinnest(row) + 1); }},
      {"p_max",
       "Pa",
       "largest pressure of all films",
       largest_pressure,
       {.symbol = "p_max", .summary_entries = {{GroupStatistic::largest, "largest pressure of all films", "MPa"}}}},
      {"power_film",
       "W",
       "dissipated in all films",
       sum_of(&film::FilmObservables::power_film),
       {.summary_entries = {{GroupStatistic::mean, "mean power loss in all films", "W"}}}},
      {"power_asperity", "W", "dissipated in the contact of asperities of all films",
       sum_of(&film::FilmObservables::power_asperity)},
      {"side_flow",
       "m^3/s",
       "oil that leaves all films over their sides",
       side_flow,
       {.summary_entries = {{GroupStatistic::mean, "mean side flow of all films", "mm³/s"}}}},
      {"wear_fixed",
       "m",
       "largest depth worn off a pad",
       largest_wear,
       {.note = "this and the following: of bearings with `wear`",
        .only = pads_wear,
        .summary_entries = {{GroupStatistic::at_end, "largest wear of the pads at the end", "µm"}}}},
      {"worn_volume_fixed",
       "m^3",
       "worn off all pads",
       worn_by_all(&bearing::WearObservation::fixed_volume),
       {.only = pads_wear,
        .summary_entries = {{GroupStatistic::at_end, "volume worn off all pads at the end", "mm³"}}}},
      {"worn_volume_moving",
       "m^3",
       "worn off the moving surface by all films",
       worn_by_all(&bearing::WearObservation::moving_volume),
       {.only = pads_wear,
        .summary_entries = {{GroupStatistic::at_end, "volume worn off the moving surface by all films", "mm³"}}}},
  };
  return table;
}

std::string path_of(const model::Composite& composite) { return "/groups/" + composite.bearing.name + "/"; }

}  // namespace

bool GroupRecord::is_in(const model::Model& model, const model::Composite& composite) {
  return !films_of(model, composite).empty();
}

GroupRecord::GroupRecord(const model::Model& model, const model::Machine& machine, const model::Composite& composite,
                         results::Writer& writer)
    : plan_(plan_of(model, machine, composite)), rows_(group_quantities(), path_of(composite), plan_, writer) {
  write_once(group_attributes(), path_of(composite), plan_, writer);
}

QuantityGroup GroupRecord::describe() {
  QuantityGroup group{.path = "/groups/<g>/", .heading = "of a bearing of several films", .quantities = {}};
  run::describe(group_attributes(), "n", group);
  run::describe(group_quantities(), "n", group);
  return group;
}

}  // namespace hersey::run
