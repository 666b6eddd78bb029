#include "summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "hersey/run/quantities.h"
#include "lift_off.h"
#include "run_names.h"
#include "run_up.h"

namespace hersey::report {
namespace {

using results::Array;
using results::Reader;
using run::QuantityInfo;
using run::SummaryEntry;

constexpr double degrees = 180 / std::numbers::pi;

/// What one of the units of the closing table is in SI, the name there, and how many of it are one of SI.
struct SiUnit {
  const char* unit;
  const char* name;
  double size;
  double per_si;
};

SiUnit si_of(const std::string& unit) {
  constexpr std::array<SiUnit, 14> known{{{"°C", "degC", 1, 1},
                                          {"µm", "m", 1e-6, 1e6},
                                          {"MPa", "Pa", 1e6, 1e-6},
                                          {"bar", "Pa", 1e5, 1e-5},
                                          {"N·mm", "N.m", 1e-3, 1e3},
                                          {"mm³/s", "m^3/s", 1e-9, 1e9},
                                          {"mm³", "m^3", 1e-9, 1e9},
                                          {"°", "rad", std::numbers::pi / 180, degrees},
                                          {"ms", "s", 1e-3, 1e3},
                                          {"µs", "s", 1e-6, 1e6},
                                          {"mJ", "J", 1e-3, 1e3},
                                          {"%", "", 1e-2, 1e2},
                                          {"W/mm²", "W/m^2", 1e6, 1e-6},
                                          {"rpm", "rad/s", std::numbers::pi / 30, 30 / std::numbers::pi}}};
  const auto* const found =
      std::find_if(known.begin(), known.end(), [&](const SiUnit& candidate) { return candidate.unit == unit; });
  return found == known.end() ? SiUnit{unit.c_str(), unit.c_str(), 1, 1} : *found;
}

/// Returns `text` with `name` in place of the part in angle brackets.
std::string filled_in(const std::string& text, const std::string& name) {
  const std::size_t from = text.find('<');
  return from == std::string::npos ? text : text.substr(0, from) + name + text.substr(text.find('>', from) + 1);
}

/// Builds the rows of one file; every method adds a row if the file has the numbers for it.
class Summary {
 public:
  Summary(const Reader& reader, std::string name) : reader_(reader), run_(std::move(name)) {
    if (reader.has("/time")) time_ = reader.read("/time").values;
    if (reader.has("/crank_angle")) crank_angle_ = reader.read("/crank_angle").values;
  }

  std::vector<SummaryRow> rows() {
    mode_rows();
    convergence_rows();
    multiplier_rows();
    bearing_rows();
    group_rows();
    thermal_rows();
    circuit_rows();
    contact_rows();
    force_rows();
    run_up_rows();
    run_rows();
    return std::move(rows_);
  }

 private:
  void bearing_rows() {
    using Statistic = SummaryEntry::Statistic;
    const std::vector<QuantityInfo> quantities = run::quantities_of("/bearings/<b>/");
    for (const std::string& bearing : reader_.children("/bearings")) {
      group_ = bearing;
      path_ = "/bearings/" + bearing + "/";
      add_rows(quantities, {Statistic::smallest, Statistic::largest, Statistic::longest});
      add_rows(quantities, {Statistic::mean, Statistic::integral});
      add_rows(quantities, {Statistic::at_end});
      given_clearance();
      lift_off_rows();
      add_rows(quantities, {Statistic::largest_in_size});
      film_energy_error();
      step_error_rows();
      cycle_rows();
    }
  }

  /// Adds the summary rows whose statistic is one of these.
  void add_rows(const std::vector<QuantityInfo>& quantities, std::initializer_list<SummaryEntry::Statistic> ways) {
    for (const QuantityInfo& quantity : quantities)
      for (const SummaryEntry& summary_entry : quantity.summary_entries)
        if (std::find(ways.begin(), ways.end(), summary_entry.statistic) != ways.end())
          for (const std::string& name : names_in_file(quantity.name)) {
            const std::string series = filled_in(quantity.name, name);
            const auto is_it = [&](const QuantityInfo& other) { return other.name == series; };
            // `h_min_phi` is a quantity itself, no side of `h_min_<side>`.
            if (name.empty() || std::ranges::none_of(quantities, is_it))
              add_rows(series, filled_in(summary_entry.name, name), summary_entry);
          }
  }

