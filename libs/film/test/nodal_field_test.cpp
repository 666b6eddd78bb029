#include "hersey/film/nodal_field.h"

#include <doctest/doctest.h>

#include <cmath>

#include "film_cases.h"

namespace hersey::film {
namespace nodal_field_test {

constexpr double round_off = 1e-12;  // of sums over all nodes

FilmModel on_grid(const Grid& grid) { return {.R = 0.025, .L = 0.02, .c = 25e-6, .grid = grid}; }

Eigen::VectorXd nodal(const FilmModel& film, double (*f)(double phi, double z)) {
  Eigen::VectorXd values(film.grid.size());
  for (int k = 0; k < film.grid.size(); ++k)
    values[k] = f(film.grid.phi(k / film.grid.n_z), film.L * film.grid.z_over_L(k % film.grid.n_z));
  return values;
}

TEST_CASE("Weights_AddUpToTheArea_AndFieldsAreMetAtTheirNodes") {
  const Grid graded = graded_grid(40, 9, {{.position = 3, .reach = 0.4, .factor = 4}}, {});
  for (const Grid& grid : {Grid{24, 7}, graded}) {
    const FilmModel film = on_grid(grid);
    const NodalField field(film);
    CHECK(field.weights().sum() == doctest::Approx(2 * pi * film.R * film.L).epsilon(round_off));
    const Eigen::VectorXd values = nodal(film, [](double phi, double z) { return std::sin(phi) + 70 * z; });
    for (int k = 0; k < grid.size(); ++k) {
      const double phi = grid.phi(k / grid.n_z), z = film.L * grid.z_over_L(k % grid.n_z);
      CHECK(field.at(values, phi, z) == doctest::Approx(values[k]).epsilon(round_off));
      CHECK(field.at(values, phi - 4 * pi, z) == doctest::Approx(values[k]).epsilon(1e-9));  // digits of whole turns
    }
    CHECK(field.at(values, 1, 0.51 * film.L) == 0);
  }
}

TEST_CASE("FieldBetweenNodes_IsOfSecondOrder") {
  const auto error = [](int n) {
    const FilmModel film = on_grid({n, n / 4});
    const NodalField field(film);
    const auto f = [](double phi, double z) { return std::cos(2 * phi) * std::exp(50 * z); };
    const Eigen::VectorXd values = nodal(film, f);
    double worst = 0;
    for (int i = 0; i < 997; ++i) {
      const double phi = 0.0063 * i, z = film.L * (i / 997.0 - 0.5);
      worst = std::max(worst, std::abs(field.at(values, phi, z) - f(phi, z)));
    }
    return worst;
  };
  CHECK(error(48) / error(96) == doctest::Approx(4).epsilon(0.15));  // where samples meet the middles of cells
}

TEST_CASE("FieldOutsideOfPatches_IsZero") {
  const FilmModel film = [] {
    FilmModel model = on_grid(patch_grid({{.from = 0.5, .to = 1.5, .lines = 8}, {.from = 2, .to = 3, .lines = 8}}, 5));
    model.ends.resize(2);
    return model;
  }();
  const NodalField field(film);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(film.grid.size());
  for (const double phi : {0.5, 1.0, 1.5, 2.0, 2.7, 3.0}) CHECK(field.at(one, phi, 0) == 1);
  for (const double phi : {0.0, 0.49, 1.51, 1.99, 3.01, 6.0}) CHECK(field.at(one, phi, 0) == 0);
}

TEST_CASE("FieldBesideTheFilm_GoesOn") {
  const FilmModel film = [] {
    FilmModel model = on_grid(patch_grid({{.from = 0.5, .to = 1.5, .lines = 8}, {.from = 2, .to = 3, .lines = 8}}, 5));
    model.ends.resize(2);
    return model;
  }();
  const NodalField field(film);
  const Eigen::VectorXd values = nodal(film, [](double phi, double z) { return 3 * phi + 70 * z; });
  for (const double z : {-0.5 * film.L, 0.1 * film.L, 0.5 * film.L}) {
    for (const double phi : {0.5, 0.7, 1.5, 1.6, 1.9, 2.0, 2.7, 3.0})  // linear over the gap, too
      CHECK(field.continued(values, phi, z) == doctest::Approx(3 * phi + 70 * z).epsilon(round_off));
    for (const double phi : {0.7, 2.7}) CHECK(field.continued(values, phi, z) == field.at(values, phi, z));
    // From the last line at 3 to the first at 0.5 of the next revolution.
    CHECK(field.continued(values, (3 + 0.5 + 2 * pi) / 2, z) == doctest::Approx(3 * 1.75 + 70 * z).epsilon(round_off));
  }
  CHECK(field.continued(values, 1, film.L) == field.at(values, 1, film.L / 2));
  CHECK(field.continued(values, 1, -film.L) == field.at(values, 1, -film.L / 2));
}

}  // namespace nodal_field_test
}  // namespace hersey::film
