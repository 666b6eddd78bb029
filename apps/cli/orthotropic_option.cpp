#include "orthotropic_option.h"

#include <array>
#include <sstream>

#include "hersey/core/input_error.h"
#include "option_value.h"

namespace hersey::cli {
namespace {

constexpr const char* kOption = "--orthotropic";

[[noreturn]] void refuse(std::string found, std::string expected) {
  throw InputError(Fault{{"", 0, 0}, kOption, std::move(found), std::move(expected), ""});
}

}  // namespace

fem::SolidMaterial orthotropic_material(const std::string& text, double density) {
  std::array<double, 9> values{};
  std::size_t count = 0;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ','); ++count)
    if (count < values.size()) values[count] = in_si(kOption, part, count / 3 == 1 ? "1" : "Pa");
  if (count != values.size())
    refuse(std::to_string(count) + " values", "nine: E_1,E_2,E_3,nu_12,nu_23,nu_13,G_12,G_23,G_13");
  const fem::OrthotropicMaterial material{.E_1 = values[0],
                                          .E_2 = values[1],
                                          .E_3 = values[2],
                                          .nu_12 = values[3],
                                          .nu_23 = values[4],
                                          .nu_13 = values[5],
                                          .G_12 = values[6],
                                          .G_23 = values[7],
                                          .G_13 = values[8],
                                          .density = density};
  if (!fem::is_stable(material))
    refuse("constants of no material: some strain would store no energy",
           "moduli > 0 and Poisson's ratios small enough, nu_12^2 < E_1/E_2 and the like");
  return fem::orthotropic(material);
}

}  // namespace hersey::cli
