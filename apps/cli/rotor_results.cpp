#include "rotor_results.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hersey/results/writer.h"

namespace hersey::cli {
namespace {

using Solved = study::RotorAtSpeed;
using Row = std::vector<double>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Whirl as the number of its word.
const std::vector<std::pair<run::Whirl, std::string>>& whirls() {
  static const std::vector<std::pair<run::Whirl, std::string>> all{
      {run::Whirl::forward, "forward"}, {run::Whirl::backward, "backward"}, {run::Whirl::mixed, "mixed"},
      {run::Whirl::planar, "planar"},   {run::Whirl::none, "none"},         {run::Whirl::diverging, "diverges"}};
  return all;
}

double number_of_whirl(run::Whirl whirl) {
  const auto found =
      std::find_if(whirls().begin(), whirls().end(), [&](const auto& entry) { return entry.first == whirl; });
  return static_cast<double>(found - whirls().begin());
}

/// Names of the stations or bearings of all speeds: a sweep may change how many there are.
template <class Item, class Use>
void each_new_name(const std::vector<const Solved*>& solved, std::vector<Item> run::RotorState::*items, Use use) {
  std::vector<std::string> known;
  for (const Solved* at : solved)
    for (const Item& item : at->state.*items) {
      if (std::find(known.begin(), known.end(), item.name) != known.end()) continue;
      known.push_back(item.name);
      use(item);
    }
}

/// Series over the speeds, with what each gets at one of them.
class RotorFile {
 public:
  RotorFile(const RotorFindings& found, const std::string& model, const std::filesystem::path& path)
      : writer_(path, {.overwrite = true}) {
    for (const Solved& at : found.rotor) {
      if (!at.state.solved()) {
        unsolved_ += (unsolved_.empty() ? "" : "; ") + at.label + (at.label.empty() ? "" : ": ") + at.state.message;
        continue;
      }
      solved_.push_back(&at);
      modes_ = std::max(modes_, at.modes.size());
    }
    writer_.attribute("/", "kind", "rotor over its speeds");
    writer_.attribute("/", "model", model);
    if (solved_.empty()) return;
    first_ = solved_.front();
    declare_speeds();
    declare_parameters();
    if (modes_ > 0) declare_modes();
    declare_bearings();
    if (first_->response) declare_response();
    add_criticals(found);
  }

  void write() {
    for (const Solved* at : solved_)
      for (const auto& [series, row] : series_) series.append(row(*at));
    writer_.finish(unsolved_.empty() ? results::Status::completed : results::Status::failed, unsolved_);
  }

 private:
  void declare_speeds() {
    add(writer_.series("/speed", 1, "rad/s", "of the shaft, its magnitude"),
        [](const Solved& at) { return Row{at.state.speed}; });
    add(writer_.series("/sense", 1, "1", "1: rotates from x to y; -1: from y to x"),
        [](const Solved& at) { return Row{static_cast<double>(at.state.sense)}; });
    each_new_name(solved_, &run::RotorState::stations,
                  [&](const run::RotorStation& station) { stations_.push_back(station.name); });
    writer_.labels("/station", stations_, "points of the shaft's axis");
    Row along = positions(*first_);
    for (const Solved* at : solved_) {
      const Row other = positions(*at);
      for (std::size_t s = 0; s < along.size(); ++s)
        if (!(std::abs(other[s] - along[s]) <= 1e-9)) along[s] = kNone;  // m: round-off
    }
    writer_.constant("/along", along, "m", "positions of the stations along the axis; NaN: not the same in all rows",
                     "/station");
    add(writer_.series("/station_along", static_cast<int>(stations_.size()), "m", "the same in each row",
                       results::Precision::float64, "/station"),
        [this](const Solved& at) { return positions(at); });
    writer_.labels("/direction", {first_->state.x_name, first_->state.y_name},
                   "directions across the axis: axes of the ground");
    writer_.labels("/force_direction", {first_->state.x_name, first_->state.y_name},
                   "the same of the force where a matrix has two directions");
  }

