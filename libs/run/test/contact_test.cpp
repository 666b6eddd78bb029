#include <doctest/doctest.h>

#include <cmath>

#include "bouncing_ball.h"
#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

// Contacts in a run: results, power balance, a start that lies too deep.
namespace hersey::run {
namespace contact_test {

TEST_CASE("BouncingBall_IsRecordedAndBalanced") {
  const TemporaryDirectory folder;
  const model::Model model = model::read_text(kBall, "ball.yaml");
  const Summary summary = simulate(model, {.results = folder / "r.h5"});
  CHECK(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-9);  // steps are solved to 1e-8 of their largest terms
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  const auto time = series("/time"), force = series("/contacts/bounce/normal_force"),
             gap = series("/contacts/bounce/gap"), position = series("/contacts/bounce/position"),
             damping = series("/contacts/bounce/damping_power"), friction = series("/contacts/bounce/friction_power"),
             on_second = series("/contacts/bounce/force"), kinetic = series("/energy/kinetic"),
             potential = series("/energy/potential"), velocity = series("/bodies/ball/velocity"),
             power = series("/power/contacts");
  double lost = 0;
  int touching = 0;
  for (std::size_t i = 0; i < gap.size(); ++i) {
    CHECK((gap[i] < 0) == (force[i] > 0));
    CHECK(std::isfinite(position[3 * i]) == (force[i] > 0));
    if (i > 0) lost += 0.5 * (damping[i] + friction[i] + damping[i - 1] + friction[i - 1]) * (time[i] - time[i - 1]);
    if (force[i] == 0) continue;
    ++touching;
    CHECK(std::abs(position[3 * i + 2] - 1e-3) < 1e-3);         // on the floor
    CHECK(on_second[3 * i + 2] == doctest::Approx(-force[i]));  // presses the floor down
  }
  CHECK(touching > 20);
  CHECK(power.size() == gap.size());
  CHECK(velocity[velocity.size() - 1] > 0);
  const double before = kinetic.front() + potential.front(), after = kinetic.back() + potential.back();
  CHECK(lost > 0.1 * kinetic.front());
  // Trapezoidal sum over the blow, and the step's own error.
  CHECK(after == doctest::Approx(before - lost).epsilon(1e-3));
}

TEST_CASE("StartDeepInside_IsReportedWithItsLine") {
  const std::string from = "position: 0 0 22 mm";
  std::string text = kBall;
  text.replace(text.find(from), from.size(), "position: 0 0 11 mm");
  try {
    check(model::read_text(text, "ball.yaml"));
    FAIL_CHECK("accepted");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()) ==
          "ball.yaml:14:3: contacts.bounce: at the start, t = 0 s: contact bounce: the shapes overlap by 10 mm, more "
          "than 4 mm (20 % of the "
          "smaller one's size); expected shapes apart or just touching at the start; move the joints' `initial` values "
          "or the shapes; of a half-space or mesh, see that its normals point out of the solid");
  }
}

}  // namespace contact_test
}  // namespace hersey::run
