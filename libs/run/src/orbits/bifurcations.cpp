#include "orbits/bifurcations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace hersey::run {
namespace {

using Complex = std::complex<double>;

constexpr double kChange = 1e-3;  // of the range, by which orbits differ on one side of a fold
// Distance of a multiplier from 1 within which either side may be its true one: multipliers are found to 1e-3. Half of
// it takes a fold for a branching where the multiplier errs, much more takes in orbits beyond a fold beside it.
constexpr double kUncertain = 2e-3;
constexpr double kReal = 1e-6;  // imaginary part of a multiplier below which it is real

std::size_t count_of_growing(const OrbitAtValue& orbit) {
  std::size_t count = 0;
  for (const Complex& multiplier : orbit.multipliers)
    if (std::abs(multiplier) > 1) count += multiplier.imag() > kReal ? 2 : 1;
  return count;
}

// Of the multipliers that do not grow the one nearest to another one.
std::optional<Complex> nearest_decaying(const OrbitAtValue& orbit, const Complex& to) {
  std::optional<Complex> nearest;
  for (const Complex& one : orbit.multipliers)
    if (std::abs(one) <= 1 && (!nearest || std::abs(one - to) < std::abs(*nearest - to))) nearest = one;
  return nearest;
}

// Change of the value from orbit `from` on in steps of `step`, as soon as it is one, else to the end.
double change_from(const std::vector<OrbitAtValue>& orbits, std::size_t from, int step) {
  const auto [low, high] = std::ranges::minmax(orbits, {}, &OrbitAtValue::value);
  for (auto k = static_cast<std::ptrdiff_t>(from); k >= 0 && k < static_cast<std::ptrdiff_t>(orbits.size()); k += step)
    if (const double change = orbits[static_cast<std::size_t>(k)].value - orbits[from].value;
        std::abs(change) > kChange * (high.value - low.value))
      return change;
  const OrbitAtValue& last = step > 0 ? orbits.back() : orbits.front();
  return last.value - orbits[from].value;
}

bool is_uncertain(const OrbitAtValue& orbit) {
  return std::ranges::any_of(orbit.multipliers, [](const Complex& one) { return std::abs(one - 1.0) < kUncertain; });
}

// The values before it and behind it lie on the same side, those left out of which the multiplier does not say on which
// side of a fold they are.
bool turns_back(const std::vector<OrbitAtValue>& orbits, std::size_t before) {
  std::size_t behind = before + 1;
  while (before > 0 && is_uncertain(orbits[before])) --before;
  while (behind + 1 < orbits.size() && is_uncertain(orbits[behind])) ++behind;
  return change_from(orbits, before, -1) * change_from(orbits, behind, 1) > 0;
}

}  // namespace

std::optional<Crossing> crossing_between(const OrbitAtValue& a, const OrbitAtValue& b) {
  const std::size_t of_a = count_of_growing(a), of_b = count_of_growing(b);
  if (of_a == of_b) return std::nullopt;
  const OrbitAtValue &more = of_a > of_b ? a : b, &less = of_a > of_b ? b : a;
  // The one that has just crossed is nearer to the circle than those that had crossed before.
  Complex growing = more.multipliers.front();
  for (const Complex& one : more.multipliers)
    if (std::abs(one) > 1) growing = one;
  const std::optional<Complex> decaying = nearest_decaying(less, growing);
  if (!decaying) return Crossing{growing / std::abs(growing), 0.5};
  const double grows = std::log(std::abs(growing)), decays = std::log(std::abs(*decaying));
  const double share = grows / (grows - decays);  // from `more`
  const bool are_a_pair = growing.imag() > kReal && decaying->imag() > kReal;
  const Complex between = are_a_pair ? growing + share * (*decaying - growing) : growing;
  return Crossing{between / std::abs(between), of_a > of_b ? share : 1 - share};
}

std::vector<BifurcationAt> bifurcations_of(const std::vector<OrbitAtValue>& orbits) {
  std::vector<BifurcationAt> found;
  for (std::size_t k = 0; k + 1 < orbits.size(); ++k) {
    const std::optional<Crossing> crossing = crossing_between(orbits[k], orbits[k + 1]);
    if (!crossing) continue;
    BifurcationAt at;
    at.behind = k;
    at.value = orbits[k].value + crossing->share * (orbits[k + 1].value - orbits[k].value);
    const double angle = std::arg(crossing->multiplier);
    const double period = orbits[k].period + crossing->share * (orbits[k + 1].period - orbits[k].period);
    if (crossing->multiplier.imag() > kReal) {
      at.kind = Bifurcation::torus;
      at.frequency = angle / (2 * std::numbers::pi * period);
    } else if (crossing->multiplier.real() < 0) {
      at.kind = Bifurcation::period_doubling;
    } else {
      at.kind = turns_back(orbits, k) ? Bifurcation::fold : Bifurcation::branching;
    }
    found.push_back(at);
  }
  return found;
}

}  // namespace hersey::run
