#pragma once

#include <limits>
#include <string>
#include <vector>

#include "hersey/film/film_model.h"

namespace hersey::model {

struct OilGrade;

/// Range in which an oil's data are valid, and the reasons of its ends.
struct OilValidity {
  /// A temperature with its description: "the pour point typical of iso_vg_46".
  struct End {
    double T = 0;  ///< [K]
    std::string what;
  };
  std::vector<End> low, high;
  double p_high = std::numeric_limits<double>::infinity();  ///< end of a table, above the cavitation pressure [Pa]
};

/// Validity of the law, and of its grade if it has one.
/// @param grade  null: none
[[nodiscard]] OilValidity validity_of(const film::Lubricant& oil, const OilGrade* grade);

/// Returns a warning about oil at a temperature [K]; empty if there is none.
[[nodiscard]] std::string temperature_warning(const OilValidity& validity, double T);

/// Returns warnings about a film with its hottest oil [K] (not a number: not known) and its largest pressure above the
/// cavitation pressure [Pa].
[[nodiscard]] std::vector<std::string> film_warnings(const OilValidity& validity, double T, double p);

}  // namespace hersey::model
