#pragma once

#include <Eigen/Dense>
#include <vector>

#include "balance/flow_balance.h"
#include "heat/layer_profile.h"
#include "heat/layering.h"
#include "observe/film_wrench.h"

namespace hersey::film {

/// Gradient of the pressure that drives the flow at a node, around and along the axis [Pa/m].
[[nodiscard]] Eigen::Vector2d pressure_gradient(const FlowBalance& balance, int node);

/// Returns the same gradient. On supply line and features the pressure has a kink and the slopes of both sides count,
/// each weighted by its own size: the result is that of the film beside a groove, and zero on a peak. Beside line and
/// features both gradients count by the supply's part in the row.
[[nodiscard]] Eigen::Vector2d one_sided_gradient(const FlowBalance& balance, int node);

/// Returns the variation of fluidity within layers: that of oils that thin by shear follows from the layers' own shear.
[[nodiscard]] WithinLayers within_layers(const Lubricant& oil);

/// Flow of the oil of a solved film in its layers, and their dissipation (theory manual, thermal.7 to thermal.9). Flows
/// of all layers of a face add up to the film's own, dissipation to the film's power.
class LayerFlows {
 public:
  LayerFlows(const FilmModel& model, int layers);

  /// @param mu  of the layers at the cavitation pressure [Pa s], those the film was solved with
  void evaluate(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion,
                const Eigen::VectorXd& mu);

  [[nodiscard]] int layers() const { return layers_; }
  /// Flow over a face, from a to b [m^3/s]; of oil at rho0, as all flows here.
  [[nodiscard]] double over_face(std::size_t f, int layer) const { return faces_[at(f, layer)]; }
  /// First moment of that flow about the layer's middle, over the thickness [m^3/s].
  [[nodiscard]] double lead_over_face(std::size_t f, int layer) const { return leads_[at(f, layer)]; }
  /// Flow from a layer of a node into the next, towards the journal [m^3/s].
  [[nodiscard]] double upwards(int node, int layer) const {
    return upwards_[at(static_cast<std::size_t>(node), layer)];
  }
  /// Fraction of a layer in the flow that leaves a node along its pressure [-].
  [[nodiscard]] double leaving_fraction(int node, int layer) const {
    return fractions_[static_cast<std::size_t>(node)].pressure_flow[layer];
  }
  /// Oil lost at a node in a cavitation model that does not conserve it [m^3/s].
  [[nodiscard]] double lost(int node) const { return lost_[static_cast<std::size_t>(node)]; }
  /// Dissipation in a layer of a node [W].
  [[nodiscard]] double dissipation(int node, int layer) const {
    return heat_[at(static_cast<std::size_t>(node), layer)];
  }

 private:
  [[nodiscard]] std::size_t at(std::size_t index, int layer) const { return index * layers_ + layer; }
  void flow_over_faces(const FlowBalance& balance, const SurfaceMotion& motion);
  void flow_upwards(const FlowBalance& balance);
  void dissipate(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion);
  void dissipate_in_volumes(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion);
  void complete_at_edges(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion);

  const FilmModel& model_;
  std::size_t layers_;
  const Layering& across_;
  WithinLayers within_;
  std::vector<LayerFractions> fractions_;  ///< of each node
  std::vector<double> faces_, leads_, upwards_, heat_, lost_;
  std::vector<double> along_pressure_, by_sliding_;  ///< heat of each node by pressure flow and by sliding [W]
};

}  // namespace hersey::film
