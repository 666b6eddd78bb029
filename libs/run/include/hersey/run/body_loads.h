#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/fem/mesh.h"
#include "hersey/model/model.h"
#include "hersey/results/reader.h"

namespace hersey::run {

/// Whose loads are asked for.
struct LoadRequest {
  std::string body;                    ///< empty: the only one with a mesh on which a film lies
  std::vector<std::string> bearings;   ///< empty: all that lie on it
  std::optional<fem::Mesh> mesh = {};  ///< of a body that is rigid in the run, in its axes [m]; else its own
  std::string mesh_file = {};          ///< that it came from, for messages
};

/// The films of one body at one stored instant, as pressures on the faces of its mesh.
struct BodyLoadsAt {
  double time = 0;                    ///< [s]
  std::optional<double> crank_angle;  ///< [rad]; of a model with a crank
  Eigen::VectorXd pressure;           ///< of oil and asperities together, corrected, shape (faces) [Pa]
  Eigen::VectorXd contact;            ///< of asperities alone, mean over each face [Pa]
  Eigen::VectorXd temperature;        ///< of the surface, mean over the film's part of each face [degC]; empty: unknown
  Vector6 film = Vector6::Zero();     ///< [moment about the body's origin; force] of the films' pressures, body axes
  Vector6 mapped = Vector6::Zero();   ///< the same of the pressures on the faces
  double off_force = 0, off_moment = 0;  ///< largest difference of a bearing, over its force, and that times half its
                                         ///< width [-]
  double shear = 0;                      ///< size of the forces of the films' shear, which pressures leave out [N]
  /// Of the body's origin, in its axes: what inertia loads are made of [m/s^2; rad/s].
  Vector3 acceleration = Vector3::Zero(), angular_velocity = Vector3::Zero();
};

/// Temperatures of the films' surfaces at the nodes of a body's mesh, mean over time.
struct FilmTemperatures {
  /// The surface of one film.
  struct Surface {
    std::string bearing;
    double mean = 0;  ///< over the surface and over time [degC]
  };
  std::vector<Surface> surfaces;  ///< of films with temperatures; none: no film on the body has any
  std::vector<int> nodes;         ///< of these films' faces, indices in the mesh, ascending
  Eigen::VectorXd T;              ///< of these nodes [degC]
};

/// Loads of the films of a finished run on a body, for strength computations: at the instants at which fields are
/// stored.
/// @verified_by loads_test.py
class BodyLoads {
 public:
  /// @param results, model  outlive this; `model` by model_of_results
  /// @throws InputError where there is no such body or bearing, no mesh, or where film and mesh do not meet
  BodyLoads(const results::Reader& results, const model::Model& model, LoadRequest request);
  ~BodyLoads();

  /// Name of the body.
  [[nodiscard]] const std::string& body() const;
  /// Its mesh, in the body's axes.
  [[nodiscard]] const fem::Mesh& mesh() const;
  /// Names of the bearings, and the faces of each.
  [[nodiscard]] std::vector<std::pair<std::string, std::vector<fem::ElementFace>>> films() const;
  /// All faces that carry pressure, each once.
  [[nodiscard]] const std::vector<fem::ElementFace>& faces() const;
  [[nodiscard]] const std::vector<double>& times() const;  ///< [s], of the stored instants
  /// Crank angles of the same [rad]; empty: the model has no crank.
  [[nodiscard]] const std::vector<double>& crank_angles() const;
  /// Begin and end of the last complete cycle [s]; none of a run without cycles.
  [[nodiscard]] std::optional<std::pair<double, double>> cycle() const;
  /// Instants of the last complete cycle; of a run without cycles all.
  [[nodiscard]] std::vector<std::size_t> last_cycle() const;
  /// Returns the loads at a stored instant.
  [[nodiscard]] BodyLoadsAt at(std::size_t instant) const;
  /// Returns the temperatures of the body's own side of the films (of a shell `shell_temperature`, of a journal
  /// `journal_temperature`) at the nodes of their faces, mean over the time from the first to the last of these stored
  /// instants, linear between them, (film-surface.13) to (film-surface.15). Nodes of two films have the mean of both.
  /// @pre instants are not empty, and ascending
  [[nodiscard]] FilmTemperatures mean_temperatures(const std::vector<std::size_t>& instants) const;

 private:
  struct Film;
  struct NodalMeans;
  [[nodiscard]] NodalMeans nodal_means(const Film& film, const std::vector<std::size_t>& instants,
                                       const std::vector<double>& weights) const;
  void add_film(const model::Bearing& bearing, bool is_shell);
  void add(const Film& film, std::size_t instant, BodyLoadsAt& loads) const;

  const results::Reader& results_;
  const model::Model& model_;
  LoadRequest request_;
  const model::Body* of_ = nullptr;
  std::shared_ptr<const fem::Mesh> mesh_;
  std::vector<Film> films_;
  std::vector<fem::ElementFace> faces_;
  std::vector<double> times_, crank_angles_;
  std::vector<std::size_t> rows_;  ///< of the instants among those of the series
};

}  // namespace hersey::run
