// Films of a finished run on the faces of a body's mesh, (film-surface.9) to (film-surface.15).
#include "hersey/run/body_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/fem/face_pressures.h"
#include "hersey/fem/face_temperatures.h"
#include "hersey/fem/film_surface.h"
#include "hersey/film/nodal_field.h"
#include "hersey/run/model_of_results.h"
#include "strength/stored_motion.h"

namespace hersey::run {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double near_film_radius = 0.01;  // by which nodes of a rigid body's mesh may lie off the bearing's radius

[[noreturn]] void refuse_loads(const char* option, std::string found, std::string expected, std::string remedy = "") {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), std::move(remedy)});
}

bool lies_on_cylinder(const model::Bearing& bearing) {
  return std::holds_alternative<film::Cylinder>(bearing.film.surface);
}

/// Names of the bodies with a film that can be mapped, each once.
std::vector<std::string> bodies_with_films(const model::Model& model, bool with_mesh) {
  std::vector<std::string> names;
  const auto has_mesh = [&](const std::string& name) {
    return std::any_of(model.bodies.begin(), model.bodies.end(), [&](const model::Body& body) {
      return body.name == name && body.flexible && !body.flexible->mesh->elements.empty();
    });
  };
  for (const model::Bearing& bearing : model.bearings)
    for (const std::string& name : {bearing.shell.body, bearing.journal.body})
      if (lies_on_cylinder(bearing) && !name.empty() && (!with_mesh || has_mesh(name)) &&
          std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  return names;
}

const model::Body& body_called(const model::Model& model, const std::string& name) {
  if (name == "ground") return model.ground;
  const auto at = std::find_if(model.bodies.begin(), model.bodies.end(),
                               [&](const model::Body& body) { return body.name == name; });
  if (at != model.bodies.end()) return *at;
  const std::vector<std::string> names = bodies_with_films(model, false);
  refuse_loads("--body", fmt::format("the model has no body '{}'", name), one_of(names), did_you_mean(name, names));
}

Pose pose_of_frame(const model::Model& model, const model::FrameName& frame) {
  for (const model::Frame& candidate : body_called(model, frame.body).frames)
    if (candidate.name == frame.frame) return candidate.X_BF;
  return {};
}

/// What each instant counts in a mean over the time from the first to the last, by the trapezoidal rule; one of a
/// single instant.
std::vector<double> weights_over_time(const std::vector<double>& times) {
  const double length = times.back() - times.front();
  if (!(length > 0)) return std::vector<double>(times.size(), 1.0 / static_cast<double>(times.size()));
  std::vector<double> weights(times.size(), 0);
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    for (const std::size_t end : {k, k + 1}) weights[end] += (times[k + 1] - times[k]) / (2 * length);
  return weights;
}

}  // namespace

struct BodyLoads::Film {
  const model::Bearing* bearing = nullptr;
  bool is_shell = true;
  std::string group;              ///< of the results
  std::string inboard, outboard;  ///< bodies of both frames in the results
  Matrix3 of_shell, of_journal;   ///< axes of the bearing's frames in these bodies
  film::NodalField nodes;
  fem::FacePressures on_faces;
  fem::FilmCylinder cylinder;  ///< its X: the film's axes on this body in the body's
  std::vector<Index> faces;    ///< indices among all faces

  /// Field of the body's own side in the results.
  [[nodiscard]] std::string temperature_field() const {
    return group + "fields/" + (is_shell ? "shell_temperature" : "journal_temperature");
  }

  /// The angle by which the mesh of a journal has rotated against the film.
  [[nodiscard]] double turned(const results::Reader& results, std::size_t row) const {
    if (is_shell) return 0;
    const Matrix3 shell = orientation_at(results, inboard, row) * of_shell,
                  journal = orientation_at(results, outboard, row) * of_journal, R = shell.transpose() * journal;
    return std::atan2(R(1, 0), R(0, 0));
  }
};

BodyLoads::~BodyLoads() = default;