  void add_rows(const std::string& series, const std::string& name, const SummaryEntry& summary_entry) {
    const double factor = si_of(summary_entry.unit).per_si;
    switch (summary_entry.statistic) {
      case SummaryEntry::Statistic::smallest:
        return extreme(name, series, smallest, factor, summary_entry.unit, summary_entry.has_location);
      case SummaryEntry::Statistic::largest:
        return extreme(name, series, largest, factor, summary_entry.unit, summary_entry.has_location);
      case SummaryEntry::Statistic::largest_in_size:
        return extreme(name, series, largest_size, factor, summary_entry.unit, summary_entry.has_location);
      case SummaryEntry::Statistic::longest:
        return longest(name, series, factor, summary_entry.unit);
      case SummaryEntry::Statistic::mean:
        return mean(name, series, factor, summary_entry.unit);
      case SummaryEntry::Statistic::integral:
        return total(name, series, factor, summary_entry.unit);
      case SummaryEntry::Statistic::at_end:
        return last(name, series, factor, summary_entry.unit);
    }
  }

  /// Replacements of <...> in the names of this thing's series; one empty name if there is no <...>.
  std::vector<std::string> names_in_file(const std::string& pattern) const {
    const std::size_t from = pattern.find('<');
    if (from == std::string::npos) return {""};
    const std::string prefix = pattern.substr(0, from), suffix = pattern.substr(pattern.find('>') + 1);
    std::vector<std::string> names;
    for (const std::string& series : reader_.children(path_.substr(0, path_.size() - 1)))
      if (series.starts_with(prefix) && series.ends_with(suffix))
        names.push_back(series.substr(from, series.size() - prefix.size() - suffix.size()));
    return names;
  }

  /// Adds the errors that the steps cause in the figures, if they were estimated.
  void step_error_rows() {
    const std::string group = "/step_errors/" + group_;
    if (!reader_.has(group)) return;
    for (const QuantityInfo& quantity : run::quantities_of("/step_errors/<bearing>/")) {
      const auto error = reader_.number_attribute(group, quantity.name);
      if (!error || !std::isfinite(*error)) continue;
      for (const SummaryEntry& summary_entry : quantity.summary_entries)
        add(summary_entry.name, si_of(summary_entry.unit).per_si * *error, summary_entry.unit,
            "estimated by a run with steps twice as long");
    }
  }

  /// Losses and loads of the surfaces over the last cycle, or over the whole run where the model has none.
  void cycle_rows() {
    const std::vector<double> begin = cycle("begin"), end = cycle("end"), complete = cycle("complete");
    if (begin.empty() || begin.size() != end.size() || begin.size() != complete.size()) return;
    const bool is_cycle = complete.back() > 0;
    const std::string over = is_cycle ? ", last cycle" : "";
    const std::string when =
        is_cycle ? fmt::format("t = {:.4g} to {:.4g} ms", begin.back() * 1e3, end.back() * 1e3) : std::string{};
    const std::vector<double> contact = cycle("contact");
    const bool touches = !contact.empty() && contact.back() >= 1;  // [Pa]: else the tail of a distribution of heights
    for (const QuantityInfo& quantity : run::quantities_of("/bearings/<b>/cycles/fields/")) {
      for (const SummaryEntry& summary_entry : quantity.summary_entries) {
        if (summary_entry.only == SummaryEntry::Only::of_a_cycle && !is_cycle) continue;
        if (summary_entry.only == SummaryEntry::Only::with_contact && !touches) continue;
        const double factor = si_of(summary_entry.unit).per_si;
        if (summary_entry.statistic == SummaryEntry::Statistic::largest)
          largest_of_map(summary_entry.name + over, quantity.name, factor, summary_entry.unit);
        else if (summary_entry.has_location)
          of_cycle(summary_entry.name + over, quantity.name, factor, summary_entry.unit);
        else
          last_of(summary_entry.name + over, quantity.name, factor, summary_entry.unit, when);
      }
    }
  }

  std::vector<double> cycle(const std::string& name) const { return values("cycles/fields/" + name); }

  void last_of(const std::string& name, const std::string& series, double factor, const std::string& unit,
               const std::string& when) {
    if (const std::vector<double> all = cycle(series); !all.empty()) add(name, factor * all.back(), unit, when);
  }

