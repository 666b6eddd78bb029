#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "heat/layering.h"
#include "hersey/film/shear_law.h"

namespace hersey::film {

/// Loading that shears the oil at one node.
struct ShearOfGap {
  Eigen::Vector2d rate = Eigen::Vector2d::Zero();  ///< speed of the journal relative to the shell over the gap [1/s]
  Eigen::Vector2d fall = Eigen::Vector2d::Zero();  ///< gap times the pressure's gradient: tau(h) - tau(0) [Pa]
};

/// Shear rates of the layers of a film, node by node: every layer is sheared at the rate that its own stress takes, and
/// all rates add up to the sliding (thermal.25).
class LayerShear {
 public:
  /// @param thinning  not Newtonian; the caller keeps it alive
  LayerShear(const ShearThinning& thinning, int layers);

  /// Uses Newton's method, and where that does not converge the same with a line search on the potential (thermal.67).
  /// @param mu_n  of the layers at rest at their temperatures and the pressure of the node [Pa s]; the caller keeps it
  /// @param left  ratios R of the sheared viscosities to these [-]: initial values (1 is one) and the result
  void thin(std::span<const double> mu_n, const ShearOfGap& shear, std::span<double> left);

  /// Factor of the flow along pressure at the node last thinned, around and along the axis, over that between layers of
  /// uniform viscosity [-]; within a layer that flow depends on the tangent of the stress (thermal.26).
  [[nodiscard]] Eigen::Vector2d flow_factors();

 private:
  void follow(std::span<const double> left);
  void look();
  void find_steps();
  [[nodiscard]] double take_steps();
  [[nodiscard]] bool is_near() const;
  [[nodiscard]] double slope_at(double step_length) const;
  [[nodiscard]] double find_step_length() const;
  [[nodiscard]] bool by_newton(std::span<double> left);
  [[nodiscard]] bool by_descent(std::span<double> left);
  [[nodiscard]] Eigen::Vector2d beyond_mean(std::size_t l) const;

  const ShearThinning& thinning_;
  const Layering& across_;
  std::span<const double> mu_n_;
  ShearOfGap shear_;
  std::vector<Eigen::Vector2d> rates_, steps_, missing_;  ///< around and along the axis [1/s]; [Pa]
  Eigen::Vector2d mean_ = Eigen::Vector2d::Zero();        ///< stress in the middle of the film, after the steps [Pa]
  std::vector<Eigen::Matrix2d> by_stress_;                ///< of the rates [1/(Pa s)]
  std::vector<ShearRatio> ratios_;                        ///< of the rates last evaluated
  std::vector<double> sizes_;                             ///< of these [1/s]
  std::vector<double> left_, mu_;                         ///< R at the rates; viscosities with it [Pa s]
};

}  // namespace hersey::film
