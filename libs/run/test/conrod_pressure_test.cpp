#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/skin.h"
#include "hersey/model/build.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"
#include "source_dir.h"
#include "temporary_directory.h"

// The example of a connecting rod under bore pressure against the whole mesh.
namespace hersey::run {
namespace conrod_pressure_test {

TEST_CASE("ConrodUnderBorePressure_MovesAsItsWholeMesh") {
  const TemporaryDirectory folder;
  const auto model = model::read(std::filesystem::path(hersey::source_dir()) / "examples/conrod_pressure/static.yaml");
  const Summary summary = simulate(model, {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  const model::Flexible& flexible = *model.bodies[0].flexible;
  const fem::ElasticBody body = fem::assemble(*flexible.mesh, flexible.materials);
  const std::vector<fem::ElementFace> faces = fem::faces_called(body.mesh, "big_end");
  std::vector<fem::Support> supports;
  for (const int dof : fem::dofs_of(body.mesh.node_sets.at("small_end"))) supports.push_back({dof, 0});
  const Eigen::VectorXd f =
      30e6 * fem::cosine_pressure_load(body.mesh, faces, *model.forces[0].as<model::SurfaceLoad>()->direction);
  const fem::StaticSolution whole = fem::solve_static(body, supports, f);
  REQUIRE(whole.solved());
  // Displacement of the bore's nodes by the amplitudes of the shapes.
  const results::Reader reader(folder / "r.h5");
  const auto q = reader.read("/bodies/rod/amplitudes").values,
             d = reader.read("/bodies/rod/shapes/mesh/deformation").values;
  const fem::Skin skin = fem::skin(body.mesh);
  std::vector<char> on_bore(body.mesh.nodes.size(), 0);
  for (const int n : fem::nodes_on(body.mesh, faces)) on_bore[static_cast<std::size_t>(n)] = 1;
  double error = 0, size = 0;
  for (std::size_t c = 0; c < skin.nodes.size(); ++c) {
    if (on_bore[static_cast<std::size_t>(skin.nodes[c])] == 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double u = 0;
      for (std::size_t k = 0; k < q.size(); ++k) u += q[k] * d[3 * (k * skin.nodes.size() + c) + axis];
      const double exact = whole.u(3 * skin.nodes[c] + static_cast<int>(axis), 0);
      error = std::max(error, std::abs(u - exact));
      size = std::max(size, std::abs(exact));
    }
  }
  MESSAGE("bore moves by up to " << 1e6 * size << " um, the reduced body errs by " << 100 * error / size << " %");
  CHECK(size > 1e-5);
  CHECK(error < 0.01 * size);
  CHECK(reader.read("/energy/strain").values.back() == doctest::Approx(0.5 * f.dot(whole.u.col(0))).epsilon(0.01));
}

/// Displacements of the nodes after `steps` of 10 us under the rising pressure.
Eigen::VectorXd after(const char* form, int steps) {
  const auto model = model::read(std::filesystem::path(hersey::source_dir()) / "examples/conrod_pressure/model.yaml",
                                 {std::string("bodies.rod.flexible.form=") + form});
  const model::Machine machine = model::build(model);
  mbd::Mechanism& m = *machine.mechanism;
  solver::State state = m.initial_state();
  REQUIRE(
      solver::initialise(
          m, state, {.fixed = m.given_coordinates(), .fixed_rates = m.given_rates(), .stiff = m.elastic_coordinates()})
          .solved());
  solver::GeneralizedAlpha integrator({.spectral_radius = model.simulation.spectral_radius});
  for (int i = 0; i < steps; ++i) {
    const solver::StepSummary step = integrator.step(m, state, 1e-5);
    REQUIRE_MESSAGE(step.solved(), step.message);
  }
  const model::BuiltFlexible& rod = machine.flexibles[0];
  return rod.body->displacements(m.observe(state).elastics[0].motion, rod.shapes);
}

TEST_CASE("ConrodUnderBorePressure_MovesAlikeByModesAndByNodes") {
  const auto model = model::read(std::filesystem::path(hersey::source_dir()) / "examples/conrod_pressure/model.yaml");
  const fem::Mesh& mesh = *model.bodies[0].flexible->mesh;
  const Eigen::VectorXd modal = after("modal", 20), nodal = after("nodal", 20);
  double error = 0, size = 0;
  for (const int n : fem::nodes_on(mesh, fem::faces_called(mesh, "big_end"))) {
    error = std::max(error, (modal - nodal).segment<3>(3 * n).norm());
    size = std::max(size, nodal.segment<3>(3 * n).norm());
  }
  MESSAGE("bore moves by up to " << 1e6 * size << " um, modes and nodes differ by " << 100 * error / size << " %");
  CHECK(size > 1e-5);
  CHECK(error < 0.01 * size);
}

}  // namespace conrod_pressure_test
}  // namespace hersey::run
