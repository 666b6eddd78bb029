#include "hersey/study/run_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "hersey/run/quantities.h"
#include "hersey/study/bearing_study.h"

namespace hersey::study {
namespace {

using results::Array;
using results::Reader;
using run::QuantityInfo;
using run::SummaryEntry;

constexpr std::array<const char*, 5> kWays{"min", "max", "mean", "rms", "end"};
constexpr int kMostModes = 40;

std::vector<std::string> parts_of_name(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Short names of what is asked for most, for those the tables give.
const std::map<std::string, std::string>& short_names() {
  static const std::map<std::string, std::string> names{{"h_min.min", "moft"},
                                                        {"p_max.max", "pofp"},
                                                        {"force.longest", "max_force"},
                                                        {"T_max.max", "T_max"},
                                                        {"power_film.mean", "film_loss"},
                                                        {"power_asperity.mean", "asperity_loss"},
                                                        {"cycle.power_film", "cycle.film_loss"},
                                                        {"cycle.power_asperity", "cycle.asperity_loss"}};
  return names;
}

const char* suffix(SummaryEntry::Statistic statistic) {
  switch (statistic) {
    case SummaryEntry::Statistic::smallest:
      return ".min";
    case SummaryEntry::Statistic::largest:
      return ".max";
    case SummaryEntry::Statistic::largest_in_size:
      return ".peak";
    case SummaryEntry::Statistic::longest:
      return ".longest";
    case SummaryEntry::Statistic::mean:
      return ".mean";
    case SummaryEntry::Statistic::integral:
      return ".integral";
    case SummaryEntry::Statistic::at_end:
      return ".end";
  }
  return "";
}

/// "/bearings/<b>/cycles/fields/" and "moft" as "bearings.<b>." and "cycle.moft".
std::pair<std::string, std::string> name_of(const std::string& path, const QuantityInfo& quantity,
                                            SummaryEntry::Statistic statistic) {
  constexpr std::string_view of_cycles = "cycles/fields/";
  const bool is_cycle = path.ends_with(of_cycles);
  std::string group = is_cycle ? path.substr(1, path.size() - 1 - of_cycles.size()) : path.substr(1);
  std::replace(group.begin(), group.end(), '/', '.');
  std::string name = quantity.name;
  std::replace(name.begin(), name.end(), '/', '.');
  name = is_cycle ? "cycle." + name + (statistic == SummaryEntry::Statistic::at_end ? "" : suffix(statistic))
                  : name + suffix(statistic);
  const auto found = short_names().find(name);
  return {group, found != short_names().end() && group.starts_with("bearings.") ? found->second : name};
}

/// The series of a run and its times.
class Series {
 public:
  explicit Series(const Reader& reader) : reader_(reader) {
    if (reader.has("/time")) time_ = reader.read("/time").values;
  }

  [[nodiscard]] std::optional<double> value(const std::string& path, SummaryEntry::Statistic statistic) const {
    if (!reader_.has(path)) return std::nullopt;
    const Array array = reader_.read(path);
    if (array.values.empty()) return std::nullopt;
    const std::vector<double> values = statistic == SummaryEntry::Statistic::longest ? lengths(array) : array.values;
    switch (statistic) {
      case SummaryEntry::Statistic::smallest:
        return *std::min_element(values.begin(), values.end());
      case SummaryEntry::Statistic::largest:
      case SummaryEntry::Statistic::longest:
        return *std::max_element(values.begin(), values.end());
      case SummaryEntry::Statistic::largest_in_size:
        return *std::max_element(values.begin(), values.end(),
                                 [](double a, double b) { return std::abs(a) < std::abs(b); });
      case SummaryEntry::Statistic::mean:
        return integral(values) / duration();
      case SummaryEntry::Statistic::integral:
        return integral(values);
      case SummaryEntry::Statistic::at_end:
        return values.back();
    }
    return std::nullopt;
  }

  /// By the trapezoidal rule, as everywhere else.
  [[nodiscard]] double integral(const std::vector<double>& values) const {
    double sum = 0;
    for (std::size_t i = 1; i < std::min(values.size(), time_.size()); ++i)
      sum += 0.5 * (values[i] + values[i - 1]) * (time_[i] - time_[i - 1]);
    return sum;
  }

  [[nodiscard]] double duration() const { return time_.size() > 1 ? time_.back() - time_.front() : 1; }

 private:
  static std::vector<double> lengths(const Array& array) {
    const std::size_t width = array.width();
    std::vector<double> result;
    for (std::size_t i = 0; i + width <= array.values.size(); i += width) {
      double sum = 0;
      for (std::size_t k = 0; k < width; ++k) sum += array.values[i + k] * array.values[i + k];
      result.push_back(std::sqrt(sum));
    }
    return result;
  }

  const Reader& reader_;
  std::vector<double> time_;
};

std::string without_names(const std::string& pattern, const std::string& name) {
  const std::size_t from = pattern.find('<'), to = pattern.find('>');
  return from == std::string::npos ? pattern : pattern.substr(0, from) + name + pattern.substr(to + 1);
}

/// Names among `names` that match <...> of `pattern`.
std::vector<std::string> names_for(const std::string& pattern, const std::vector<std::string>& names) {
  const std::size_t from = pattern.find('<'), to = pattern.find('>');
  if (from == std::string::npos) return {""};
  const std::string before = pattern.substr(0, from), after = pattern.substr(to + 1);
  std::vector<std::string> found;
  for (const std::string& name : names)
    if (name.size() > before.size() + after.size() && name.starts_with(before) && name.ends_with(after))
      found.push_back(name.substr(before.size(), name.size() - before.size() - after.size()));
  return found;
}

void add_summary_entries(const Reader& reader, const Series& series, std::vector<RunFigure>& figures) {
  for (const run::QuantityGroup& group : run::result_quantities()) {
    const std::size_t open = group.path.find('<');
    const std::vector<std::string> things =
        open == std::string::npos ? std::vector<std::string>{""} : reader.children(group.path.substr(0, open - 1));
    for (const std::string& thing : things) {
      const std::string path = without_names(group.path, thing);
      for (const QuantityInfo& quantity : group.quantities) {
        if (quantity.kind != QuantityInfo::Kind::series) continue;
        for (const SummaryEntry& summary_entry : quantity.summary_entries) {
          const std::string parent = path.size() > 1 ? path.substr(0, path.size() - 1) : path;
          for (const std::string& name : names_for(quantity.name, reader.children(parent))) {
            const std::optional<double> value =
                series.value(path + without_names(quantity.name, name), summary_entry.statistic);
            if (!value) continue;
            const auto [in, key] = name_of(group.path, quantity, summary_entry.statistic);
            figures.push_back({without_names(in, thing) + without_names(key, name),
                               without_names(summary_entry.name, name),
                               reader.info(path + without_names(quantity.name, name)).unit, *value});
          }
        }
      }
    }
  }
}

void add_modes(const Reader& reader, std::vector<RunFigure>& figures) {
  for (const char* quantity : {"frequency", "damped_frequency", "damping_ratio"}) {
    const std::string path = std::string("/modes/fields/") + quantity;
    if (!reader.has(path)) continue;
    const Array array = reader.read(path);
    const std::size_t count = std::min<std::size_t>(array.values.size(), kMostModes);
    for (std::size_t k = 0; k < count; ++k)
      figures.push_back(
          {fmt::format("modes.{}.{}", k + 1, quantity), array.info.description, array.info.unit, array.values[k]});
  }
}

/// A series, one of its columns, and the way to one number.
struct Wanted {
  std::string path;
  int column = 0;
  std::string way;
};

std::optional<int> column_of(const std::string& text) {
  if (text.size() == 1 && text[0] >= 'x' && text[0] <= 'z') return text[0] - 'x';
  int column = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), column);
  if (error == std::errc{} && end == text.data() + text.size()) return column;
  return std::nullopt;
}

std::optional<Wanted> wanted_of(const std::string& name) {
  std::vector<std::string> parts = parts_of_name(name);
  if (parts.size() < 2 || std::find(kWays.begin(), kWays.end(), parts.back()) == kWays.end()) return std::nullopt;
  Wanted wanted;
  wanted.way = parts.back();
  parts.pop_back();
  if (parts.size() > 1) {
    if (const std::optional<int> column = column_of(parts.back())) {
      wanted.column = *column;
      parts.pop_back();
    }
  }
  for (const std::string& part : parts) wanted.path += "/" + part;
  return wanted;
}

void add_wanted(const Reader& reader, const Series& series, const std::string& name, std::vector<RunFigure>& figures) {
  const std::optional<Wanted> wanted = wanted_of(name);
  if (!wanted || std::find(reader.datasets().begin(), reader.datasets().end(), wanted->path) == reader.datasets().end())
    return;
  const Array array = reader.read(wanted->path);
  const auto column = static_cast<std::size_t>(wanted->column);
  if (array.info.is_text || column >= array.width()) return;
  std::vector<double> values;
  for (std::size_t i = column; i < array.values.size(); i += array.width()) values.push_back(array.values[i]);
  if (values.empty()) return;
  double value = values.back();
  if (wanted->way == "min") value = *std::min_element(values.begin(), values.end());
  if (wanted->way == "max") value = *std::max_element(values.begin(), values.end());
  if (wanted->way == "mean") value = series.integral(values) / series.duration();
  if (wanted->way == "rms") {
    for (double& v : values) v *= v;
    value = std::sqrt(series.integral(values) / series.duration());
  }
  figures.push_back({name, array.info.description, array.info.unit, value});
}

}  // namespace

