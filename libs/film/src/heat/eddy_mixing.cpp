#include "heat/eddy_mixing.h"

#include <algorithm>
#include <cmath>

#include "heat/layering.h"
#include "laws/eddy_profile.h"

namespace hersey::film {
namespace {

// Intervals of Simpson's rule: twice as many change resistances by less than 1e-3.
constexpr int resistance_intervals = 16;

/// Returns the integral of a function from 0 to 1.
template <class Function>
double by_simpson(Function&& value) {
  double sum = 0;
  for (int k = 0; k <= resistance_intervals; ++k) {
    const double weight = k == 0 || k == resistance_intervals ? 1 : k % 2 == 1 ? 4 : 2;
    sum += weight * value(static_cast<double>(k) / resistance_intervals);
  }
  return sum / (3.0 * resistance_intervals);
}

/// Returns the integral between two heights of a function of the distance from the nearer wall. Eddies grow with the
/// cube of that distance beside the wall: abscissas s^3/2 are graded alike.
template <class Function>
double between_heights(double from, double to, const Function& value) {
  constexpr double middle = 0.5;
  if (from < middle && middle < to) return between_heights(from, middle, value) + between_heights(middle, to, value);
  const bool is_upper = from >= middle;
  const double begin = std::cbrt(2 * (is_upper ? 1 - to : from)), end = std::cbrt(2 * (is_upper ? 1 - from : to));
  return (end - begin) * by_simpson([&](double t) {
           const double s = begin + t * (end - begin);
           return 1.5 * s * s * value(0.5 * s * s * s);
         });
}

}  // namespace

EddyMixing::EddyMixing(const FilmModel& model, const Node& node)
    : fraction_(node.turbulent_fraction),
      h_plus_(fraction_ > 0
                  ? std::sqrt(node.reynolds * fully_turbulent(model.turbulence.model, node.reynolds).sliding.value)
                  : 0),
      molecular_(model.lubricant.conductivity),
      per_eddies_(fraction_ * model.lubricant.specific_heat * node.mu_laminar / model.turbulence.prandtl) {}

double EddyMixing::eddies(double eta) const { return eddy_viscosity_ratio(std::min(eta, 1 - eta) * h_plus_); }

double EddyMixing::viscosity_factor(double from, double to) const {
  return (to - from) / between_heights(from, to, [&](double eta) { return 1 / (1 + fraction_ * eddies(eta)); });
}

double EddyMixing::conductivity(double eta) const { return molecular_ + per_eddies_ * eddies(eta); }

double EddyMixing::resistance(double from, double to) const {
  return between_heights(from, to, [&](double eta) { return 1 / conductivity(eta); });
}

double EddyMixing::resistance_to_wall(double width) const {
  return width * by_simpson([&](double s) {
           const double part = s * s * s;
           return 3 * s * s * (1 - part) / conductivity(part * width);
         });
}

void add_eddies(const EddyMixing& mixing, std::span<double> mu) {
  const Layering& layers = layering_of(mu.size());
  for (std::size_t l = 0; l < mu.size(); ++l) {
    const double half = 0.5 * layers.width(l), middle = layers.middle(l);
    mu[l] *= mixing.viscosity_factor(std::max(middle - half, 0.0), std::min(middle + half, 1.0));
  }
}

}  // namespace hersey::film