BodyLoads::BodyLoads(const results::Reader& results, const model::Model& model, LoadRequest request)
    : results_(results), model_(model), request_(std::move(request)) {
  if (request_.body.empty()) {
    const std::vector<std::string> bodies = bodies_with_films(model, !request_.mesh);
    if (bodies.size() != 1)
      refuse_loads("--body",
                   bodies.empty() ? "no body of the model has a mesh on which the film of a journal bearing lies"
                                  : fmt::format("films lie on {} bodies", bodies.size()),
                   bodies.empty() ? "a flexible body, or --body NAME of a rigid one with --mesh FILE" : one_of(bodies));
    request_.body = bodies.front();
  }
  of_ = &body_called(model, request_.body);
  if (request_.mesh) {
    if (of_->flexible)
      refuse_loads("--mesh", fmt::format("body {} is flexible and has the mesh of the model", request_.body),
                   "a mesh of a body that is rigid in the run");
    mesh_ = std::make_shared<const fem::Mesh>(*request_.mesh);
  } else {
    if (!of_->flexible || of_->flexible->mesh->elements.empty())
      refuse_loads("--body", fmt::format("body {} has no mesh of elements in the model", request_.body),
                   "--mesh FILE with the mesh of a rigid body, in the body's axes");
    require_same_mesh(results, model, *of_);
    mesh_ = of_->flexible->mesh;
  }
  std::vector<std::string> known;
  for (const model::Bearing& bearing : model.bearings)
    for (const bool is_shell : {true, false}) {
      if ((is_shell ? bearing.shell : bearing.journal).body != request_.body) continue;
      known.push_back(bearing.name);
      const bool is_asked = request_.bearings.empty() || std::find(request_.bearings.begin(), request_.bearings.end(),
                                                                   bearing.name) != request_.bearings.end();
      if (is_asked && lies_on_cylinder(bearing)) add_film(bearing, is_shell);
      if (is_asked && !request_.bearings.empty() && !lies_on_cylinder(bearing))
        refuse_loads("--bearing", fmt::format("bearing {} is of kind {}", bearing.name, bearing.kind->name()),
                     "a bearing whose film lies on a cylinder");
    }
  for (const std::string& name : request_.bearings)
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse_loads("--bearing", fmt::format("no bearing '{}' lies on body {}", name, request_.body), one_of(known),
                   did_you_mean(name, known));
  if (films_.empty())
    refuse_loads("--body", fmt::format("no film on a cylinder lies on body {}", request_.body),
                 one_of(bodies_with_films(model, false)));
  times_ = results.read(films_.front().group + "fields/time").values;
  const std::vector<double> rows = results.read("/time").values;
  if (times_.empty() || rows.empty()) throw results::ReadError(results.path(), "it has no stored film yet");
  for (const double time : times_) rows_.push_back(row_at(rows, time));
  if (!results.has("/crank_angle")) return;
  const std::vector<double> angles = results.read("/crank_angle").values;
  for (const std::size_t row : rows_) crank_angles_.push_back(angles.at(row));
}

void BodyLoads::add_film(const model::Bearing& bearing, bool is_shell) {
  const std::string side = is_shell ? "shell" : "journal";
  const std::string group = "/bearings/" + bearing.name + "/";
  if (!results_.has(group + "fields/pressure"))
    throw results::ReadError(results_.path(), fmt::format("it has no stored film of bearing {}", bearing.name));
  const auto& deforming = is_shell ? bearing.shell_surface : bearing.journal_surface;
  fem::FilmCylinder cylinder;
  std::vector<fem::ElementFace> faces;
  if (deforming && deforming->surface) {
    cylinder = deforming->surface->cylinder, faces = deforming->surface->faces;
  } else {
    cylinder = {.X = pose_of_frame(model_, is_shell ? bearing.shell : bearing.journal),
                .R = bearing.film.R,
                .L = bearing.film.L,
                .is_bore = is_shell};
    const double tolerance = near_film_radius * cylinder.R;
    faces = fem::faces_on_cylinder(*mesh_, cylinder, tolerance);
    const SurfaceFunctions functions =
        faces.empty() ? SurfaceFunctions(4, 1, cylinder.L) : fem::functions_for(*mesh_, faces, cylinder);
    const fem::FilmSurfaceResult surface = fem::film_surface(*mesh_, faces, cylinder, functions, tolerance);
    if (!surface.solved())
      refuse_loads(
          request_.mesh ? "--mesh" : "--body",
          fmt::format("{}{}{}", request_.mesh_file, request_.mesh_file.empty() ? "" : ": ", surface.message),
          fmt::format("a mesh with the {} of bearing {}, in the axes of body {}", side, bearing.name, request_.body),
          surface.remedy);
    faces = surface.surface->faces;
  }
  Film film{.bearing = &bearing,
            .is_shell = is_shell,
            .group = group,
            .inboard = results_.text_attribute(group, "inboard").value_or(bearing.shell.body),
            .outboard = results_.text_attribute(group, "outboard").value_or(bearing.journal.body),
            .of_shell = pose_of_frame(model_, bearing.shell).R,
            .of_journal = pose_of_frame(model_, bearing.journal).R,
            .nodes = film::NodalField(bearing.film),
            .on_faces = fem::FacePressures(*mesh_, faces, cylinder),
            .cylinder = cylinder,
            .faces = {}};
  for (const fem::ElementFace& face : faces) {
    const auto same = [&](const fem::ElementFace& other) {
      return other.element == face.element && other.face == face.face;
    };
    const auto at = std::find_if(faces_.begin(), faces_.end(), same);
    film.faces.push_back(at - faces_.begin());
    if (at == faces_.end()) faces_.push_back(face);
  }
  films_.push_back(std::move(film));
}

