#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/results/writer.h"
#include "hersey/run/quantity_info.h"

/// Tables of quantities. A `Thing` is the observation of something in one row of the file; its `Plan` holds the data
/// that exist before the first row.
namespace hersey::run {

/// Shape of a row whose length depends on the plan, and the names of its columns.
template <class Plan>
struct Extent {
  std::string text = {};  ///< of the shape, "3 nodes" or "n_phi, n_z"
  /// @param k  of a family, which one
  std::function<std::vector<int>(const Plan&, std::size_t k)> shape = {};
  std::vector<std::string> dimensions = {};  ///< path relative to the thing's group, one for each number; empty: the
                                             ///< numbers themselves
  std::function<std::vector<std::string>(const Plan&)> dimensions_of = {};  ///< those of a plan; empty: `dimensions`
};

/// Properties that only some quantities have.
template <class Plan>
struct More {
  std::string symbol = {}, note = {};
  std::function<bool(const Plan&)> only = {};  ///< true if a thing has the quantity; empty: every thing has it
  Extent<Plan> extent = {};                    ///< of rows whose length their type leaves open
  results::Precision precision = results::Precision::float64;
  std::function<std::string(const Plan&)> unit = {};  ///< which, where there are several
  /// Replacements of <...> in name and text: for a family, one for each member.
  std::function<std::vector<std::string>(const Plan&)> each = {};
  std::vector<SummaryEntry> summary_entries = {};
};

/// Returns `text` with `name` in place of the part in angle brackets.
[[nodiscard]] std::string filled_in(const std::string& text, const std::string& name);

/// Path of `name` relative to `group`, which ends with "/"; each "../" before it goes up one group.
[[nodiscard]] std::string below(std::string group, std::string name);

/// Number of values in a row of type T; 0 if it depends on the plan.
template <class T>
constexpr int columns_of() {
  if constexpr (std::is_arithmetic_v<T>)
    return 1;
  else if constexpr (requires { T::SizeAtCompileTime; })
    return T::SizeAtCompileTime == Eigen::Dynamic ? 0 : static_cast<int>(T::SizeAtCompileTime);
  else
    return 0;
}

/// A line of a table: a quantity that grows by one row whenever its thing is written down.
template <class Thing, class Plan>
class Quantity {
 public:
  /// @param get  value from a thing, or for a family from thing and index: a number, a vector of fixed length, or any
  ///         row
  template <class Get>
  Quantity(const std::string& name, const std::string& unit, const std::string& text, Get get, More<Plan> more = {})
      : more_(std::move(more)) {
    constexpr bool is_family = std::is_invocable_v<Get, const Thing&, std::size_t>;
    const auto value = [get](const Thing& thing, [[maybe_unused]] std::size_t k) -> decltype(auto) {
      if constexpr (is_family)
        return std::invoke(get, thing, k);
      else
        return std::invoke(get, thing);
    };
    using Row = std::remove_cvref_t<decltype(value(std::declval<const Thing&>(), 0))>;
    columns_ = columns_of<Row>();
    HERSEY_REQUIRE((columns_ == 0) == static_cast<bool>(more_.extent.shape), "a row has one shape: " + name);
    HERSEY_REQUIRE(!is_family || more_.each, "a family has names: " + name);
    fill_in_ = [value](const Thing& thing, std::size_t k, std::span<double> row) {
      if constexpr (std::is_arithmetic_v<Row>) {
        row.front() = static_cast<double>(value(thing, k));
      } else {
        const auto& numbers = value(thing, k);
        const auto width = static_cast<std::size_t>(numbers.size());
        HERSEY_REQUIRE(width == row.size(), fmt::format("{} numbers were given, {} are due", width, row.size()));
        std::copy_n(numbers.data(), width, row.begin());
      }
    };
    const bool is_numbered = columns_ == 0 && more_.extent.dimensions.empty();
    info_ = {.name = name,
             .unit = unit,
             .text = text,
             .shape = columns_ > 1 ? std::to_string(columns_) : more_.extent.text,
             .symbol = more_.symbol,
             .note = more_.note,
             .kind = QuantityInfo::Kind::series,
             .dimensions = is_numbered ? std::vector{name + "_column"} : more_.extent.dimensions,
             .summary_entries = more_.summary_entries};
  }