  /// An extreme of the last cycle, with its own instant and location.
  void of_cycle(const std::string& name, const std::string& series, double factor, const std::string& unit) {
    const std::vector<double> all = cycle(series), t = cycle(series + "_time");
    if (all.empty() || t.size() != all.size()) return;
    std::string where = fmt::format("t = {:.4g} ms", t.back() * 1e3);
    if (const auto row = row_at(t.back())) where = instant(*row);
    add(name, factor * all.back(), unit, where + location("cycles/fields/" + series, all.size() - 1));
  }

  /// The largest value of the last cycle's map, and where.
  void largest_of_map(const std::string& name, const std::string& map, double factor, const std::string& unit) {
    const bool is_plane = reader_.has(path_ + "fields/y");
    const bool is_annulus = reader_.has(path_ + "fields/r");
    const std::vector<double> phi = values(is_plane ? "fields/y" : "fields/phi"),
                              z = values(is_annulus ? "fields/r" : "fields/z"), all = cycle(map);
    const std::size_t n = phi.size() * z.size();
    if (n == 0 || all.size() < n) return;
    const auto last = all.end() - static_cast<std::ptrdiff_t>(n), most = std::max_element(last, all.end());
    const auto k = static_cast<std::size_t>(most - last);
    add(name, factor * *most, unit,
        (is_plane ? fmt::format("y = {:.2f} mm", phi[k / z.size()] * 1e3)
                  : fmt::format("φ = {:.1f}°", phi[k / z.size()] * degrees)) +
            fmt::format(", {} = {:.2f} mm", is_annulus ? "r" : "z", z[k % z.size()] * 1e3));
  }

  /// The stored instant at time t, if there is one.
  std::optional<std::size_t> row_at(double t) const {
    const auto found = std::lower_bound(time_.begin(), time_.end(), t);
    if (found == time_.end() || *found != t) return std::nullopt;
    return static_cast<std::size_t>(found - time_.begin());
  }

  /// Adds the given clearance, in addition to the one at temperature.
  void given_clearance() {
    const auto cold = reader_.number_attribute("/bearings/" + group_, "radial_clearance");
    if (cold && (reader_.has(path_ + "clearance") || reader_.has(path_ + "clearance_of_bodies")))
      add("radial clearance as given (cold)", 1e6 * *cold, "µm");
  }

  void group_rows() {
    using Statistic = SummaryEntry::Statistic;
    for (const std::string& bearing : reader_.children("/groups")) {
      group_ = "films of " + bearing;
      path_ = "/groups/" + bearing + "/";
      add_rows(run::quantities_of("/groups/<g>/"),
               {Statistic::smallest, Statistic::largest, Statistic::mean, Statistic::at_end});
    }
  }

  void thermal_rows() {
    using Statistic = SummaryEntry::Statistic;
    if (!reader_.has("/thermal/heat_stored")) return;
    group_ = "thermal network";
    path_ = "/thermal/";
    add_rows(run::quantities_of(path_), {Statistic::largest});
    add_rows(run::quantities_of(path_), {Statistic::mean});
    add_rows(run::quantities_of(path_), {Statistic::at_end});
    add_rows(run::quantities_of(path_), {Statistic::largest_in_size});
  }

  void circuit_rows() {
    using Statistic = SummaryEntry::Statistic;
    if (!reader_.has("/circuit/balance_error")) return;
    group_ = "circuit";
    path_ = "/circuit/";
    add_rows(run::quantities_of(path_),
             {Statistic::smallest, Statistic::largest, Statistic::mean, Statistic::largest_in_size});
  }

  void contact_rows() {
    using Statistic = SummaryEntry::Statistic;
    const std::vector<QuantityInfo> quantities = run::quantities_of("/contacts/<c>/");
    for (const std::string& contact : reader_.children("/contacts")) {
      group_ = "contact " + contact;
      path_ = "/contacts/" + contact + "/";
      add_rows(quantities, {Statistic::smallest, Statistic::largest, Statistic::longest});
      add_rows(quantities, {Statistic::mean, Statistic::integral});
    }
  }

