#include "rotor_results.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
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

/// Series over the speeds, with what each gets at one of them.
class RotorFile {
 public:
  RotorFile(const RotorFindings& found, const std::string& model, const std::filesystem::path& path)
      : writer_(path, {.overwrite = true}) {
    for (const Solved& at : found.rotor) {
      if (!at.state.solved()) continue;
      solved_.push_back(&at);
      modes_ = std::max(modes_, at.modes.size());
    }
    writer_.attribute("/", "kind", "rotor over its speeds");
    writer_.attribute("/", "model", model);
    if (solved_.empty()) return;
    first_ = solved_.front();
    declare_speeds();
    if (modes_ > 0) declare_modes();
    declare_bearings();
    if (first_->response) declare_response();
    add_criticals(found);
  }

  void write() {
    for (const Solved* at : solved_)
      for (const auto& [series, row] : series_) series.append(row(*at));
    writer_.finish(results::Status::completed);
  }

 private:
  void declare_speeds() {
    const run::RotorState& rotor = first_->state;
    add(writer_.series("/speed", 1, "rad/s", "of the shaft, its magnitude"),
        [](const Solved& at) { return Row{at.state.speed}; });
    add(writer_.series("/sense", 1, "1", "1: rotates from x to y; -1: from y to x"),
        [](const Solved& at) { return Row{static_cast<double>(at.state.sense)}; });
    std::vector<std::string> names;
    Row along;
    for (const run::RotorStation& station : rotor.stations)
      names.push_back(station.name), along.push_back(station.along);
    writer_.labels("/station", names, "points of the shaft's axis");
    writer_.constant("/along", along, "m", "positions of the stations along the axis", "/station");
    writer_.labels("/direction", {rotor.x_name, rotor.y_name}, "directions across the axis: axes of the ground");
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
      const std::size_t stations = first_->state.stations.size();
      add(writer_.field(std::string("/modes/") + name, {static_cast<int>(modes_), static_cast<int>(stations)}, "1",
                        text, {"/modes/mode", "/station"}),
          [this, stations, part = std::move(part)](const Solved& at) {
            Row row(modes_ * stations, kNone);
            for (std::size_t k = 0; k < at.modes.size(); ++k)
              for (std::size_t s = 0; s < stations; ++s) row[k * stations + s] = part(at.modes[k].orbits[s]);
            return row;
          });
    };
    shape("x_real", "motion of the stations along x, the largest axis 1: Re(x exp(i omega t))",
          [](const run::Orbit& orbit) { return orbit.x.real(); });
    shape("x_imaginary", "its imaginary part", [](const run::Orbit& orbit) { return orbit.x.imag(); });
    shape("y_real", "the same along y", [](const run::Orbit& orbit) { return orbit.y.real(); });
    shape("y_imaginary", "its imaginary part", [](const run::Orbit& orbit) { return orbit.y.imag(); });
  }

  void declare_bearings() {
    for (std::size_t b = 0; b < first_->state.bearings.size(); ++b) {
      const std::string group = "/bearings/" + first_->state.bearings[b].name + "/";
      const auto matrix = [&](const char* name, const char* unit, const char* text,
                              Eigen::Matrix2d run::RotorBearing::*part) {
        add(writer_.field(group + name, {2, 2}, unit, text, {"/direction", "/direction"}), [b, part](const Solved& at) {
          const Eigen::Matrix2d& A = at.state.bearings[b].*part;
          return Row{A(0, 0), A(0, 1), A(1, 0), A(1, 1)};
        });
      };
      matrix("stiffness", "N/m", "-d(force on the shaft)/d(displacement)", &run::RotorBearing::stiffness);
      matrix("damping", "N.s/m", "-d(force on the shaft)/d(velocity)", &run::RotorBearing::damping);
      matrix("inertia", "kg", "-d(force on the shaft)/d(acceleration)", &run::RotorBearing::inertia);
      add(writer_.series(group + "static_force", 2, "N", "on the shaft in steady motion", results::Precision::float64,
                         "/direction"),
          [b](const Solved& at) {
            const Eigen::Vector2d& force = at.state.bearings[b].force;
            return Row{force[0], force[1]};
          });
    }
  }

  void declare_response() {
    const auto part = [&](const char* name, const char* text, std::function<double(const run::Orbit&)> value) {
      const std::size_t stations = first_->state.stations.size();
      add(writer_.series(std::string("/unbalance/") + name, static_cast<int>(stations), "m", text,
                         results::Precision::float64, "/station"),
          [stations, value = std::move(value)](const Solved& at) {
            Row row(stations, kNone);
            for (std::size_t s = 0; at.response && s < stations; ++s) row[s] = value(at.response->stations[s]);
            return row;
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

  void add(results::Series series, std::function<Row(const Solved&)> row) {
    series_.emplace_back(series, std::move(row));
  }

  results::Writer writer_;
  std::vector<const Solved*> solved_;
  const Solved* first_ = nullptr;
  std::size_t modes_ = 0;  // most at any speed
  std::vector<std::pair<results::Series, std::function<Row(const Solved&)>>> series_;
};

}  // namespace

void write_rotor_results(const RotorFindings& found, const std::string& model, const std::filesystem::path& path) {
  RotorFile(found, model, path).write();
}

}  // namespace hersey::cli