  [[nodiscard]] const QuantityInfo& info() const { return info_; }
  /// The names for which it is there.
  [[nodiscard]] std::vector<std::string> names(const Plan& plan) const {
    if (more_.only && !more_.only(plan)) return {};
    return more_.each ? more_.each(plan) : std::vector<std::string>{""};
  }
  [[nodiscard]] results::Series declare(const std::string& group, const std::string& name, std::size_t k,
                                        const Plan& plan, results::Writer& writer) const {
    const std::string path = group + filled_in(info_.name, name), text = filled_in(info_.text, name);
    const std::string unit = more_.unit ? more_.unit(plan) : info_.unit;
    const std::vector<int> shape = columns_ > 0 ? std::vector<int>{columns_} : more_.extent.shape(plan, k);
    std::vector<std::string> dimensions;
    const Extent<Plan>& extent = more_.extent;
    for (const std::string& dimension : extent.dimensions_of ? extent.dimensions_of(plan) : extent.dimensions)
      dimensions.push_back(below(group, filled_in(dimension, name)));
    dimensions.resize(shape.size());
    if (shape.size() == 2) return writer.field(path, {shape[0], shape[1]}, unit, text, {dimensions[0], dimensions[1]});
    return writer.series(path, shape[0], unit, text, more_.precision, dimensions[0]);
  }
  void fill_in(const Thing& thing, std::size_t k, std::span<double> row) const { fill_in_(thing, k, row); }

 private:
  More<Plan> more_;
  int columns_ = 0;
  std::function<void(const Thing&, std::size_t, std::span<double>)> fill_in_;
  QuantityInfo info_;
};

/// A line of a table for a dataset of numbers that is written once, before the first row.
template <class Plan>
class Constant {
 public:
  /// @param dimension  of its numbers, as in results::Writer::constant; empty: it is one
  template <class Get>
  Constant(const std::string& name, const std::string& unit, const std::string& text, const std::string& shape, Get get,
           std::string_view dimension = {}, More<Plan> more = {})
      : more_(std::move(more)) {
    info_ = {.name = name,
             .unit = unit,
             .text = text,
             .shape = shape,
             .symbol = more_.symbol,
             .note = more_.note,
             .kind = QuantityInfo::Kind::constant};
    write_ = [get, dimension, unit, text](const Plan& plan, const std::string& path, results::Writer& writer) {
      const auto values = std::invoke(get, plan);
      if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(values)>>) {
        const double value = values;
        writer.constant(path, {&value, 1}, unit, text, dimension);
      } else {
        writer.constant(path, {values.data(), static_cast<std::size_t>(values.size())}, unit, text, dimension);
      }
    };
  }

  [[nodiscard]] const QuantityInfo& info() const { return info_; }
  void write(const std::string& group, const Plan& plan, results::Writer& writer) const {
    if (!more_.only || more_.only(plan)) write_(plan, group + info_.name, writer);
  }

 private:
  More<Plan> more_;
  std::function<void(const Plan&, const std::string&, results::Writer&)> write_;
  QuantityInfo info_;
};

/// A line of a table: an attribute of a thing's group, text, number or a list of texts.
template <class Plan>
class Attribute {
 public:
  /// @param get  as of a Quantity
  template <class Get>
  Attribute(const std::string& name, const std::string& unit, const std::string& text, Get get, More<Plan> more = {})
      : more_(std::move(more)) {
    info_ = {.name = name,
             .unit = unit,
             .text = text,
             .symbol = more_.symbol,
             .note = more_.note,
             .kind = QuantityInfo::Kind::attribute,
             .summary_entries = more_.summary_entries};
    write_ = [get = std::move(get)](const Plan& plan, [[maybe_unused]] std::size_t k, const std::string& object,
                                    const std::string& statistic, results::Writer& writer) {
      if constexpr (std::is_invocable_v<Get, const Plan&, std::size_t>)
        writer.attribute(object, statistic, std::invoke(get, plan, k));
      else
        writer.attribute(object, statistic, std::invoke(get, plan));
    };
  }