  void force_rows() {
    using Statistic = SummaryEntry::Statistic;
    const std::vector<QuantityInfo> quantities = run::quantities_of("/forces/<f>/");
    for (const std::string& force : reader_.children("/forces")) {
      path_ = "/forces/" + force + "/";
      group_ = (reader_.has(path_ + "mesh_force") ? "gear mesh " : "ring ") + force;
      add_rows(quantities, {Statistic::largest, Statistic::smallest, Statistic::largest_in_size, Statistic::mean});
    }
  }

  /// Adds the largest amplitude once a revolution of each journal and body of a run-up, with its direction, speed and
  /// phase.
  void run_up_rows() {
    const std::optional<RunUp> run_up = find_run_up(reader_);
    if (!run_up) return;
    group_ = "run-up";
    const std::vector<RunUpSignal>& all = run_up->displacements;
    for (auto first = all.begin(); first != all.end();) {
      const auto end = std::find_if(first, all.end(), [&](const RunUpSignal& s) { return s.path != first->path; });
      const auto smaller = [](const RunUpSignal& a, const RunUpSignal& b) { return a.peak().size < b.peak().size; };
      const RunUpSignal& largest = *std::max_element(first, end, smaller);
      add_peak(largest, run_up->shafts[largest.shaft].name);
      first = end;
    }
  }

  void add_peak(const RunUpSignal& displacement, const std::string& shaft) {
    const RunUpSignal::Peak peak = displacement.peak();
    const std::size_t from = displacement.path.find('/', 1) + 1;
    const std::string name = displacement.path.substr(from, displacement.path.rfind('/') - from);
    add("largest 1x amplitude, " + name, 1e6 * peak.size, "µm",
        fmt::format("along {}, {:.0f} rpm of {}, t = {:.4g} ms, lags by {:.0f}°", "xyz"[displacement.column],
                    si_of("rpm").per_si * peak.speed, shaft, 1e3 * peak.time, degrees * peak.lag));
  }

  void run_rows() {
    group_ = "run";
    path_ = "/";
    if (!time_.empty()) add("simulated time", (time_.back() - time_.front()) * 1e3, "ms");
    add("stored instants", static_cast<double>(time_.size()), "");
    mean_of_rows("mean Newton iterations per step", "solver/newton_iterations");
    newton_row();
    step_rows();
    add_rows(run::quantities_of("/"), {SummaryEntry::Statistic::largest_in_size});
    relative_power_error();
    energy_rows();
    group_ = "computing";
    if (const double wall = reader_.number_attribute("/", "wall_time").value_or(0); wall > 0) {
      add("computing time", wall, "s");
      if (!reader_.has("/timing") && every_step_is_stored())
        add("computing time per step", 1e3 * wall / static_cast<double>(time_.size() - 1), "ms");
    }
    timing_rows();
  }

  /// Adds the cost of the steps, part by part, and that of the coupling of films and bodies.
  void timing_rows() {
    const double stepping = reader_.number_attribute("/timing", "stepping").value_or(0);
    const double steps = reader_.number_attribute("/timing", "steps").value_or(0);
    if (stepping <= 0 || steps <= 0) return;
    add("computing time per step", 1e3 * stepping / steps, "ms", "without the start");
    for (const std::string& part : reader_.list_attribute("/timing", "part_names")) {
      const double seconds = reader_.number_attribute("/timing/parts", part).value_or(0);
      if (seconds > 5e-4 * stepping) add("share of computing time: " + part, 100 * seconds / stepping, "%");
    }
    for (const std::string& bearing : reader_.children("/timing/couplings")) {
      const std::string group = "/timing/couplings/" + bearing;
      const auto per_step = [&](const std::string& what, const std::string& attribute) {
        const double most = reader_.number_attribute(group, attribute + "_most").value_or(0);
        if (most == 0) return;
        add(fmt::format("median {} per step, {}", what, bearing),
            reader_.number_attribute(group, attribute + "_median").value_or(0), "",
            fmt::format("{}, at most {:g}", reader_.text_attribute(group, "scheme").value_or(""), most));
      };
      per_step("exchanges", "exchanges");
      per_step("film iterations", "film_iterations");
      if (const double steps_as_one = reader_.number_attribute(group, "steps_as_one").value_or(0); steps_as_one > 0)
        add("steps solved as one system, " + bearing, steps_as_one, "", "the exchange came to no end");
    }
  }