  /// What the sweep varies beside the speed, so that rows of one speed differ; words have no series. (In a
  /// group of their own a parameter `speed` would take the name of the rows' dimension.)
  void declare_parameters() {
    for (std::size_t k = 0; k < first_->values.size(); ++k) {
      const model::StudyValue& value = first_->values[k];
      const bool ends_as_number =
          !value.text.empty() && std::isdigit(static_cast<unsigned char>(value.text.back())) != 0;
      if (value.unit.empty() && value.number == 0 && !ends_as_number) continue;
      add(writer_.series("/swept_" + value.name, 1, value.unit.empty() ? "1" : value.unit,
                         "value of the sweep, in its unit"),
          [k](const Solved& at) { return Row{at.values[k].number}; });
    }
  }

  void declare_modes() {
    Row number(modes_);
    for (std::size_t k = 0; k < modes_; ++k) number[k] = static_cast<double>(k);
    writer_.constant("/modes/mode", number, "1",
                     "modes by ascending damped frequency at each speed; NaN: there is none");
    const auto of_modes = [&](const char* name, const char* unit, const char* text,
                              std::function<double(const Solved&, std::size_t)> value) {
      add(writer_.series(std::string("/modes/") + name, static_cast<int>(modes_), unit, text,
                         results::Precision::float64, "/modes/mode"),
          [this, value = std::move(value)](const Solved& at) {
            Row row(modes_, kNone);
            for (std::size_t k = 0; k < at.modes.size(); ++k) row[k] = value(at, k);
            return row;
          });
    };
    of_modes("damped_frequency", "Hz", "frequency of the damped motion",
             [](const Solved& at, std::size_t k) { return at.modes[k].mode.damped_frequency; });
    of_modes("log_decrement", "1", "2 pi zeta/sqrt(1 - zeta^2); negative: the motion grows",
             [](const Solved& at, std::size_t k) { return at.modes[k].log_decrement; });
    of_modes("track", "1", "the same number at another speed is the same mode",
             [](const Solved& at, std::size_t k) { return static_cast<double>(at.tracks[k]); });
    of_modes("whirl", "1", "number of a word of the attribute `words`",
             [](const Solved& at, std::size_t k) { return number_of_whirl(at.modes[k].whirl); });
    std::vector<std::string> words;
    for (const auto& [whirl, word] : whirls()) words.push_back(word);
    writer_.attribute("/modes/whirl", "words", words);
    const auto shape = [&](const char* name, const char* text, std::function<double(const run::Orbit&)> part) {
      add(writer_.field(std::string("/modes/") + name, {static_cast<int>(modes_), static_cast<int>(stations_.size())},
                        "1", text, {"/modes/mode", "/station"}),
          [this, part = std::move(part)](const Solved& at) {
            Row all;
            for (std::size_t k = 0; k < modes_; ++k) {
              const Row row = k < at.modes.size() ? along_axis(at, at.modes[k].orbits, part) : none_along_axis();
              all.insert(all.end(), row.begin(), row.end());
            }
            return all;
          });
    };
    shape("x_real", "motion of the stations along x, the largest axis 1: Re(x exp(i omega t))",
          [](const run::Orbit& orbit) { return orbit.x.real(); });
    shape("x_imaginary", "its imaginary part", [](const run::Orbit& orbit) { return orbit.x.imag(); });
    shape("y_real", "the same along y", [](const run::Orbit& orbit) { return orbit.y.real(); });
    shape("y_imaginary", "its imaginary part", [](const run::Orbit& orbit) { return orbit.y.imag(); });
  }

