#include "series/bearing_record.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "cycle/cycle_maps.h"
#include "hersey/bearing/film_coordinates.h"
#include "hersey/bearing/quantities.h"
#include "hersey/bearing/restricted_feeds.h"
#include "hersey/bearing/skirt.h"
#include "hersey/run/assumptions.h"
#include "hersey/run/film_fields.h"
#include "series/geometry_record.h"

namespace hersey::run {
namespace {

using Film = film::FilmObservables;
using Statistic = SummaryEntry::Statistic;

/// Member of the observation of the bearing.
template <class Member>
auto of_bearing(Member member) {
  return [member](const BearingRow& row) { return std::invoke(member, row.observation); };
}

/// Member of the position of its journal.
template <class Member>
auto of_position(Member member) {
  return [member](const BearingRow& row) { return std::invoke(member, row.observation.position); };
}

/// Member of the observables of its film.
template <class Member>
auto of_film(Member member) {
  return [member](const BearingRow& row) { return std::invoke(member, row.observation.film); };
}

template <class Member>
auto of_oil(Member member) {
  return [member](const BearingRow& row) { return std::invoke(member, row.observation.oil); };
}

Vector3 force_on_shell(const BearingRow& row) { return row.observation.wrench_on_shell.tail<3>(); }
Vector3 moment_on_shell(const BearingRow& row) { return row.observation.wrench_on_shell.head<3>(); }

// Attitude angle: from the load on the journal (the shell's film force reversed) to the line of centres, 0..pi.
double attitude(const BearingRow& row) {
  const Eigen::Vector2d load = force_on_shell(row).head<2>(), e = row.observation.position.e;
  return std::abs(std::atan2(load.x() * e.y() - load.y() * e.x(), load.dot(e)));
}

double power_error(const BearingRow& row) {
  return -row.observation.power_into_bodies - row.observation.film.power_taken();
}

bool has_axis(const BearingPlan& plan) { return plan.bearing.kind->has_axis(); }

bool has_ends(const BearingPlan& plan) { return !plan.bearing.film.ends.empty(); }
bool is_annulus(const BearingPlan& plan) { return bearing::is_on_annulus(plan.bearing.film); }
bool is_plane(const BearingPlan& plan) { return !film::is_round(plan.bearing.film.surface); }
bool is_round(const BearingPlan& plan) { return !is_plane(plan); }
bool is_skirt(const BearingPlan& plan) { return std::holds_alternative<film::Skirt>(plan.bearing.film.surface); }
/// True of films between two cylinders.
bool is_cylindrical(const BearingPlan& plan) { return has_axis(plan) || is_skirt(plan); }
bool has_leading_ends(const BearingPlan& plan) { return has_ends(plan) && !is_skirt(plan); }

bool meets_layers(const BearingPlan& plan) {
  return plan.bearing.film.edge_left.layer || plan.bearing.film.edge_right.layer;
}

/// Offset of a skirt's axis at one of its ends. @param end  1 at the top, -1 at the bottom
auto skirt_offset(double end) {
  return [end](const BearingRow& row) {
    return row.observation.position.e[0] + 0.5 * end * row.model->L * row.observation.position.tilt.x();
  };
}

std::vector<std::string> names_of_skirt_sides(const BearingPlan& plan) {
  if (!is_skirt(plan)) return {};
  return {bearing::skirt_sides.begin(), bearing::skirt_sides.end()};
}

bearing::SkirtSide side_of_skirt(const BearingRow& row, std::size_t k) {
  return bearing::skirt_side_forces(*row.model, row.observation.film.normal_forces).at(k);
}

double skirt_side_force(const BearingRow& row) { return -row.observation.wrench_on_shell[3]; }

double friction_on_skirt(const BearingRow& row) {
  return bearing::skirt_friction(row.observation.wrench_on_shell, row.observation.position.tilt);
}
/// True of films whose rows have a z, not a radius.
bool has_z(const BearingPlan& plan) { return !is_annulus(plan); }

/// A flow over the leading or the trailing ends of patches.
auto over_end(double Film::*of_forward, double Film::*of_backward) {
  return [=](const BearingRow& row) { return row.observation.film.*(row.is_forward ? of_forward : of_backward); };
}

/// A radius on an annulus, from what the film counts from the mean one.
auto of_radius(double Film::*z) {
  return [z](const BearingRow& row) { return row.radius + row.observation.film.*z; };
}

bool has_depth(const BearingPlan& plan) {
  const std::vector<film::SurfaceFeature>& features = plan.bearing.film.features;
  return std::any_of(features.begin(), features.end(), [](const film::SurfaceFeature& f) { return f.depth > 0; });
}

bool conserves_oil(const BearingPlan& plan) { return !film::cavitation_law(plan.bearing.film).loses_oil(); }

bool is_partitioned(const BearingPlan& plan) {
  return plan.bearing.coupling.scheme == model::CouplingScheme::partitioned;
}

std::vector<std::string> feature_names(const BearingPlan& plan) {
  std::vector<std::string> names;
  for (const film::SurfaceFeature& feature : plan.bearing.film.features) names.push_back(feature.name);
  return names;
}

double flow_of_feature(const BearingRow& row, std::size_t k) {
  return row.observation.film.flow_features[static_cast<Eigen::Index>(k)];
}

std::vector<std::string> restricted_names(const BearingPlan& plan) {
  return bearing::RestrictedFeeds::names(plan.bearing.film);
}

std::vector<std::string> names_with_supply(const BearingPlan& plan) {
  return bearing::RestrictedFeeds::names_with_supply(plan.bearing.film);
}

bearing::RestrictedFeeds feeds(const BearingRow& row) { return {*row.model, row.observation.film}; }

bool has_restrictors(const BearingPlan& plan) { return film::has_restrictors(plan.bearing.film); }

bool has_heat(const BearingPlan& plan) { return std::holds_alternative<film::ThermalModel>(plan.bearing.heat); }

// Walls of a bore are a shell and a journal, those of a flat film pads and a runner.
bool is_warm_bore(const BearingPlan& plan) { return has_heat(plan) && has_axis(plan); }
bool is_warm_flat(const BearingPlan& plan) { return has_heat(plan) && !has_axis(plan); }
bool is_warm_annulus(const BearingPlan& plan) { return has_heat(plan) && is_annulus(plan); }
bool is_warm_round(const BearingPlan& plan) { return has_heat(plan) && is_round(plan); }
bool is_warm_plane(const BearingPlan& plan) { return has_heat(plan) && is_plane(plan); }
bool is_warm_with_z(const BearingPlan& plan) { return has_heat(plan) && has_z(plan); }

bool shell_is_in_body(const BearingPlan& plan) { return plan.bearing.heated_shell != nullptr; }

bool journal_is_in_body(const BearingPlan& plan) { return plan.bearing.heated_journal != nullptr; }

bool is_in_body(const BearingPlan& plan) { return shell_is_in_body(plan) || journal_is_in_body(plan); }

bool expands(const BearingPlan& plan) { return plan.bearing.expansion.has_value(); }

bool wears(const BearingPlan& plan) { return plan.bearing.wear.has_value(); }

bool wears_by_cycles(const BearingPlan& plan) { return wears(plan) && plan.bearing.wear->cycle > 0; }

bool runs_in(const BearingPlan& plan) { return wears(plan) && plan.bearing.wear->running_in.has_value(); }

using Wear = bearing::WearObservation;

auto of_wear(double Wear::*member) {
  return [member](const BearingRow& row) { return *row.observation.wear.*member; };
}

auto roughness_of(double Wear::*ratio) {
  return [ratio](const BearingRow& row) { return row.model->asperities.sigma * *row.observation.wear.*ratio; };
}

using Heat = film::HeatObservables;

/// Temperature of the film's heat in degC.
auto celsius(double Heat::*T) {
  return [T](const BearingRow& row) { return *row.observation.heat.*T - film::zero_celsius; };
}

template <class Member>
auto of_heat(Member member) {
  return [member](const BearingRow& row) { return std::invoke(member, *row.observation.heat); };
}

auto of_heat_balance(double film::HeatBalance::*member) {
  return [member](const BearingRow& row) { return row.observation.heat->balance.*member; };
}

/// Line and features, in the order of HeatObservables::T_supplies.
std::vector<std::string> supply_names(const BearingPlan& plan) {
  std::vector<std::string> names = feature_names(plan);
  if (plan.bearing.film.supply.kind != film::SupplyKind::none) names.insert(names.begin(), "line");
  return has_heat(plan) ? names : std::vector<std::string>{};
}

double supply_temperature(const BearingRow& row, std::size_t k) {
  return row.observation.heat->T_supplies[static_cast<Eigen::Index>(k)] - film::zero_celsius;
}

/// A field with one column for each angle: index i n_z + j is angle i, height j.
Eigen::Map<const Eigen::MatrixXd> by_angle(const Eigen::VectorXd& field, const film::Grid& grid) {
  return {field.data(), grid.n_z, grid.n_phi};
}

Eigen::VectorXd h_min_around(const BearingRow& row) {
  const Eigen::VectorXd thickness = row.fields.thickness();
  return by_angle(thickness, row.grid).colwise().minCoeff();
}

Eigen::VectorXd p_max_around(const BearingRow& row) { return by_angle(row.fields.p, row.grid).colwise().maxCoeff(); }

/// A line of the table with the unit, the symbol and the words of bearing::quantity(id).
template <class Get>
Quantity<BearingRow, BearingPlan> line(std::string_view id, Get get, More<BearingPlan> more = {}) {
  const bearing::Quantity& quantity = bearing::quantity(id);
  more.symbol = quantity.symbol;
  return {std::string(quantity.id), std::string(quantity.unit), quantity.definition(), get, std::move(more)};
}

/// The table of a bearing's quantities over time. The summary reports them in this order, extremes first.
const QuantityTable<BearingRow, BearingPlan>& bearing_quantities() {
  static const Extent<BearingPlan> around{
      "n_phi",
      [](const BearingPlan& plan, std::size_t /*k*/) { return std::vector{plan.bearing.film.grid.n_phi}; },
      {"fields/phi"}};
  static const std::string of_film_heat = "this and the following: of films with `thermal: {model: film}`";
  static const std::string per_angle = "four bytes a number";
  static const std::string of_plane = "of a plane slider", of_thrust = "of a thrust bearing",
                           of_skirt = "of a piston skirt", of_flat = "of a plane slider or a thrust bearing",
                           of_ends = "of a plane slider, of pads of a thrust bearing, or of a bore of arcs";
  static const QuantityTable<BearingRow, BearingPlan> table{
      line("h_min", of_film(&Film::h_min),
           {.summary_entries = {{Statistic::smallest, "minimum film thickness (MOFT)", "µm", true},
                                {Statistic::at_end, "minimum film thickness at the end", "µm"}}}),
      line("h_min_phi", of_film(&Film::h_min_phi), {.only = is_round}),
      line("h_min_y", of_film(&Film::h_min_phi), {.note = of_plane, .only = is_plane}),
      line("h_min_z", of_film(&Film::h_min_z), {.only = has_z}),
      line("h_min_r", of_radius(&Film::h_min_z), {.note = of_thrust, .only = is_annulus}),
      line("h_min_centre", of_film(&Film::h_min_centre),
           {.summary_entries = {{Statistic::smallest, "minimum film thickness at the centreline", "µm"}}}),
      line("h_min_features", of_film(&Film::h_min_features), {.note = "only where there are any", .only = has_depth}),
      line("p_max", of_film(&Film::p_max),
           {.summary_entries = {{Statistic::largest, "peak film pressure (POFP)", "MPa", true},
                                {Statistic::at_end, "peak film pressure at the end", "MPa"}}}),
      line("p_max_phi", of_film(&Film::p_max_phi), {.only = is_round}),
      line("p_max_y", of_film(&Film::p_max_phi), {.note = of_plane, .only = is_plane}),
      line("p_max_z", of_film(&Film::p_max_z), {.only = has_z}),
      line("p_max_r", of_radius(&Film::p_max_z), {.note = of_thrust, .only = is_annulus}),
      line("p_max_node", of_film(&Film::p_max_node)),
      line("force", force_on_shell, {.summary_entries = {{Statistic::longest, "largest load", "N"}}}),
      line("force_pressure", of_film(&Film::force_pressure)),
      line("force_shear", of_film(&Film::force_shear)),
      line("force_asperity", of_film(&Film::force_asperity)),
      line("moment", moment_on_shell),
      line("eccentricity", [](const BearingRow& row) -> Eigen::Vector2d { return row.observation.position.e; },
           {.only = has_axis}),
      line("film_thickness_middle", [](const BearingRow& row) { return -row.observation.position.e[0]; },
           {.note = of_plane,
            .only = is_plane,
            .summary_entries = {{Statistic::at_end, "film thickness at the pad's middle at the end", "µm"}}}),
      line("film_thickness_axis", [](const BearingRow& row) { return row.observation.position.e[0]; },
           {.note = of_thrust,
            .only = is_annulus,
            .summary_entries = {{Statistic::at_end, "film thickness on the axis at the end", "µm"}}}),
      line("eccentricity_ratio", of_position(&bearing::GapPosition::ratio),
           {.only = has_axis,
            .summary_entries = {{Statistic::largest, "largest eccentricity ratio"},
                                {Statistic::at_end, "eccentricity ratio at the end"}}}),
      line("clearance", of_bearing(&bearing::BearingObservation::clearance),
           {.note = "of walls that expand (`thermal.expansion`); as given it is the attribute `radial_clearance`",
            .only = expands,
            .summary_entries = {{Statistic::smallest, "smallest radial clearance at temperature (hot)", "µm"},
                                {Statistic::at_end, "radial clearance at temperature (hot) at the end", "µm"}}}),
      line("bore_growth", of_bearing(&bearing::BearingObservation::bore_growth),
           {.note = "of a shell in a body (`shell: {wall: body}`)",
            .only = shell_is_in_body,
            .summary_entries = {{Statistic::at_end, "growth of the bore's radius at the end", "µm"}}}),
      line("journal_growth", of_bearing(&bearing::BearingObservation::journal_growth),
           {.note = "of a journal in a body (`journal: {wall: body}`)",
            .only = journal_is_in_body,
            .summary_entries = {{Statistic::at_end, "growth of the journal's radius at the end", "µm"}}}),
      line("clearance_of_bodies", of_bearing(&bearing::BearingObservation::clearance_of_bodies),
           {.note = "where shell or journal is in a body; as given it is the attribute `radial_clearance`",
            .only = is_in_body,
            .summary_entries =
                {{Statistic::smallest, "smallest radial clearance with what bodies have grown (hot)", "µm"},
                 {Statistic::at_end, "radial clearance with what bodies have grown (hot) at the end", "µm"}}}),
      line("attitude", attitude,
           {.note = "from the load to the line of centres",
            .only = has_axis,
            .summary_entries = {{Statistic::at_end, "attitude angle at the end", "°"}}}),
      line("tilt", of_position(&bearing::GapPosition::tilt), {.only = has_axis}),
      line("slope", of_position(&bearing::GapPosition::tilt), {.note = of_plane, .only = is_plane}),
      line("runner_tilt", of_position(&bearing::GapPosition::tilt), {.note = of_thrust, .only = is_annulus}),
      line("speed", of_position(&bearing::GapPosition::speed), {.only = has_axis}),
      line("runner_speed", of_position(&bearing::GapPosition::speed), {.note = of_thrust, .only = is_annulus}),
      line("sliding_speed", of_position(&bearing::GapPosition::speed), {.note = of_plane, .only = is_plane}),
      line("skirt_speed", of_position(&bearing::GapPosition::speed), {.note = of_skirt, .only = is_skirt}),
      line("offset_top", skirt_offset(1),
           {.note = of_skirt,
            .only = is_skirt,
            .summary_entries = {{Statistic::at_end, "offset at the skirt's top at the end", "µm"}}}),
      line("offset_bottom", skirt_offset(-1),
           {.note = of_skirt,
            .only = is_skirt,
            .summary_entries = {{Statistic::at_end, "offset at the skirt's bottom at the end", "µm"}}}),
      line("skirt_tilt", of_position(&bearing::GapPosition::tilt), {.note = of_skirt, .only = is_skirt}),
      line("side_force", skirt_side_force,
           {.note = of_skirt,
            .only = is_skirt,
            .summary_entries = {{Statistic::largest_in_size, "largest side force", "N"}}}),
      line("side_force_<side>", [](const BearingRow& row, std::size_t k) { return side_of_skirt(row, k).force; },
           {.note = of_skirt, .each = names_of_skirt_sides}),
      line("centre_<side>", [](const BearingRow& row, std::size_t k) { return side_of_skirt(row, k).centre(); },
           {.note = of_skirt, .each = names_of_skirt_sides}),
      line("h_min_<side>",
           [](const BearingRow& row, std::size_t k) { return row.observation.film.patches.at(k).h_min; },
           {.note = of_skirt,
            .each = names_of_skirt_sides,
            .summary_entries = {{Statistic::smallest, "minimum film thickness, <side> side", "µm"}}}),
      line("p_max_<side>",
           [](const BearingRow& row, std::size_t k) { return row.observation.film.patches.at(k).p_max; },
           {.note = of_skirt, .each = names_of_skirt_sides}),
      line("skirt_friction", friction_on_skirt,
           {.note = of_skirt,
            .only = is_skirt,
            .summary_entries = {{Statistic::largest_in_size, "largest friction force on the skirt", "N"}}}),
      line("skirt_friction_power",
           [](const BearingRow& row) { return row.observation.film.power_film + row.observation.film.power_asperity; },
           {.note = of_skirt,
            .only = is_skirt,
            .summary_entries = {{Statistic::mean, "mean friction power of the skirt", "W"}}}),
      line("power_film", of_film(&Film::power_film),
           {.summary_entries = {{Statistic::mean, "mean power loss in the film", "W"}}}),
      line("power_film_other_shear", of_film(&Film::power_film_other_shear),
           {.note =
                "all else being the same: over the whole gap with `film_share`, over the oil's share of it with `full`",
            .summary_entries = {{Statistic::mean, "mean power loss in the film, cavitated film sheared the other way",
                                 "W"}}}),
      line("power_asperity", of_film(&Film::power_asperity),
           {.summary_entries = {{Statistic::mean, "mean power loss in asperity contact", "W"}}}),
      line("power_stored", of_film(&Film::power_stored)),
      line("power_oil", of_film(&Film::power_oil)),
      line("power_into_bodies", of_bearing(&bearing::BearingObservation::power_into_bodies)),
      line("power_error", power_error,
           {.note = "what the bodies put in less `power_film`, `power_asperity`, `power_stored` and `power_oil`"}),
      line("torque_journal", of_film(&Film::torque_journal),
           {.only = has_axis, .summary_entries = {{Statistic::mean, "mean friction torque on the journal", "N·mm"}}}),
      line("torque_shell", of_film(&Film::torque_shell), {.only = has_axis}),
      line("torque_runner", of_film(&Film::torque_journal),
           {.note = of_thrust,
            .only = is_annulus,
            .summary_entries = {{Statistic::mean, "mean friction torque on the runner", "N·mm"}}}),
      line("torque_stator", of_film(&Film::torque_shell), {.note = of_thrust, .only = is_annulus}),
      line("flow_leading", over_end(&Film::flow_first, &Film::flow_last),
           {.note = of_ends,
            .only = has_leading_ends,
            .summary_entries = {{Statistic::mean, "mean flow out over the leading end", "mm³/s"}}}),
      line("flow_trailing", over_end(&Film::flow_last, &Film::flow_first),
           {.note = of_ends,
            .only = has_leading_ends,
            .summary_entries = {{Statistic::mean, "mean flow out over the trailing end", "mm³/s"}}}),
      line("flow_inner", of_film(&Film::flow_left),
           {.note = of_thrust,
            .only = is_annulus,
            .summary_entries = {{Statistic::mean, "mean flow out over the inner edges", "mm³/s"}}}),
      line("flow_outer", of_film(&Film::flow_right),
           {.note = of_thrust,
            .only = is_annulus,
            .summary_entries = {{Statistic::mean, "mean flow out over the outer edges", "mm³/s"}}}),
      line("flow_left", of_film(&Film::flow_left),
           {.only = has_z, .summary_entries = {{Statistic::mean, "mean side flow, left", "mm³/s"}}}),
      line("flow_right", of_film(&Film::flow_right),
           {.only = has_z, .summary_entries = {{Statistic::mean, "mean side flow, right", "mm³/s"}}}),
      line("flow_supply", of_film(&Film::flow_supply),
           {.summary_entries = {{Statistic::mean, "mean supply flow", "mm³/s"}}}),
      line("flow_feature_<name>", flow_of_feature,
           {.note = "one hole or groove; part of `flow_supply`",
            .each = feature_names,
            .summary_entries = {{Statistic::mean, "mean flow through <name>", "mm³/s"}}}),
      line("pressure_feature_<name>", [](const BearingRow& row, std::size_t k) { return feeds(row).pressure(k); },
           {.note = "of features with a `restrictor`",
            .each = restricted_names,
            .summary_entries = {{Statistic::mean, "mean pressure in <name>", "MPa"}}}),
      line("pressure_ratio_<name>", [](const BearingRow& row, std::size_t k) { return feeds(row).pressure_ratio(k); },
           {.note = "of features with a `restrictor` whose supply has a pressure", .each = names_with_supply}),
      line("pumping_power", [](const BearingRow& row) { return feeds(row).pumping_power(); },
           {.note = "only with restrictors",
            .only = has_restrictors,
            .summary_entries = {{Statistic::mean, "mean pumping power", "W"}}}),
      line("storage_rate", of_film(&Film::storage_rate)),
      line("oil_volume", of_film(&Film::oil_volume)),
      line("mass_balance_error", of_film(&Film::mass_balance_error),
           {.note = "not of `reynolds` films, which do not conserve oil",
            .only = conserves_oil,
            .summary_entries = {{Statistic::largest_in_size, "worst mass-balance error of the film"}}}),
      line("oil_through_flow", of_oil(&bearing::CumulativeOilBalance::through_flow)),
      line("oil_unexplained", of_oil(&bearing::CumulativeOilBalance::unexplained)),
      line("wear_fixed", of_wear(&Wear::fixed_depth),
           {.note = "this and the following: of bearings with `wear`",
            .only = wears,
            .summary_entries = {{Statistic::at_end, "largest wear of the fixed surface at the end", "µm"}}}),
      line("worn_volume_fixed", of_wear(&Wear::fixed_volume),
           {.only = wears,
            .summary_entries = {{Statistic::at_end, "volume worn off the fixed surface at the end", "mm³"}}}),
      line("wear_moving", of_wear(&Wear::moving_depth),
           {.only = wears,
            .summary_entries = {{Statistic::at_end, "largest wear of the moving surface at the end", "µm"}}}),
      line("worn_volume_moving", of_wear(&Wear::moving_volume),
           {.only = wears,
            .summary_entries = {{Statistic::at_end, "volume worn off the moving surface at the end", "mm³"}}}),
      line("wear_rate", of_wear(&Wear::rate), {.only = wears}),
      line("wear_error", of_wear(&Wear::acceleration_error),
           {.note = "with `wear.cycle`",
            .only = wears_by_cycles,
            .summary_entries = {{Statistic::at_end, "uncertainty of the worn volume by its acceleration", "mm³"}}}),
      line("roughness_mean", roughness_of(&Wear::roughness_mean),
           {.note = "this and the following: with `wear.running_in`",
            .only = runs_in,
            .summary_entries = {{Statistic::at_end, "mean roughness at the end", "µm"}}}),
      line("roughness_least", roughness_of(&Wear::roughness_least),
           {.only = runs_in, .summary_entries = {{Statistic::at_end, "smallest roughness at the end", "µm"}}}),
      line("cavitated_share", of_film(&Film::cavitated_share)),
      line("starved_share", of_film(&Film::starved_share),
           {.note = "of a piston skirt with layers of `oil` on its liner",
            .only = meets_layers,
            .summary_entries = {{Statistic::mean, "mean starved share of the skirt's area"},
                                {Statistic::largest, "largest starved share of the skirt's area"}}}),
      line("flow_scraped", of_film(&Film::flow_scraped),
           {.note = "likewise",
            .only = meets_layers,
            .summary_entries = {{Statistic::mean, "mean flow of oil scraped off the liner", "mm³/s"}}}),
      line("rupture_angle", of_film(&Film::rupture_angle),
           {.note = "with the flow, of its widest cavity", .only = is_round}),
      line("reformation_angle", of_film(&Film::reformation_angle), {.only = is_round}),
      line("rupture_y", of_film(&Film::rupture_angle), {.note = of_plane, .only = is_plane}),
      line("reformation_y", of_film(&Film::reformation_angle), {.note = of_plane, .only = is_plane}),
      line("T_max", celsius(&Heat::T_max),
           {.note = of_film_heat,
            .only = has_heat,
            .summary_entries = {{Statistic::largest, "hottest oil", "°C", true},
                                {Statistic::at_end, "hottest oil at the end", "°C"}}}),
      line("T_max_phi", of_heat(&Heat::T_max_phi), {.only = is_warm_round}),
      line("T_max_y", of_heat(&Heat::T_max_phi), {.note = of_plane, .only = is_warm_plane}),
      line("T_max_z", of_heat(&Heat::T_max_z), {.note = "of films that are no annulus", .only = is_warm_with_z}),
      line("T_max_r", [](const BearingRow& row) { return row.radius + row.observation.heat->T_max_z; },
           {.note = of_thrust, .only = is_warm_annulus}),
      line("T_shell_max", celsius(&Heat::T_shell_max),
           {.only = is_warm_bore, .summary_entries = {{Statistic::largest, "hottest place of the shell", "°C"}}}),
      line("T_shell_mean", celsius(&Heat::T_shell_mean), {.only = is_warm_bore}),
      line("T_journal", celsius(&Heat::T_journal),
           {.only = is_warm_bore,
            .summary_entries = {{Statistic::at_end, "temperature of the journal at the end", "°C"}}}),
      line("T_face_max", celsius(&Heat::T_shell_max),
           {.note = of_flat,
            .only = is_warm_flat,
            .summary_entries = {{Statistic::largest, "hottest place of the pads' faces", "°C"}}}),
      line("T_face_mean", celsius(&Heat::T_shell_mean), {.note = of_flat, .only = is_warm_flat}),
      line("T_runner", celsius(&Heat::T_journal),
           {.note = of_flat,
            .only = is_warm_flat,
            .summary_entries = {{Statistic::at_end, "temperature of the runner at the end", "°C"}}}),
      line("T_body_max", celsius(&Heat::T_body_max),
           {.only = shell_is_in_body,
            .summary_entries = {{Statistic::at_end, "hottest place of the shell's body at the end", "°C"}}}),
      line("T_journal_body_max", celsius(&Heat::T_journal_body_max),
           {.only = journal_is_in_body,
            .summary_entries = {{Statistic::at_end, "hottest place of the journal's body at the end", "°C"}}}),
      line("T_film", celsius(&Heat::T_film_mean), {.only = has_heat}),
      line("T_side", celsius(&Heat::T_side),
           {.only = has_heat,
            .summary_entries = {{Statistic::at_end, "temperature of the side flow at the end", "°C"}}}),
      line("T_supply_<name>", supply_temperature,
           {.note = "the line, or one hole or groove", .only = has_heat, .each = supply_names}),
      line("heat_dissipated", of_heat_balance(&film::HeatBalance::power), {.only = has_heat}),
      line("heat_to_oil", of_heat_balance(&film::HeatBalance::to_oil),
           {.only = has_heat, .summary_entries = {{Statistic::mean, "mean heat carried away by the oil", "W"}}}),
      line("heat_to_shell", of_heat_balance(&film::HeatBalance::to_shell),
           {.only = is_warm_bore, .summary_entries = {{Statistic::mean, "mean heat into the shell", "W"}}}),
      line("heat_to_journal", of_heat_balance(&film::HeatBalance::to_journal),
           {.only = is_warm_bore, .summary_entries = {{Statistic::mean, "mean heat into the journal", "W"}}}),
      line("heat_to_pads", of_heat_balance(&film::HeatBalance::to_shell),
           {.note = of_flat,
            .only = is_warm_flat,
            .summary_entries = {{Statistic::mean, "mean heat into the pads", "W"}}}),
      line("heat_to_runner", of_heat_balance(&film::HeatBalance::to_journal),
           {.note = of_flat,
            .only = is_warm_flat,
            .summary_entries = {{Statistic::mean, "mean heat into the runner", "W"}}}),
      line("heat_stored", of_heat_balance(&film::HeatBalance::stored), {.only = has_heat}),
      line("heat_balance_error", [](const BearingRow& row) { return row.observation.heat->balance.error(); },
           {.only = has_heat,
            .summary_entries = {{Statistic::largest_in_size, "worst error of the film's heat balance"}}}),
      line("reynolds_max", of_film(&Film::reynolds_max),
           {.summary_entries = {{Statistic::largest, "largest Reynolds number of the film"}}}),
      line("taylor_max", of_film(&Film::taylor_max), {.only = has_axis}),
      line("laminar_share", of_film(&Film::laminar_share),
           {.summary_entries = {{Statistic::smallest, "smallest laminar share of the film's area"}}}),
      line("transition_share", of_film(&Film::transition_share)),
      line("turbulent_share", of_film(&Film::turbulent_share),
           {.summary_entries = {{Statistic::largest, "largest fully turbulent share of the film's area"}}}),
      line("film_iterations", of_bearing(&bearing::BearingObservation::film_iterations)),
      line("exchanges", of_bearing(&bearing::BearingObservation::exchanges),
           {.note = "of a partitioned coupling", .only = is_partitioned}),
      line("h_min_around", h_min_around,
           {.note = per_angle, .only = is_round, .extent = around, .precision = results::Precision::float32}),
      line("p_max_around", p_max_around,
           {.note = per_angle, .only = is_round, .extent = around, .precision = results::Precision::float32}),
  };
  return table;
}

/// The lines of film_fields() as series.
const QuantityTable<FilmInstant, BearingPlan>& film_field_quantities() {
  static const QuantityTable<FilmInstant, BearingPlan> table = [] {
    const Extent<BearingPlan> nodes{"n_phi, n_z",
                                    [](const BearingPlan& plan, std::size_t /*k*/) {
                                      const film::Grid& grid = plan.bearing.film.grid;
                                      return std::vector{grid.n_phi, grid.n_z};
                                    },
                                    {"fields/phi", "fields/z"},
                                    [](const BearingPlan& plan) {
                                      return std::vector<std::string>{is_plane(plan) ? "fields/y" : "fields/phi",
                                                                      is_annulus(plan) ? "fields/r" : "fields/z"};
                                    }};
    QuantityTable<FilmInstant, BearingPlan> lines{{"fields/time", "s", "time of the fields", &FilmInstant::t}};
    for (const FilmField& field : film_fields())
      lines.push_back({"fields/" + field.name,
                       field.unit,
                       field.text,
                       [&field](const FilmInstant& instant) { return field.values(instant.fields); },
                       {.symbol = field.symbol,
                        .note = field.note,
                        .only = [&field](const BearingPlan& plan) { return field.values(plan.start).size() > 0; },
                        .extent = nodes}});
    return lines;
  }();
  return table;
}

/// Positions of the rows of nodes [m].
std::vector<double> rows_of_nodes(const BearingPlan& plan) {
  const Eigen::VectorXd rows = bearing::coordinate_across(plan.bearing.film).values;
  return {rows.begin(), rows.end()};
}

/// Positions of the nodes: the dimensions of all fields.
const std::vector<Constant<BearingPlan>>& film_nodes() {
  static const std::vector<Constant<BearingPlan>> table{
      {"fields/phi",
       "rad",
       "bearing angle of the nodes",
       "[n_phi]",
       [](const BearingPlan& plan) {
         const film::Grid& grid = plan.bearing.film.grid;
         std::vector<double> phi(static_cast<std::size_t>(grid.n_phi));
         for (int i = 0; i < grid.n_phi; ++i) phi[static_cast<std::size_t>(i)] = grid.phi(i);
         return phi;
       },
       {},
       {.only = is_round}},
      {"fields/y",
       "m",
       "position of the nodes along the sliding direction",
       "[n_phi]",
       [](const BearingPlan& plan) {
         const film::FilmModel& film = plan.bearing.film;
         std::vector<double> y(static_cast<std::size_t>(film.grid.n_phi));
         for (int i = 0; i < film.grid.n_phi; ++i) y[static_cast<std::size_t>(i)] = film.R * film.grid.phi(i);
         return y;
       },
       {},
       {.note = "of a plane slider", .only = is_plane}},
      {"fields/arc",
       "1",
       "number of the arc or pad on which the nodes lie, from 0",
       "[n_phi]",
       [](const BearingPlan& plan) { return film::arc_of_lines(plan.bearing.film.grid); },
       {},
       {.note = "of a bore of arcs, of pads of a thrust bearing, or of a skirt",
        .only = [](const BearingPlan& plan) { return is_round(plan) && has_ends(plan); }}},
      {"fields/z", "m", "axial position of the nodes", "[n_z]", rows_of_nodes, {}, {.only = has_z}},
      {"fields/r",
       "m",
       "radius of the nodes",
       "[n_z]",
       rows_of_nodes,
       {},
       {.note = "of a thrust bearing", .only = is_annulus}},
  };
  return table;
}

/// Assumptions that decide the results of this bearing.
std::vector<std::pair<std::string, std::string>> own_assumptions(const BearingPlan& plan) {
  std::vector<std::pair<std::string, std::string>> own;
  const std::string prefix = plan.bearing.name + ": ";
  for (const auto& [name, text] : assumptions(plan.model))
    if (name.starts_with(prefix)) own.emplace_back(name.substr(prefix.size()), text);
  return own;
}

const std::vector<Attribute<BearingPlan>>& bearing_attributes() {
  const auto of_model = [](auto member) {
    return [member](const BearingPlan& plan) { return std::invoke(member, plan.bearing.film); };
  };
  const auto names = [](const BearingPlan& plan) {
    std::vector<std::string> all;
    for (const auto& [name, text] : own_assumptions(plan)) all.push_back(name);
    return all;
  };
  static const std::vector<Attribute<BearingPlan>> table{
      {"radius", "m", "of the bore", of_model(&film::FilmModel::R), {.symbol = "R", .only = is_cylindrical}},
      {"length",
       "m",
       "of the pad along the sliding direction",
       [](const BearingPlan& plan) {
         const film::FilmModel& film = plan.bearing.film;
         return film.R * (film.grid.phi(film.grid.n_phi - 1) - film.grid.phi(0));
       },
       {.symbol = "B", .note = "of a plane slider", .only = is_plane}},
      {"mean_radius",
       "m",
       "of the pads",
       of_model(&film::FilmModel::R),
       {.note = "of a thrust bearing", .only = is_annulus}},
      {"width", "m", "of the bearing", of_model(&film::FilmModel::L), {.symbol = "L"}},
      {"radial_clearance",
       "m",
       "of the bearing, as given (cold)",
       of_model(&film::FilmModel::c),
       {.symbol = "c", .only = is_cylindrical}},
      {"n_phi", "1", "nodes around", [](const BearingPlan& plan) { return plan.bearing.film.grid.n_phi; }},
      {"n_z", "1", "nodes along", [](const BearingPlan& plan) { return plan.bearing.film.grid.n_z; }},
      {"<assumption>",
       "",
       "what decides the results of this bearing",
       [](const BearingPlan& plan, std::size_t k) { return own_assumptions(plan)[k].second; },
       {.note = "its rows of `/assumptions`", .each = names}},
  };
  return table;
}

std::string group_of(const model::Bearing& bearing) { return "/bearings/" + bearing.name + "/"; }

/// Constants are written first, because series name the nodes as their dimensions.
const BearingPlan& written(const BearingPlan& plan, results::Writer& writer) {
  write_once(bearing_attributes(), group_of(plan.bearing), plan, writer);
  write_once(film_nodes(), group_of(plan.bearing), plan, writer);
  return plan;
}

}  // namespace

void write_bearing_plan(const model::Model& model, const model::Bearing& bearing, results::Writer& writer) {
  (void)written(BearingPlan{model, bearing, {}}, writer);
}

BearingRecord::BearingRecord(const BearingPlan& plan, const bearing::FilmForce& film, results::Writer& writer)
    : film_(film),
      is_forward_(plan.bearing.kind->is_forward()),
      rows_(bearing_quantities(), group_of(plan.bearing), written(plan, writer), writer),
      fields_(film_field_quantities(), group_of(plan.bearing), plan, writer) {}

std::vector<QuantityGroup> BearingRecord::describe() {
  QuantityGroup figures{.path = "/bearings/<b>/", .heading = "of a bearing", .quantities = {}};
  run::describe(bearing_attributes(), "n", figures);
  describe_link(figures);
  run::describe(bearing_quantities(), "n", figures);
  run::describe(film_nodes(), "m", figures);
  run::describe(film_field_quantities(), "m", figures);
  return {figures, CycleMaps::describe()};
}

}  // namespace hersey::run