  /// Uses all steps if the file has their count, else the stored ones.
  void newton_row() {
    const std::string name = "median Newton iterations per step";
    const auto median = reader_.number_attribute("/timing", "newton_iterations_median");
    if (median && reader_.number_attribute("/timing", "steps").value_or(0) > 0) return add(name, *median, "");
    median_of_steps(name, "solver/newton_iterations");
  }

  void convergence_rows() {
    constexpr std::size_t most = 24;
    group_ = "cycles";
    path_ = "/cycles/fields/";
    const std::vector<double> change = values("change"), end = values("time");
    const std::size_t first = change.size() > most ? change.size() - most : 1;  // the first has none before it
    for (std::size_t i = first; i < change.size(); ++i)
      add(fmt::format("cycle {}: change from the one before", i + 1), 100 * change[i], "%",
          fmt::format("ended at t = {:.4g} s", end[i]));
    if (!change.empty()) add("cycles", static_cast<double>(change.size()), "");
    if (const std::vector<double> p_f = values("friction_mean_effective_pressure"); !p_f.empty())
      add("friction mean effective pressure of films and rings", 1e-5 * p_f.back(), "bar");
  }

  void multiplier_rows() {
    group_ = "cycles";
    path_ = "/cycles/multipliers/fields/";
    const std::vector<double> magnitude = values("magnitude"), frequency = values("frequency"),
                              growth = values("growth");
    for (std::size_t i = 0; i < magnitude.size(); ++i)
      add(fmt::format("Floquet multiplier {}", i + 1), magnitude[i], "",
          fmt::format("{} at {:.4g}/s, {:.4g} Hz{}", growth[i] > 0 ? "grows" : "decays", std::abs(growth[i]),
                      frequency[i], growth[i] > 0 ? "; unstable" : ""));
  }

  void mode_rows() {
    constexpr std::size_t most = 24;
    group_ = "modes";
    path_ = "/modes/fields/";
    const std::vector<double> natural = values("frequency"), damping = values("damping_ratio"),
                              damped = values("damped_frequency");
    for (std::size_t i = 0; i < std::min(most, natural.size()); ++i) {
      const std::string name = fmt::format("mode {}: ", i + 1);
      const bool is_damped = std::abs(damping[i]) > 1e-9;
      add(name + "natural frequency", natural[i], "Hz", is_damped ? fmt::format("damped {:.6g} Hz", damped[i]) : "");
      if (is_damped) add(name + "damping ratio", damping[i], "", damping[i] < 0 ? "unstable" : "");
    }
    if (natural.size() > most) add("modes in the results file", static_cast<double>(natural.size()), "");
  }

  [[nodiscard]] bool every_step_is_stored() const {
    const std::vector<double> dt = values("solver/dt");
    if (time_.size() < 2 || dt.size() != time_.size()) return false;
    const double span = time_.back() - time_.front();
    return std::abs(std::accumulate(dt.begin() + 1, dt.end(), 0.0) - span) < 1e-6 * span;
  }

  void step_rows() {
    std::vector<double> dt = values("solver/dt");
    if (dt.size() > 1) {
      dt.erase(dt.begin());  // the start
      const auto [least, most] = std::minmax_element(dt.begin(), dt.end());
      if (*most - *least < 1e-9 * *most) {
        add("step", 1e6 * *most, "µs");
      } else {
        add("shortest step", 1e6 * *least, "µs");
        add("longest step", 1e6 * *most, "µs");
      }
    }
    const std::vector<double> rejected = values("solver/rejected_steps"), drift = values("solver/constraint_drift");
    add_rows(run::quantities_of("/"), {SummaryEntry::Statistic::largest});
    if (!rejected.empty() && rejected.back() > 0) add("rejected steps", rejected.back(), "");
    if (!drift.empty()) add("largest constraint drift", *std::max_element(drift.begin(), drift.end()), "");
  }

  /// Adds the speeds at which the film lifts a journal off its asperities and lets it down again.
  void lift_off_rows() {
    const std::vector<double> asperities = sizes(values("force_asperity")), load = sizes(values("force"));
    std::vector<double> contact(std::min(asperities.size(), load.size()));
    for (std::size_t k = 0; k < contact.size(); ++k) contact[k] = load[k] > 0 ? asperities[k] / load[k] : 0;
    const LiftOffs found = find_lift_offs(values("speed"), contact);
    const auto row = [&](const char* name, const std::optional<LiftOff>& at) {
      if (at) add(name, si_of("rpm").per_si * at->speed, "rpm", instant(at->row));
    };
    row("lift-off speed, from where asperities carry less than 5 %", found.lift_off);
    row("touch-down speed, from where asperities carry more than 5 %", found.touch_down);
  }

