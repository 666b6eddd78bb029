#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hersey {

/// Stored data do not fit the objects to be restored, because they come from another program or another model.
class ArchiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Named store of the history that objects keep from one step to the next: numbers, bit for bit, and texts.
/// Each object has one function that both saves and restores, so that the two cannot differ:
///
/// @code
///   void Film::persist(Archive& archive) {
///     archive.io("pressure", p_);   // stores p_, or sets it to what was stored
///     archive.io("iterations", iterations_);
///   }
/// @endcode
/// Names are paths: a Group prefixes the names inside it with its own name and a slash.
/// @verified_by archive_test.cpp
class Archive {
 public:
  /// An array: its dimensions and its numbers, stored column by column. Integers beyond 2^53 cannot be represented.
  struct Numbers {
    std::vector<std::uint64_t> shape;
    std::vector<double> values;
    friend bool operator==(const Numbers&, const Numbers&) = default;
  };

  /// All stored numbers and texts.
  struct Content {
    std::map<std::string, Numbers> numbers;
    std::map<std::string, std::string> texts;
  };

  Archive() = default;                                                                  ///< saves
  explicit Archive(Content content) : restores_(true), content_(std::move(content)) {}  ///< restores

  /// True if io() sets values to the stored ones, false if it stores them.
  [[nodiscard]] bool restores() const { return restores_; }
  /// Returns the content that has been stored, or that is being restored.
  [[nodiscard]] const Content& content() const { return content_; }

  /// Prefixes all names as long as the object exists.
  class Group {
   public:
    /// Prefixes the names that follow with `name`; a '/' in it is replaced by '|'.
    Group(Archive& archive, std::string_view name);
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;
    ~Group() { archive_.prefix_.resize(length_); }

   private:
    Archive& archive_;
    std::size_t length_;
  };

  /// Stores `value` under `name`, or sets it to what is stored there.
  /// @throws ArchiveError if nothing is stored there, or an array of another shape.
  void io(std::string_view name, double& value) { io_numbers(name, {}, &value, 1); }
  void io(std::string_view name, std::string& text);
  void io(std::string_view name, std::vector<double>& values);

  /// Stores or restores an integer or enumeration as a number; exact up to 2^53.
  template <class Integer>
  requires(std::integral<Integer> || std::is_enum_v<Integer>) void io(std::string_view name, Integer& value) {
    auto number = static_cast<double>(value);
    io(name, number);
    if (restores_) value = static_cast<Integer>(number);
  }

  /// Stores or restores a list of integers.
  template <std::integral Integer>
  void io(std::string_view name, std::vector<Integer>& values) {
    std::vector<double> numbers(values.begin(), values.end());
    io(name, numbers);
    if (!restores_) return;
    values.clear();
    for (const double number : numbers) values.push_back(static_cast<Integer>(number));
  }

  /// Stores or restores a matrix or vector, including sizes that are not fixed at compile time.
  template <class Derived>
  void io(std::string_view name, Eigen::PlainObjectBase<Derived>& matrix) {
    if (restores_) {
      const auto [rows, columns] = matrix_shape(name);
      const bool fits = (Derived::RowsAtCompileTime == Eigen::Dynamic || Derived::RowsAtCompileTime == rows) &&
                        (Derived::ColsAtCompileTime == Eigen::Dynamic || Derived::ColsAtCompileTime == columns);
      if (!fits) misfit(name);
      matrix.resize(rows, columns);
    }
    io_numbers(name, {static_cast<std::uint64_t>(matrix.rows()), static_cast<std::uint64_t>(matrix.cols())},
               matrix.data(), static_cast<std::size_t>(matrix.size()));
  }

  /// Stores or restores an optional value and whether it is present.
  template <class Value>
  void io(std::string_view name, std::optional<Value>& value) {
    bool is_there = value.has_value();
    const Group group(*this, name);
    io("is_there", is_there);
    if (!is_there) return value.reset();
    if (!value) value.emplace();
    io("value", *value);
  }

  /// Stores or restores a list and its length; `element(archive, item)` stores or restores one item.
  template <class Value, class Function>
  void each(std::string_view name, std::vector<Value>& list, Function element) {
    std::size_t size = list.size();
    const Group group(*this, name);
    io("size", size);
    list.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const Group item(*this, std::to_string(i));
      element(*this, list[i]);
    }
  }

  /// Returns the names that have not been read yet while restoring.
  [[nodiscard]] std::vector<std::string> unread() const;

 private:
  void io_numbers(std::string_view name, const std::vector<std::uint64_t>& shape, double* values, std::size_t count);
  [[nodiscard]] std::string path(std::string_view name) const { return prefix_ + std::string(name); }
  [[nodiscard]] const Numbers& stored(std::string_view name);
  [[nodiscard]] std::pair<Eigen::Index, Eigen::Index> matrix_shape(std::string_view name);
  [[noreturn]] void misfit(std::string_view name) const;

  bool restores_ = false;
  std::string prefix_;
  Content content_;
  std::set<std::string> read_;
};

}  // namespace hersey
