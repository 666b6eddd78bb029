#pragma once

#include <string>
#include <vector>

namespace hersey::run {

/// An entry of the summary table made from a quantity.
struct SummaryEntry {
  enum class Statistic {
    smallest,         ///< over all instants, with its instant
    largest,          ///< over all instants, with its instant
    largest_in_size,  ///< of largest magnitude, with its sign and instant
    longest,          ///< largest magnitude of a vector
    mean,             ///< over time
    integral,         ///< over time
    at_end            ///< value at the end of the run; for cycles: of the last one; for an attribute: its value
  };
  enum class Only {
    always,
    of_a_cycle,   ///< only if there was a whole cycle
    with_contact  ///< only if surfaces have touched
  };
  Statistic statistic = Statistic::at_end;
  std::string name;           ///< "minimum film thickness (MOFT)"; <...> is filled in as in QuantityInfo::name
  std::string unit = {};      ///< unit in the table, "µm"; empty for a pure number
  bool has_location = false;  ///< the series <name>_phi and <name>_z give its location
  Only only = Only::always;
};

/// Description of a quantity, common to results file, summary table, report and documentation.
struct QuantityInfo {
  enum class Kind { series, constant, attribute };
  std::string name;         ///< below the group of its thing, "h_min"; <...> stands for a name
  std::string unit;         ///< SI, "1" for a pure number, several as "N|N.m"; empty for text
  std::string text;         ///< description
  std::string shape = {};   ///< "[n, 3]"; empty: one number or text
  std::string symbol = {};  ///< of the theory manual, where it has one
  std::string note = {};    ///< further remarks for the documentation: conditions under which the quantity exists, its
                            ///< interpretation
  Kind kind = Kind::series;
  std::vector<std::string> dimensions = {};  ///< names of its columns, besides x, y, z
  std::vector<SummaryEntry> summary_entries = {};
};

/// All quantities that a results file has of things of one kind.
struct QuantityGroup {
  std::string path;     ///< of a thing's group, "/bearings/<b>/"
  std::string heading;  ///< description of the things, "of a film"
  std::vector<QuantityInfo> quantities;
};

}  // namespace hersey::run