  /// Returns the magnitudes of vectors with three components.
  static std::vector<double> sizes(const std::vector<double>& vectors) {
    std::vector<double> lengths;
    for (std::size_t k = 0; k + 2 < vectors.size(); k += 3)
      lengths.push_back(std::hypot(vectors[k], vectors[k + 1], vectors[k + 2]));
    return lengths;
  }

  /// Compares the energy that the bodies put into a film by its forces with the film's integrals.
  void film_energy_error() {
    const double lost = integral(values("power_film")) + integral(values("power_asperity"));
    const std::vector<double> error = values("power_error");
    if (error.empty() || lost <= 0) return;
    add("unexplained energy of the film, share of what it dissipates", 100 * integral(error) / lost, "%");
  }

  /// Adds the energy balance at the end of the run; each part is a separate integral.
  void energy_rows() {
    const auto series = [&](const std::string& name) { return values("energy/since_start/" + name); };
    const std::vector<double> put_in = series("put_in"), unexplained = series("unexplained");
    std::vector<double> lost(put_in.size());
    for (const char* part : {"film_dissipation", "boundary_friction", "contacts", "dampers"}) {
      const std::vector<double> values = series(part);
      if (values.size() != lost.size()) return;
      std::transform(lost.begin(), lost.end(), values.begin(), lost.begin(), std::plus<>());
    }
    std::vector<double> stored(put_in.size());
    for (const char* part : {"kinetic", "potential", "springs", "strain"}) {
      const std::vector<double> all = values(std::string("energy/") + part);
      for (std::size_t i = 0; i < std::min(all.size(), stored.size()); ++i) stored[i] += all[i] - all.front();
    }
    if (put_in.empty() || unexplained.size() != put_in.size()) return;
    add("energy put in by drives and loads", put_in.back(), "J");
    add("energy dissipated", lost.back(), "J");
    add("energy in bodies and springs, more than at the start", stored.back(), "J");
    add("unexplained energy", unexplained.back(), "J");
    const std::vector<double> available = series("available"), from_nowhere = series("from_nowhere");
    // Results of programs before 0.11 do not contain these energies.
    if (available.empty() || from_nowhere.empty() || !(available.back() > 0)) return;
    const double all = available.back();
    add("the same, share of the energy at the start and put in since", 100 * std::abs(unexplained.back()) / all, "%");
    add("energy from nowhere, the same share", 100 * from_nowhere.back() / all, "%");
  }

  void relative_power_error() {
    if (!reader_.has("/power/balance_error")) return;
    const auto most = [&](const std::string& name) {
      double size = 0;
      for (const double value : values("power/" + name))
        if (std::isfinite(value)) size = std::max(size, std::abs(value));
      return size;
    };
    double largest_power = 0;
    for (const std::string& name : reader_.children("/power"))
      if (name != "balance_error" && name != "unexplained") largest_power = std::max(largest_power, most(name));
    if (largest_power > 0) add("the same, share of the largest power", most("balance_error") / largest_power, "");
  }

  static bool smallest(double a, double b) { return a < b; }
  static bool largest(double a, double b) { return a > b; }
  static bool largest_size(double a, double b) { return std::abs(a) > std::abs(b); }

  std::vector<double> values(const std::string& name) const {
    return reader_.has(path_ + name) ? reader_.read(path_ + name).values : std::vector<double>{};
  }

  void add(const std::string& name, double value, const std::string& unit, const std::string& where = {}) {
    rows_.push_back({run_, group_, name, value, unit, where});
  }

  std::string instant(std::size_t row) const {
    if (row >= time_.size()) return {};
    const std::string time = fmt::format("t = {:.4g} ms", time_[row] * 1e3);
    return row < crank_angle_.size() ? time + fmt::format(", crank {:.1f}°", crank_angle_[row] * degrees) : time;
  }

  /// Adds the most extreme finite value in the sense of `before`, with its instant and, if `has_location`, its location
  /// on the film.
  template <class Before>
  void extreme(const std::string& name, const std::string& series, Before before, double factor,
               const std::string& unit, bool has_location) {
    const std::vector<double> all = values(series);
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (std::isfinite(all[k]) && (!best || before(all[k], all[*best]))) best = k;
    if (!best) return;
    add(name, all[*best] * factor, unit, instant(*best) + (has_location ? location(series, *best) : ""));
  }

