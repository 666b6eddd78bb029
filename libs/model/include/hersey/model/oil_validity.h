#pragma once

#include <limits>
#include <string>
#include <vector>

#include "hersey/film/film_model.h"

namespace hersey::model {

struct OilGrade;

/// Where an oil's numbers mean something, and what ends there.
struct OilValidity {
  /// A temperature, and what it is: "the pour point typical of iso_vg_46".
  struct End {
    double T = 0;  ///< [K]
    std::string what;
  };
  std::vector<End> low, high;
  double p_high = std::numeric_limits<double>::infinity();  ///< end of a table, above the cavitation pressure [Pa]
};

/// Of the law, and of its grade where it has one. @param grade  null: none
[[nodiscard]] OilValidity validity_of(const film::Lubricant& oil, const OilGrade* grade);

/// What is to be said of oil at a temperature [K]; empty: nothing.
[[nodiscard]] std::string temperature_warning(const OilValidity& validity, double T);

/// The same of a film with its hottest oil [K] (not a number: not known) and its largest pressure above the cavitation
/// pressure [Pa].
[[nodiscard]] std::vector<std::string> film_warnings(const OilValidity& validity, double T, double p);

}  // namespace hersey::model
