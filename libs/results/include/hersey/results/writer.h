#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hersey/results/error.h"

namespace hersey::results {

/// State of a run; stored as the text attribute `status` of the file.
enum class Status {
  running,    ///< under way, or killed: no one had time to write another status
  completed,  ///< reached its end
  stopped,    ///< ended early on request (Ctrl-C); everything up to then is valid
  failed,     ///< ended early without a solution; `message` gives the reason
};

/// Returns the value of the attribute, e.g. "running".
[[nodiscard]] std::string_view to_string(Status status);

struct WriterOptions {
  bool overwrite = false;       ///< replace an existing file instead of throwing FileExists
  double flush_interval = 0.5;  ///< shortest time between two writes by flush_if_due() [s], >= 0; a tenth at first
  std::size_t rows = 0;         ///< expected number of rows of the series, as far as known
  /// true: flush_if_due() writes rows to the file in a separate thread while others are added.
  bool writes_beside = false;
};

/// Kept instead of a file.
struct InMemory {
  bool keeps_all = false;  ///< attributes and constants too, see Writer::kept; texts are left out
};

/// A dataset that was written once.
struct KeptConstant {
  std::string unit, text;
  std::vector<double> values;
};

/// Attributes and constants of a writer in memory that keeps all.
struct Kept {
  using Attribute = std::variant<std::string, double, std::vector<std::string>>;
  std::map<std::string, std::map<std::string, Attribute>> attributes;  ///< by path of the object, "/" of the root
  std::map<std::string, KeptConstant> constants;                       ///< by path
};

/// A series of a writer in memory, with its last row.
struct LatestRow {
  std::string path, unit, text;    ///< "/bearings/big_end/force", "N", what it is
  std::vector<std::size_t> shape;  ///< of a row; empty: one number
  std::vector<std::string>
      components;              ///< names of a row's numbers where it has one dimension: "x", "y", "z" or "0" on
  std::vector<double> values;  ///< empty before the first row
};

/// Attribute of a series whose columns have different units, "SI": the unit of each.
inline constexpr const char* column_units = "column_units";

/// How numbers of a series are stored.
enum class Precision { float64, float32 };

class Reader;
class Writer;

/// Handle of a growing dataset, one row per append. Cheap to copy; valid as long as its Writer.
class Series {
 public:
  Series() = default;

  /// Adds one row of width() numbers, in memory until the next flush.
  /// @throws ContractError unless the row has width() numbers; WriteError once the file has failed.
  void append(std::span<const double> row) const;
  void append(double value) const { append(std::span<const double>(&value, 1)); }
  void append(std::initializer_list<double> row) const { append(std::span<const double>(row.begin(), row.size())); }
  template <int rows>
  void append(const Eigen::Matrix<double, rows, 1>& row) const {
    append(std::span<const double>(row.data(), static_cast<std::size_t>(row.size())));
  }

  [[nodiscard]] std::size_t width() const;  ///< numbers per row: columns, or rows x columns of a field

 private:
  friend class Writer;
  friend class SeriesBlock;
  Series(Writer* writer, std::size_t index) : writer_(writer), index_(index) {}
  Writer* writer_ = nullptr;
  std::size_t index_ = 0;
};

/// Series that get their rows together, so that the rows of one thing in a machine of thousands are passed in one call.
class SeriesBlock {
 public:
  /// Adds a series, declared right after the one added before. @throws ContractError where it is not
  void add(const Series& series);

  [[nodiscard]] std::size_t width() const { return width_; }  ///< numbers per row of all of them

  /// Adds one row to each, in memory until the next flush.
  /// @param fill  called with width() numbers, zeros, to be filled in series after series; throws: nothing is added
  /// @throws WriteError once the file has failed.
  template <class Fill>
  void append(Fill fill) const {
    fill(open());
    close();
  }

 private:
  [[nodiscard]] std::span<double> open() const;
  void close() const;

  Writer* writer_ = nullptr;
  std::size_t first_ = 0, count_ = 0, width_ = 0;
};

/// Writes one results file (HDF5; layout in docs/results-file.md) during the run.
///
/// Every dataset has its unit and a description, and names its dimensions by HDF5 dimension scales in its group (links
/// to one and the same dataset): h5netcdf and xarray show them. The scales' own lists of the datasets that use them,
/// which grow with the number of series, are left out.
///
/// Groups on the path of a dataset or attribute are made as needed. Declare all series before the first flush: the file
/// then keeps its structure and only grows. Rows wait in memory; a flush writes all of them to the file together, after
/// which they survive a SIGKILL of the program, and another process may read them between flushes. Space is reserved
/// before it is used, so a full disk costs the rows since the last flush and nothing else. A write error in the
/// writer's own thread is reported by the next call.
///
/// Every method but the destructor throws WriteError when the file cannot be written, and from then on again; finish()
/// and the destructor then close the file in its last good state without another exception. Not for use from two
/// threads at once. HDF5 prints no errors of its own while a method runs.
/// @verified_by writer_test.cpp, crash_test.cpp
class Writer {
 public:
  using Options = WriterOptions;