  std::string location(const std::string& series, std::size_t row) const {
    const std::vector<double> phi = values(series + "_phi"), z = values(series + "_z");
    std::string text;
    if (row < phi.size()) text += fmt::format(", φ = {:.1f}°", phi[row] * degrees);
    if (const std::vector<double> y = values(series + "_y"); row < y.size())
      text += fmt::format(", y = {:.2f} mm", y[row] * 1e3);
    if (row < z.size()) text += fmt::format(", z = {:.2f} mm", z[row] * 1e3);
    if (const std::vector<double> r = values(series + "_r"); row < r.size())
      text += fmt::format(", r = {:.2f} mm", r[row] * 1e3);
    return text;
  }

  /// Adds the largest magnitude of a vector with three components.
  void longest(const std::string& name, const std::string& series, double factor, const std::string& unit) {
    const std::vector<double> force = values(series);
    double most = -1;
    std::size_t at = 0;
    for (std::size_t k = 0; 3 * k + 2 < force.size(); ++k) {
      const double size = std::hypot(force[3 * k], force[3 * k + 1], force[3 * k + 2]);
      if (size > most) {
        most = size;
        at = k;
      }
    }
    if (most >= 0) add(name, factor * most, unit, instant(at));
  }

  /// Integral over time by the trapezoidal rule: steps may differ in length.
  double integral(const std::vector<double>& all) const {
    double sum = 0;
    for (std::size_t k = 1; k < std::min(all.size(), time_.size()); ++k)
      sum += 0.5 * (all[k] + all[k - 1]) * (time_[k] - time_[k - 1]);
    return sum;
  }

  void total(const std::string& name, const std::string& series, double factor, const std::string& unit) {
    if (const std::vector<double> all = values(series); !all.empty()) add(name, factor * integral(all), unit);
  }

  void mean(const std::string& name, const std::string& series, double factor, const std::string& unit) {
    const std::vector<double> all = values(series);
    const std::size_t n = std::min(all.size(), time_.size());
    if (n == 0) return;
    const double duration = time_[n - 1] - time_[0];
    add(name, factor * (duration > 0 ? integral(all) / duration : all[n - 1]), unit);
  }

  void mean_of_rows(const std::string& name, const std::string& series) {
    const std::vector<double> all = values(series);
    if (all.empty()) return;
    double sum = 0;
    for (const double value : all) sum += value;
    add(name, sum / static_cast<double>(all.size()), "");
  }

  /// Without the first row, the start.
  void median_of_steps(const std::string& name, const std::string& series) {
    std::vector<double> all = values(series);
    if (all.size() < 2) return;
    all.erase(all.begin());
    std::sort(all.begin(), all.end());
    const std::size_t n = all.size();
    add(name, 0.5 * (all[(n - 1) / 2] + all[n / 2]), "");
  }

  void last(const std::string& name, const std::string& series, double factor, const std::string& unit) {
    if (const std::vector<double> all = values(series); !all.empty()) add(name, all.back() * factor, unit);
  }

  const Reader& reader_;
  std::string run_, group_, path_;
  std::vector<double> time_, crank_angle_;
  std::vector<SummaryRow> rows_;
};

}  // namespace

std::vector<SummaryRow> summarise(const Reader& reader, const std::string& name) {
  return Summary(reader, name).rows();
}

std::vector<SummaryRow> summary_table(const std::vector<std::filesystem::path>& results,
                                      const std::vector<std::string>& given) {
  std::vector<SummaryRow> rows;
  const std::vector<std::string> names = run_names(results, given);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::vector<SummaryRow> more = summarise(Reader(results[i]), names[i]);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

std::string summary_json(const std::vector<std::filesystem::path>& results, const std::vector<std::string>& names) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SummaryRow& row : summary_table(results, names)) {
    const SiUnit si = si_of(row.unit);
    list.push_back({{"run", row.run},
                    {"group", row.group},
                    {"name", row.name},
                    {"value", si.size * row.value},
                    {"unit", si.name},
                    {"where", row.where}});
  }
  return list.dump(2);
}

}  // namespace hersey::report