const std::string& BodyLoads::body() const { return request_.body; }
const fem::Mesh& BodyLoads::mesh() const { return *mesh_; }
const std::vector<fem::ElementFace>& BodyLoads::faces() const { return faces_; }
const std::vector<double>& BodyLoads::times() const { return times_; }
const std::vector<double>& BodyLoads::crank_angles() const { return crank_angles_; }

std::vector<std::pair<std::string, std::vector<fem::ElementFace>>> BodyLoads::films() const {
  std::vector<std::pair<std::string, std::vector<fem::ElementFace>>> films;
  for (const Film& film : films_) {
    auto& [name, faces] = films.emplace_back(film.bearing->name, std::vector<fem::ElementFace>());
    for (const Index face : film.faces) faces.push_back(faces_[static_cast<std::size_t>(face)]);
  }
  return films;
}

std::optional<std::pair<double, double>> BodyLoads::cycle() const {
  const std::string cycles = films_.front().group + "cycles/fields/";
  if (!results_.has(cycles + "complete")) return std::nullopt;
  const std::vector<double> complete = results_.read(cycles + "complete").values;
  if (complete.empty() || complete.back() != 1) return std::nullopt;
  return std::pair(results_.read(cycles + "begin").values.back(), results_.read(cycles + "end").values.back());
}

std::vector<std::size_t> BodyLoads::last_cycle() const {
  const auto [begin, end] =
      cycle().value_or(std::pair(times_.empty() ? 0 : times_.front(), times_.empty() ? 0 : times_.back()));
  const double slack = 1e-9 * std::abs(end);  // round-off of times
  std::vector<std::size_t> instants;
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (times_[k] >= begin - slack && times_[k] <= end + slack) instants.push_back(k);
  return instants;
}

void BodyLoads::add(const Film& film, std::size_t instant, BodyLoadsAt& loads) const {
  const std::size_t row = rows_.at(instant);
  const auto field = [&](const char* name) -> VectorXd {
    const std::vector<double> values = results_.read_rows(film.group + "fields/" + name, instant, 1).values;
    return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
  };
  const VectorXd oil = field("pressure"), contact = field("asperity_pressure"), both = oil + contact;
  const double turned = film.turned(results_, row), side = film.is_shell ? 1 : -1;
  const auto on_mesh = [&](const VectorXd& values) {
    return [&film, &values, turned](double phi, double z) { return film.nodes.at(values, phi + turned, z); };
  };

  // The film's own sum, (film-surface.9). What its forces leave out where a pressure is cut off between nodes stands in
  // the row's force alone.
  const film::Grid& grid = film.bearing->film.grid;
  Vector6 wrench = Vector6::Zero();
  Vector3 of_oil = Vector3::Zero();
  for (int k = 0; k < grid.size(); ++k) {
    const double phi = grid.phi(k / grid.n_z), z = film.bearing->film.L * grid.z_over_L(k % grid.n_z);
    const double angle = phi - turned, area = film.nodes.weights()[k];
    const Vector3 e_r(std::cos(angle), std::sin(angle), 0);
    wrench.head<3>() += side * area * both[k] * (z * Vector3::UnitZ()).cross(e_r);
    wrench.tail<3>() += side * area * both[k] * e_r;
    of_oil += area * oil[k] * Vector3(std::cos(phi), std::sin(phi), 0);
  }
  Vector3 cut = vector_at(results_, film.group + "force_pressure", row) - of_oil;
  cut.z() = 0;
  wrench.tail<3>() += side * (Eigen::AngleAxisd(-turned, Vector3::UnitZ()) * cut);

  const VectorXd mean = film.on_faces.means(on_mesh(both)), pressure = film.on_faces.with_wrench(mean, wrench),
                 of_contact = film.on_faces.means(on_mesh(contact));
  const Vector6 mapped = film.on_faces.wrenches() * pressure, off = mapped - wrench;
  const double force = wrench.tail<3>().norm();
  if (force > 0) {
    loads.off_force = std::max(loads.off_force, off.tail<3>().norm() / force);
    loads.off_moment = std::max(loads.off_moment, off.head<3>().norm() / (force * film.bearing->film.L / 2));
  }
  loads.film += moved_force(film.cylinder.X, wrench);
  loads.mapped += moved_force(film.cylinder.X, mapped);
  loads.shear += vector_at(results_, film.group + "force_shear", row).norm();
  const bool is_warm = results_.has(film.temperature_field());
  VectorXd of_surface;
  if (is_warm) {
    of_surface =
        film.on_faces.means_within(on_mesh(field(film.is_shell ? "shell_temperature" : "journal_temperature")));
    if (loads.temperature.size() == 0) loads.temperature.setConstant(static_cast<Index>(faces_.size()), std::nan(""));
  }
  for (std::size_t f = 0; f < film.faces.size(); ++f) {
    loads.pressure[film.faces[f]] += pressure[static_cast<Index>(f)];
    loads.contact[film.faces[f]] += of_contact[static_cast<Index>(f)];
    if (is_warm) loads.temperature[film.faces[f]] = of_surface[static_cast<Index>(f)];
  }
}