  void declare_bearings() {
    each_new_name(solved_, &run::RotorState::bearings, [&](const run::RotorBearing& of_name) {
      const std::string name_of_bearing = of_name.name, group = "/bearings/" + name_of_bearing + "/";
      const auto matrix = [&](const char* name, const char* unit, const char* text,
                              Eigen::Matrix2d run::RotorBearing::*part) {
        add(writer_.field(group + name, {2, 2}, unit, text, {"/force_direction", "/direction"}),
            [name_of_bearing, part](const Solved& at) {
              const run::RotorBearing* bearing = bearing_called(at, name_of_bearing);
              if (bearing == nullptr) return Row(4, kNone);
              const Eigen::Matrix2d& A = bearing->*part;
              return Row{A(0, 0), A(0, 1), A(1, 0), A(1, 1)};
            });
      };
      matrix("stiffness", "N/m", "-d(force on the shaft)/d(displacement)", &run::RotorBearing::stiffness);
      matrix("damping", "N.s/m", "-d(force on the shaft)/d(velocity)", &run::RotorBearing::damping);
      matrix("inertia", "kg", "-d(force on the shaft)/d(acceleration)", &run::RotorBearing::inertia);
      add(writer_.series(group + "static_force", 2, "N", "on the shaft in steady motion", results::Precision::float64,
                         "/force_direction"),
          [name_of_bearing](const Solved& at) {
            const run::RotorBearing* bearing = bearing_called(at, name_of_bearing);
            return bearing == nullptr ? Row(2, kNone) : Row{bearing->force[0], bearing->force[1]};
          });
    });
  }

  void declare_response() {
    const auto part = [&](const char* name, const char* text, std::function<double(const run::Orbit&)> value) {
      add(writer_.series(std::string("/unbalance/") + name, static_cast<int>(stations_.size()), "m", text,
                         results::Precision::float64, "/station"),
          [this, value = std::move(value)](const Solved& at) {
            return at.response ? along_axis(at, at.response->stations, value) : none_along_axis();
          });
    };
    part("x_real", "answer to the unbalances along x, Re(x exp(i omega t)); a mark at phase zero passes x at t = 0",
         [](const run::Orbit& orbit) { return orbit.x.real(); });
    part("x_imaginary", "its imaginary part", [](const run::Orbit& orbit) { return orbit.x.imag(); });
    part("y_real", "the same along y", [](const run::Orbit& orbit) { return orbit.y.real(); });
    part("y_imaginary", "its imaginary part", [](const run::Orbit& orbit) { return orbit.y.imag(); });
    part("major_axis", "half of the orbit's longest diameter", [](const run::Orbit& orbit) { return orbit.major(); });
  }

  void add_criticals(const RotorFindings& found) {
    if (found.criticals.empty()) return;
    Row speed, decrement, track;
    for (const study::DampedCriticalSpeed& critical : found.criticals) {
      speed.push_back(critical.speed);
      decrement.push_back(critical.log_decrement);
      track.push_back(static_cast<double>(critical.track));
    }
    writer_.constant("/critical_speeds/critical_speed", speed, "rad/s", "where a damped frequency equals the speed");
    const char* dimension = "/critical_speeds/critical_speed";
    writer_.constant("/critical_speeds/log_decrement", decrement, "1", "of the mode there", dimension);
    writer_.constant("/critical_speeds/track", track, "1", "which mode it is", dimension);
  }

  [[nodiscard]] Row none_along_axis() const { return Row(stations_.size(), kNone); }

  [[nodiscard]] Row positions(const Solved& at) const {
    Row row = none_along_axis();
    for (std::size_t s = 0; s < stations_.size(); ++s)
      if (const auto place = at.state.places.find(stations_[s]); place != at.state.places.end())
        row[s] = at.state.stations[place->second].along;
    return row;
  }

  /// A value at each station of the file; NaN where this speed does not have it.
  [[nodiscard]] Row along_axis(const Solved& at, const std::vector<run::Orbit>& orbits,
                               const std::function<double(const run::Orbit&)>& value) const {
    Row row = none_along_axis();
    for (std::size_t s = 0; s < stations_.size(); ++s)
      if (const auto place = at.state.places.find(stations_[s]); place != at.state.places.end())
        row[s] = value(orbits[place->second]);
    return row;
  }

  void add(results::Series series, std::function<Row(const Solved&)> row) {
    series_.emplace_back(series, std::move(row));
  }

  results::Writer writer_;
  std::vector<const Solved*> solved_;
  const Solved* first_ = nullptr;
  std::size_t modes_ = 0;  // most at any speed
  std::vector<std::string> stations_;
  std::string unsolved_;  // speeds without a row, and why
  std::vector<std::pair<results::Series, std::function<Row(const Solved&)>>> series_;
};

}  // namespace

void write_rotor_results(const RotorFindings& found, const std::string& model, const std::filesystem::path& path) {
  RotorFile(found, model, path).write();
}

}  // namespace hersey::cli
