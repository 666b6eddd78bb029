// Elastic bodies of tet10 elements, about 25,000 and 96,000 degrees of freedom: assembly, factorisation, solution,
// natural modes, reduction. Fails where a body of 25,000 takes more than 15 s to reduce, or one of 96,000 more than 4
// GiB to factorise. Usage: elastic_body_bench [small]
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/reduction.h"
#include "hersey/fem/vibration.h"

namespace {

using namespace hersey;
using namespace hersey::fem;

constexpr double gibibyte = 1024.0 * 1024 * 1024;

template <typename Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

InterfaceFrame end_of(const ElasticBody& body, const char* set, double x) {
  const std::vector<int>& nodes = body.mesh.node_sets.at(set);
  return {.name = set,
          .origin = {x, 0.025, 0.02},
          .nodes = nodes,
          .connection = Connection::average,
          .weights = face_weights(body.mesh, nodes)};
}

/// A rod 300 x 50 x 40 mm of `cells`; false if a target is missed.
bool time_body(const std::array<int, 3>& cells) {
  ElasticBody body;
  const double assembly = seconds([&] {
    body = assemble(box_mesh(ElementType::tet10, {0.3, 0.05, 0.04}, cells),
                    {isotropic({.youngs_modulus = 2.1e11, .poisson_ratio = 0.3, .density = 7850})});
  });
  ConstrainedStiffness stiffness(body.K, body.m, dofs_of(body.mesh.node_sets.at("x0")));
  double memory = 0;
  const double analysis = seconds([&] { memory = stiffness.memory_estimate(); });
  bool sound = true;
  const double factor = seconds([&] { sound = stiffness.factorise().solved(); });
  if (!sound) std::abort();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(body.size(), 1), sixty = Eigen::MatrixXd::Ones(body.size(), 60);
  Eigen::MatrixXd u = stiffness.solve(one);
  const double solve = seconds([&] { u = stiffness.solve(one); });
  const double block = seconds([&] { u = stiffness.solve(sixty); });
  Vibration modes;
  const double vibration = seconds([&] { modes = natural_modes(body, {}, {.count = 26}); });
  Reduction reduced;
  const double reduction = seconds([&] {
    reduced = reduce(body, {end_of(body, "x0", 0), end_of(body, "x1", 0.3)}, {.modes = 30});
  });
  if (!modes.solved() || !reduced.solved()) std::abort();
  fmt::print("{:>7} {:9.2f} {:9.2f} {:9.2f} {:9.1f} {:9.1f} {:9.2f} {:9.2f} {:9.2f}\n", body.size(), assembly, analysis,
             factor, 1e3 * solve, 1e3 * block, vibration, reduction, memory / gibibyte);
  const bool small = body.size() < 50000;
  if (small && reduction > 15) fmt::print("MISSED: the reduction takes {:.1f} s\n", reduction);
  if (memory > 4 * gibibyte) fmt::print("MISSED: the factor takes {:.1f} GiB\n", memory / gibibyte);
  return (!small || reduction < 15) && memory < 4 * gibibyte;
}

}  // namespace

int main(int argc, char**) {
  fmt::print(
      "A rod of tet10 elements; s, and ms for solutions (1, 60 right-hand sides); modes: 6 rigid and 20 elastic, "
      "factor\n");
  fmt::print("included; reduction: two averaging frames and 30 modes; memory of the factor in GiB.\n\n");
  fmt::print("{:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "unknown", "assembly", "ordering", "factor",
             "1 rhs", "60 rhs", "modes", "reduction", "memory");
  bool met = time_body({28, 6, 5});
  if (argc < 2) met = time_body({44, 9, 9}) && met;
  return met ? EXIT_SUCCESS : EXIT_FAILURE;
}
