// What the sensitivities of every figure cost: all usual parameters of the bearing that stands alone together, over one
// more solution from nothing. Reading the model file counts on both sides.
//
//   sensitivity_bench [EXAMPLES_DIR]
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "film_cases.h"
#include "hersey/study/bearing_study.h"
#include "hersey/study/sensitivity.h"

namespace {

using namespace hersey;

constexpr double kTarget = 1;  // all of them cost less than one extra solution

bool print_case(const std::string& path) {
  const study::BearingStudyOptions options{.bearing = "", .grid_error = false, .threads = 1};
  const std::vector<std::string> keys = study::usual_parameters(path, {}, "");
  double solving = std::numeric_limits<double>::infinity(), slopes = solving;
  std::vector<study::BearingSolution> solutions;
  for (int round = 0; round < 7; ++round) {
    solving = std::min(solving, film::shortest(1, [&] {
                         solutions = study::solve_bearings(path, {{{}, "", "", {}}}, options);
                       }));
    if (!solutions.front().solved()) std::abort();
    slopes = std::min(slopes, film::shortest(1, [&] {
                        for (const study::Sensitivity& s : study::sensitivities(path, solutions.front(), options, keys))
                          if (s.solved() && !s.exact) std::abort();
                      }));
  }
  fmt::print("{:<40} {:>2} parameters {:8.2f} ms, one solution {:8.2f} ms, ratio {:5.2f} (target {})\n",
             std::filesystem::path(path).parent_path().filename().string(), keys.size(), 1e3 * slopes, 1e3 * solving,
             slopes / solving, kTarget);
  return slopes <= kTarget * solving;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path examples = argc > 1 ? argv[1] : "examples";
  return print_case((examples / "bearing_alone/model.yaml").string()) ? EXIT_SUCCESS : EXIT_FAILURE;
}