std::vector<RunFigure> figures_of(const Reader& reader, const std::vector<std::string>& wanted) {
  const Series series(reader);
  std::vector<RunFigure> figures;
  add_summary_entries(reader, series, figures);
  add_modes(reader, figures);
  std::set<std::string> known;
  for (const RunFigure& figure : figures) known.insert(figure.key);
  for (const std::string& name : wanted)
    if (known.insert(name).second) add_wanted(reader, series, name, figures);
  return figures;
}

std::vector<std::string> run_figure_keys() {
  std::vector<std::string> keys{"modes.<number>.frequency", "modes.<number>.damped_frequency",
                                "modes.<number>.damping_ratio"};
  for (const run::QuantityGroup& group : run::result_quantities())
    for (const QuantityInfo& quantity : group.quantities)
      if (quantity.kind == QuantityInfo::Kind::series)
        for (const SummaryEntry& summary_entry : quantity.summary_entries) {
          const auto [in, key] = name_of(group.path, quantity, summary_entry.statistic);
          keys.push_back(in + key);
        }
  return keys;
}

std::vector<std::string> steady_figure_keys(const model::Model& model) {
  std::vector<std::string> keys;
  for (const model::Bearing& bearing : model.bearings)
    if (bearing.operating_point)
      for (const std::string& key : figure_keys(bearing.kind->name()))
        keys.push_back("bearings." + bearing.name + "." + key);
  for (std::string& key : keys)
    if (key.find("<ij>") != std::string::npos) key.replace(key.find("<ij>"), 4, "<name>");
  return keys;
}

