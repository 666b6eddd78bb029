#include "hersey/study/shear_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/film/cavitated_shear.h"

namespace hersey::study {
namespace {

// A twentieth of the load moves the eccentricity by some percent, which is more than the grid's error.
constexpr double kNoticeableShare = 0.05;

bool depends_on_choice(const BearingSolution& solution) {
  const film::FilmObservables& film = solution.state.film;
  return solution.solved() && film.power_film > 0 && film.power_film_other_shear != film.power_film;
}

/// "1.2 N.m and ", of kinds whose moving surface turns.
std::string torque_with_other_shear(const BearingSolution& solution) {
  if (!solution.state.kind->has_axis()) return "";
  return fmt::format("{:.4g} N.m and ", std::abs(solution.state.film.torque_journal_other_shear));
}

/// Change of the film's power by the other choice [%].
double change(const BearingSolution& solution) {
  return 100 * (solution.state.film.power_film_other_shear / solution.state.film.power_film - 1);
}

}  // namespace

double load_on_shear(const BearingSolution& solution) {
  if (solution.state.load.size() != 2) return 0;  // shear acts across the load of a slider
  const Eigen::Vector2d force = solution.state.film.force_shear.head<2>(), &load = solution.state.load;
  return load.squaredNorm() > 0 ? force.dot(load) / load.squaredNorm() : 0;
}

std::vector<std::pair<std::string, std::string>> shear_remarks(const BearingSolution& solution) {
  std::vector<std::pair<std::string, std::string>> remarks;
  const film::FilmObservables& film = solution.state.film;
  if (depends_on_choice(solution))
    remarks.emplace_back("cavitated shear",
                         fmt::format("{} this film would take {}{:.4g} W ({:+.3g} %)",
                                     film::choice_in_words(solution.model.cavitated_shear),
                                     torque_with_other_shear(solution), film.power_film_other_shear, change(solution)));
  if (const double share = load_on_shear(solution); std::abs(share) > kNoticeableShare)
    remarks.emplace_back(
        "shear force",
        fmt::format("the net force of shear carries {:.3g} % of the load, as it does in narrow and lightly "
                    "loaded bearings; most charts leave it out (`shear_force: torque_only`)",
                    100 * share));
  return remarks;
}

std::string shear_remark(const std::vector<BearingSolution>& solutions) {
  std::vector<double> changes;
  const BearingSolution* first = nullptr;
  for (const BearingSolution& solution : solutions) {
    if (!depends_on_choice(solution)) continue;
    if (first == nullptr) first = &solution;
    if (solution.model.cavitated_shear != first->model.cavitated_shear) return "";
    changes.push_back(change(solution));
  }
  if (first == nullptr) return "";
  const auto [least, most] = std::minmax_element(changes.begin(), changes.end());
  return fmt::format("{} these films would take {:+.3g} to {:+.3g} % of power",
                     film::choice_in_words(first->model.cavitated_shear), *least, *most);
}

}  // namespace hersey::study