  /// Creates the file, with status "running" and the format's name and version.
  /// @throws FileExists if there is one and it is not to be overwritten; WriteError if it cannot be created.
  explicit Writer(std::filesystem::path path, Options options = {});
  /// Writes no file: declarations are kept, and the last row of each series.
  explicit Writer(InMemory);
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  /// Without a finish() before it, the status becomes failed ("ended by an error").
  ~Writer();

  /// Sets an attribute of the root "/", a group (made if absent) or an existing dataset; a second call replaces it.
  void attribute(std::string_view object, std::string_view name, std::string_view text);
  void attribute(std::string_view object, std::string_view name, const char* text) {
    attribute(object, name, std::string_view(text));
  }
  void attribute(std::string_view object, std::string_view name, double value);
  void attribute(std::string_view object, std::string_view name, int value);
  void attribute(std::string_view object, std::string_view name, const std::vector<std::string>& texts);

  /// A scalar string dataset, such as the model's text.
  void text(std::string_view path, std::string_view content, std::string_view description);

  /// A dataset [n, 2] of strings, such as the assumptions (name, text).
  void text_table(std::string_view path, const std::vector<std::pair<std::string, std::string>>& rows,
                  std::string_view description);

  /// A fixed one-dimensional dataset, such as the angles of a grid.
  /// @param dimension  as in `series`; empty: it is a dimension itself, which series and fields may name
  void constant(std::string_view path, std::span<const double> values, std::string_view unit,
                std::string_view description, std::string_view dimension = {});

  /// The dimension along x, y and z.
  static constexpr std::string_view xyz = "/xyz";

  /// A fixed list of names that serves as a dimension: the names of the columns of a series.
  void labels(std::string_view path, const std::vector<std::string>& names, std::string_view description);

  /// A growing dataset, shape [n] for columns = 1, else [n, columns]. `unit` in SI, "1" for a pure number. The first
  /// series of those that grow together is the dimension of the others' rows, as /time is.
  /// @param dimension  path of the constant or labels that describe the columns; their numbers are written there if it
  ///         does not exist; empty: x, y or x, y, z or a quaternion's w, x, y, z
  [[nodiscard]] Series series(std::string_view path, int columns, std::string_view unit, std::string_view description,
                              Precision precision = Precision::float64, std::string_view dimension = {});

  /// A growing dataset of shape [n, rows, cols]; a row is row-major, index i cols + j.
  /// @param dimensions  paths of the constants that describe rows and columns; empty: their numbers under a name made
  ///         from the field's
  [[nodiscard]] Series field(std::string_view path, std::array<int, 2> shape, std::string_view unit,
                             std::string_view description, const std::array<std::string, 2>& dimensions = {});

  /// Returns the number of rows of each series; they are flushed, and synced to the disk.
  [[nodiscard]] std::vector<std::pair<std::string, std::size_t>> rows();

  /// Copies the first rows of every series from another file with the same series, as many as `rows` states.
  /// @throws ReadError if that file has fewer rows, or other series.
  void copy_rows(const Reader& from, const std::vector<std::pair<std::string, std::size_t>>& rows);

  /// Syncs flushed data to the disk and renames the file, which continues to grow.
  /// @throws FileExists if there is a file of that name that must not be replaced.
  void rename(const std::filesystem::path& path, bool replace = true);

  void flush();  ///< puts all rows so far into the file
  void
  flush_if_due();  ///< flush(), unless the last one was less than Options::flush_interval ago; call it at every step

  /// Flushes, sets `status` and `message`, and closes the file; later calls do nothing.
  void finish(Status status, std::string_view message = {});

  /// All series of a writer in memory, in the order of their declaration; empty for a writer with a file.
  [[nodiscard]] const std::vector<LatestRow>& latest() const;
  /// Attributes and constants of a writer in memory; empty unless it keeps all.
  [[nodiscard]] const Kept& kept() const;

  /// Path of the file after the last rename; empty in memory.
  [[nodiscard]] const std::filesystem::path& path() const;

 private:
  friend class Series;
  friend class SeriesBlock;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::results