namespace {

// Of every series of results files, as a name with dots: "bodies.<b>.position".
std::vector<std::string> series_patterns() {
  std::vector<std::string> patterns;
  for (const run::QuantityGroup& group : run::result_quantities())
    for (const QuantityInfo& quantity : group.quantities)
      if (quantity.kind == QuantityInfo::Kind::series) patterns.push_back((group.path + quantity.name).substr(1));
  for (std::string& pattern : patterns) std::replace(pattern.begin(), pattern.end(), '/', '.');
  return patterns;
}

bool fits(std::string_view text, std::string_view pattern) {
  const std::size_t open = pattern.find('<');
  if (open == std::string_view::npos) return text == pattern;
  if (text.substr(0, open) != pattern.substr(0, open)) return false;
  const std::string_view rest = pattern.substr(pattern.find('>') + 1);
  for (std::size_t end = open + 1; end <= text.size(); ++end) {
    if (text[end - 1] == '.') return false;
    if (fits(text.substr(end), rest)) return true;
  }
  return false;
}

}  // namespace

bool is_among(const std::string& name, const std::vector<std::string>& patterns) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) { return fits(name, pattern); });
}

bool is_of_a_series(const std::string& name) {
  const std::optional<Wanted> wanted = wanted_of(name);
  if (!wanted) return false;
  std::string path = wanted->path.substr(1);
  std::replace(path.begin(), path.end(), '/', '.');
  return is_among(path, series_patterns());
}

std::vector<std::string> series_like(const std::string& name) {
  const std::vector<std::string> given = parts_of_name(name);
  std::vector<std::string> like;
  for (const std::string& pattern : series_patterns()) {
    std::vector<std::string> parts = parts_of_name(pattern);
    if (parts.size() >= given.size() || parts.front() != given.front()) continue;
    for (std::size_t k = 0; k < given.size(); ++k) {
      if (k >= parts.size())
        parts.push_back(given[k]);
      else if (parts[k].starts_with('<'))
        parts[k] = given[k];
    }
    like.push_back(fmt::format("{}", fmt::join(parts, ".")));
  }
  return like;
}

}  // namespace hersey::study