  [[nodiscard]] const QuantityInfo& info() const { return info_; }
  void write(const std::string& group, const Plan& plan, results::Writer& writer) const {
    if (more_.only && !more_.only(plan)) return;
    const std::string object = group.size() > 1 && group.ends_with('/') ? group.substr(0, group.size() - 1) : group;
    const std::vector<std::string> names = more_.each ? more_.each(plan) : std::vector<std::string>{""};
    for (std::size_t k = 0; k < names.size(); ++k) write_(plan, k, object, filled_in(info_.name, names[k]), writer);
  }

 private:
  More<Plan> more_;
  std::function<void(const Plan&, std::size_t, const std::string&, const std::string&, results::Writer&)> write_;
  QuantityInfo info_;
};

template <class Thing, class Plan>
using QuantityTable = std::vector<Quantity<Thing, Plan>>;

/// Writes all lines of a table of constants or attributes.
/// @param group  of the thing, ends with "/"
template <class Line, class Plan>
void write_once(const std::vector<Line>& table, const std::string& group, const Plan& plan, results::Writer& writer) {
  for (const Line& line : table) line.write(group, plan, writer);
}

/// The series of one thing in the results file.
///
/// With thousands of things of one kind, the data that every step walks through should fit into the processor's cache:
/// things with the same series share their description.
template <class Thing, class Plan>
class QuantityRows {
 public:
  /// Declares the series that the thing has.
  /// @param table  outlives this
  /// @param group  of the thing, ends with "/"
  /// @param other  rows of the same table for a thing that may have the same series
  QuantityRows(const QuantityTable<Thing, Plan>& table, const std::string& group, const Plan& plan,
               results::Writer& writer, const QuantityRows* other = nullptr) {
    std::vector<Entry> entries;
    for (const Quantity<Thing, Plan>& quantity : table) {
      const std::vector<std::string> names = quantity.names(plan);
      for (std::size_t k = 0; k < names.size(); ++k) {
        const results::Series series = quantity.declare(group, names[k], k, plan, writer);
        entries.push_back({&quantity, k, block_.width(), series.width()});
        block_.add(series);
      }
    }
    const bool is_like_other = other != nullptr && *other->entries_ == entries;
    entries_ = is_like_other ? other->entries_ : std::make_shared<const std::vector<Entry>>(std::move(entries));
  }
  /// Adds a row to each.
  void append(const Thing& thing) const {
    if (entries_->empty()) return;
    block_.append([&](std::span<double> rows) {
      for (const Entry& entry : *entries_)
        entry.quantity->fill_in(thing, entry.index, rows.subspan(entry.begin, entry.width));
    });
  }

 private:
  struct Entry {
    const Quantity<Thing, Plan>* quantity;
    std::size_t index;  ///< in a family
    std::size_t begin, width;
    bool operator==(const Entry&) const = default;
  };
  std::shared_ptr<const std::vector<Entry>> entries_;
  results::SeriesBlock block_;
};

/// Adds the descriptions of all lines of a table to `group`.
/// @param rows  name of the growing dimension of its series, "n": the first number of their shape
template <class Line>
void describe(const std::vector<Line>& table, const std::string& rows, QuantityGroup& group) {
  for (const Line& line : table) {
    QuantityInfo info = line.info();
    if (info.kind == QuantityInfo::Kind::series)
      info.shape = "[" + rows + (info.shape.empty() ? "" : ", " + info.shape) + "]";
    group.quantities.push_back(std::move(info));
  }
}

/// The member of a part: `inner` of `outer`, both pointers to members.
template <class Outer, class Inner>
[[nodiscard]] auto part(Outer outer, Inner inner) {
  return [outer, inner](const auto& thing) { return std::invoke(inner, std::invoke(outer, thing)); };
}

}  // namespace hersey::run
