#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hersey/fmi/description.h"
#include "hersey/fmi/fmu_file.h"

namespace hersey::fmi {

/// What an FMU has warned of: calls with the status warning, or in which it logs one.
struct Warnings {
  std::size_t count = 0;  ///< of calls
  std::string first;      ///< which call, and what was logged in it
};

/// One instance of an FMU for co-simulation, of FMI 2.0 or 3.0. It is unpacked into a private temporary folder, and its
/// library loaded; both last as long as the object. Calls follow the states of the standards (FMI 2.0.4, section 4.2.4;
/// FMI 3.0.1, section 4.2): start values, initialisation with inputs, steps; states are saved and restored at any time.
/// @throws FmuError from each function where the FMU answers with an error: which function, its status, and what the
///         FMU has logged in that call
/// @verified_by tests/fmu/import_test.py
class Instance {
 public:
  virtual ~Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// Sets the start value of a variable, of its type; before the initialisation. Whole numbers and truth values are
  /// given as numbers.
  virtual void set_start(const Variable& variable, double value) = 0;
  virtual void set_start(const Variable& variable, const std::string& text) = 0;

  /// Begins the initialisation, in which inputs are set and outputs got.
  /// @param stop  end of the simulation [s]
  virtual void enter_initialisation(double start, double stop) = 0;
  /// Ends the initialisation: steps follow.
  virtual void exit_initialisation() = 0;

  /// Sets real variables, in their own units.
  virtual void set(std::span<const unsigned> references, std::span<const double> values) = 0;
  /// Gets real variables, in their own units.
  virtual void get(std::span<const unsigned> references, std::span<double> values) = 0;

  /// Advances from `time` by `length` [s].
  virtual void step(double time, double length) = 0;

  /// The state as bytes. @pre  Description::saves_state
  [[nodiscard]] virtual std::vector<unsigned char> save() = 0;
  /// Returns to a saved state, also to that of another instance of the same FMU. @pre  Description::saves_state
  virtual void restore(std::span<const unsigned char> bytes) = 0;

  /// What it has warned of since this was asked last.
  [[nodiscard]] Warnings take_warnings() { return std::exchange(warnings_, {}); }

 protected:
  Instance() = default;
  void warn(const std::string& text) {
    if (warnings_.count++ == 0) warnings_.first = text;
  }

 private:
  Warnings warnings_;
};

/// Unpacks an FMU, loads its library, and makes an instance called `name`.
/// @throws FmuError, std::filesystem::filesystem_error; nothing is left in the temporary folder then
[[nodiscard]] std::unique_ptr<Instance> instantiate(const FmuFile& file, const Description& description,
                                                    const std::string& name);

}  // namespace hersey::fmi