BodyLoadsAt BodyLoads::at(std::size_t instant) const {
  BodyLoadsAt loads;
  loads.time = times_.at(instant);
  loads.pressure.setZero(static_cast<Index>(faces_.size()));
  loads.contact.setZero(static_cast<Index>(faces_.size()));
  for (const Film& film : films_) add(film, instant, loads);
  const std::size_t row = rows_.at(instant);
  if (!crank_angles_.empty()) loads.crank_angle = crank_angles_.at(instant);
  const std::string group = "/bodies/" + request_.body + "/";
  if (results_.has(group + "acceleration")) {
    const Matrix3 to_body = orientation_at(results_, request_.body, row).transpose();
    loads.acceleration = to_body * vector_at(results_, group + "acceleration", row);
    loads.angular_velocity = to_body * vector_at(results_, group + "angular_velocity", row);
  }
  return loads;
}

struct BodyLoads::NodalMeans {
  double mean = 0;  ///< over the film's surface [degC]
  std::vector<int> nodes;
  VectorXd T;  ///< [degC]
};

BodyLoads::NodalMeans BodyLoads::nodal_means(const Film& film, const std::vector<std::size_t>& instants,
                                             const std::vector<double>& weights) const {
  std::vector<VectorXd> fields;  // weighted by time
  std::vector<double> turned;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const std::vector<double> values = results_.read_rows(film.temperature_field(), instants[k], 1).values;
    const VectorXd weighted = weights[k] * Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
    const double angle = film.turned(results_, rows_.at(instants[k]));
    if (!fields.empty() && angle == turned.back())
      fields.back() += weighted;  // a mesh that does not rotate against its film, a shell's
    else
      fields.push_back(weighted), turned.push_back(angle);
  }
  const fem::FilmField over_time = [&](double phi, double z) {  // (film-surface.15)
    double T = 0;
    for (std::size_t k = 0; k < fields.size(); ++k) T += film.nodes.continued(fields[k], phi + turned[k], z);
    return T;
  };
  NodalMeans means;
  for (const VectorXd& field : fields) means.mean += film.nodes.weights().dot(field) / film.nodes.weights().sum();
  std::vector<fem::ElementFace> faces;
  for (const Index face : film.faces) faces.push_back(faces_[static_cast<std::size_t>(face)]);
  const fem::FaceTemperatures on_nodes(*mesh_, faces, film.cylinder);
  means.nodes = on_nodes.nodes();
  means.T = on_nodes.of(over_time, means.mean);
  return means;
}

FilmTemperatures BodyLoads::mean_temperatures(const std::vector<std::size_t>& instants) const {
  HERSEY_REQUIRE(!instants.empty() && std::is_sorted(instants.begin(), instants.end()), "instants in their order");
  std::vector<double> times;
  for (const std::size_t k : instants) times.push_back(times_.at(k));
  const std::vector<double> weights = weights_over_time(times);
  FilmTemperatures found;
  std::map<int, std::pair<double, int>> sums;  // of temperatures at a node, and their number
  for (const Film& film : films_) {
    if (!results_.has(film.temperature_field())) continue;
    const NodalMeans means = nodal_means(film, instants, weights);
    found.surfaces.push_back({film.bearing->name, means.mean});
    for (std::size_t a = 0; a < means.nodes.size(); ++a) {
      auto& [sum, count] = sums[means.nodes[a]];
      sum += means.T[static_cast<Index>(a)], ++count;
    }
  }
  found.T.resize(static_cast<Index>(sums.size()));
  for (const auto& [node, sum] : sums) {
    found.T[static_cast<Index>(found.nodes.size())] = sum.first / sum.second;
    found.nodes.push_back(node);
  }
  return found;
}

}  // namespace hersey::run
