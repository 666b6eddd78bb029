#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numbers>

#include "bindings.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/load_vectors.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/reduced_body_file.h"
#include "hersey/fem/reduction.h"
#include "hersey/fem/stress.h"
#include "hersey/fem/vibration.h"

namespace hersey::python {
namespace {

namespace py = pybind11;
using Names = std::vector<std::string>;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

[[noreturn]] void refuse(const std::string& where, std::string found, std::string expected, std::string hint = {}) {
  throw InputError(Fault{{"", 0, 0}, where, std::move(found), std::move(expected), std::move(hint)});
}

// What Python gives for a material: empty texts leave it to the mesh file.
fem::SolidMaterial material_of(const fem::MeshMaterial& in_file, const Names& given) {
  const auto value = [&](const char* name, std::size_t at, const char* unit, const std::optional<double>& known) {
    if (!given[at].empty()) return parse_quantity(given[at], unit);
    if (!known) refuse(name, "the mesh file does not say it", "a value, such as " + dimension_of(unit).example);
    return *known;
  };
  fem::ElasticMaterial material;
  material.youngs_modulus = value("youngs_modulus", 0, "Pa", in_file.youngs_modulus);
  material.poisson_ratio =
      given[1].empty() && !in_file.poisson_ratio
          ? (refuse("poisson_ratio", "the mesh file does not say it", "a number, such as 0.3"), 0.0)
          : (given[1].empty() ? *in_file.poisson_ratio : parse_quantity(given[1], "1"));
  material.density = value("density", 2, "kg/m^3", in_file.density);
  if (!(material.youngs_modulus > 0)) refuse("youngs_modulus", given[0], "a modulus > 0, such as 210 GPa");
  if (!(-1 < material.poisson_ratio && material.poisson_ratio < 0.5))
    refuse("poisson_ratio", given[1], "a ratio between -1 and 0.5");
  if (!(material.density > 0)) refuse("density", given[2], "a density > 0, such as 7850 kg/m^3");
  return fem::isotropic(material);
}

std::shared_ptr<fem::ElasticBody> read_body(const std::string& file, const std::string& length_unit,
                                            const Names& material) {
  std::vector<Fault> warnings, material_faults;
  fem::Mesh mesh = fem::read_mesh(file, convert_to_si({1, length_unit}, "m"), &warnings, &material_faults);
  if (std::vector<Fault> faults = fem::faults_of(fem::quality_of(mesh), file); !faults.empty())
    throw InputError(std::move(faults));
  const bool is_of_file = std::any_of(material.begin(), material.end(), [](const auto& text) { return text.empty(); });
  if (is_of_file && !material_faults.empty()) throw InputError(material_faults);
  std::vector<fem::MeshMaterial> in_file = mesh.materials;
  if (in_file.empty()) in_file.emplace_back();
  std::vector<fem::SolidMaterial> materials;
  for (const fem::MeshMaterial& each : in_file) materials.push_back(material_of(each, material));
  return std::make_shared<fem::ElasticBody>(fem::assemble(std::move(mesh), std::move(materials)));
}

const std::vector<int>& nodes_of(const fem::Mesh& mesh, const std::string& set) {
  Names names;
  for (const auto& [name, nodes] : mesh.node_sets) names.push_back(name);
  const auto found = mesh.node_sets.find(set);
  if (found == mesh.node_sets.end())
    refuse("", "no set '" + set + "' in the mesh", names.empty() ? "a mesh with sets" : one_of(names),
           did_you_mean(set, names));
  return found->second;
}

std::vector<fem::ElementFace> faces_of(const fem::Mesh& mesh, const std::string& name) {
  std::vector<fem::ElementFace> faces = fem::faces_called(mesh, name);
  if (faces.empty()) {
    (void)nodes_of(mesh, name);
    refuse("", "'" + name + "' has no faces", "a surface, or a set of nodes that spans faces");
  }
  return faces;
}

std::vector<int> fixed_dofs(const fem::Mesh& mesh, const Names& hold) {
  std::vector<int> dofs;
  for (const std::string& set : hold)
    for (const int dof : fem::dofs_of(nodes_of(mesh, set))) dofs.push_back(dof);
  return dofs;
}

RowMajor by_node(const Eigen::VectorXd& u) { return Eigen::Map<const RowMajor>(u.data(), u.size() / 3, 3); }

// frequencies [Hz], shapes (modes, nodes, 3), rigid modes
std::tuple<Eigen::VectorXd, std::vector<RowMajor>, int> modes(const fem::ElasticBody& body, const Names& hold,
                                                              int count) {
  const fem::Vibration found = fem::natural_modes(body, fixed_dofs(body.mesh, hold), {.count = count});
  if (!found.solved()) throw std::runtime_error(found.message);
  std::vector<RowMajor> shapes;
  for (Eigen::Index k = 0; k < found.omega.size(); ++k) shapes.push_back(by_node(found.shapes.col(k)));
  return {found.omega / (2 * std::numbers::pi), std::move(shapes), found.rigid};
}

struct StaticResult {
  RowMajor displacement, reaction, stress;
  Eigen::VectorXd von_mises;
  double energy = 0;
};

StaticResult solve_static(const fem::ElasticBody& body, const Names& hold,
                          const std::map<std::string, double>& pressure,
                          const std::map<std::string, Eigen::Vector3d>& force, const Eigen::Vector3d& gravity) {
  Eigen::VectorXd f = fem::gravity_load(body, gravity);
  for (const auto& [name, p] : pressure) f += fem::pressure_load(body.mesh, faces_of(body.mesh, name), p);
  for (const auto& [name, total] : force)
    if (total.norm() > 0)
      f += total.norm() * fem::spread_force(body.mesh, faces_of(body.mesh, name), total.normalized());
  std::vector<fem::Support> supports;
  for (const int dof : fixed_dofs(body.mesh, hold)) supports.push_back({dof, 0});
  const fem::StaticSolution solution = fem::solve_static(body, supports, f);
  if (!solution.is_supported) refuse("hold", solution.message, "sets that leave no motion free");
  if (!solution.solved()) throw std::runtime_error(solution.message);
  const fem::Stress stress = fem::recover_stress(body, solution.u.col(0));
  return {by_node(solution.u.col(0)), by_node(solution.reaction.col(0)), stress.nodal.transpose(),
          stress.nodal_von_mises, stress.energy};
}

// Frames by name, each on a set of nodes: its centre is the origin, as of `hersey reduce --frame`.
std::shared_ptr<fem::ReducedBody> reduce(const fem::ElasticBody& body,
                                         const std::vector<std::tuple<std::string, std::string, bool>>& frames,
                                         int modes, const Names& loads, int harmonics, double static_error) {
  std::vector<fem::InterfaceFrame> placed;
  for (const auto& [name, set, is_rigid] : frames) {
    fem::InterfaceFrame frame;
    frame.name = name;
    frame.connection = is_rigid ? fem::Connection::rigid : fem::Connection::average;
    frame.nodes = nodes_of(body.mesh, set);
    frame.origin = fem::face_centre(body.mesh, frame.nodes);
    if (!is_rigid) frame.weights = fem::face_weights(body.mesh, frame.nodes);
    placed.push_back(fem::braced(body.mesh, std::move(frame)));
  }
  fem::ReductionOptions options;
  options.modes = modes;
  for (const std::string& name : loads) {
    (void)faces_of(body.mesh, name);
    options.surfaces.push_back(fem::loaded_surface(body.mesh, name, harmonics));
  }
  if (static_error > 0) options.static_error = static_error;
  fem::Reduction reduction = fem::reduce(body, placed, options);
  if (!reduction.solved()) throw std::runtime_error(reduction.message);
  return std::make_shared<fem::ReducedBody>(std::move(reduction.body));
}

RowMajor positions(const std::vector<Vector3>& nodes) {
  RowMajor x(static_cast<Eigen::Index>(nodes.size()), 3);
  for (std::size_t k = 0; k < nodes.size(); ++k) x.row(static_cast<Eigen::Index>(k)) = nodes[k].transpose();
  return x;
}

Names sets_of(const fem::ElasticBody& body) {
  Names names;
  for (const auto& [name, nodes] : body.mesh.node_sets) names.push_back(name);
  return names;
}

}  // namespace

void bind_fem(py::module_& core) {
  using Guard = py::call_guard<py::gil_scoped_release>;
  py::class_<fem::ElasticBody, std::shared_ptr<fem::ElasticBody>>(core, "ElasticBody")
      .def_property_readonly("nodes", [](const fem::ElasticBody& b) { return positions(b.mesh.nodes); })
      .def_property_readonly("labels", [](const fem::ElasticBody& b) { return b.mesh.node_labels; })
      .def_property_readonly("sets", &sets_of)
      .def_property_readonly("mass", [](const fem::ElasticBody& b) { return b.mass; })
      .def("modes", &modes, Guard())
      .def("solve_static", &solve_static, Guard())
      .def("reduce", &reduce, Guard());
  py::class_<StaticResult>(core, "StaticResult")
      .def_readonly("displacement", &StaticResult::displacement)
      .def_readonly("reaction", &StaticResult::reaction)
      .def_readonly("stress", &StaticResult::stress)
      .def_readonly("von_mises", &StaticResult::von_mises)
      .def_readonly("energy", &StaticResult::energy);
  py::class_<fem::ReducedBody, std::shared_ptr<fem::ReducedBody>>(core, "ReducedBody")
      .def_property_readonly("stiffness", [](const fem::ReducedBody& b) { return b.K; })
      .def_property_readonly("mass", [](const fem::ReducedBody& b) { return b.M; })
      .def_property_readonly("shapes", [](const fem::ReducedBody& b) { return b.Phi; })
      .def_property_readonly(
          "frequencies",
          [](const fem::ReducedBody& b) -> Eigen::VectorXd { return b.internal_omega / (2 * std::numbers::pi); })
      .def(
          "save", [](const fem::ReducedBody& b, const std::string& path) { fem::write_reduced_body(path, b); },
          Guard());
  core.def("read_body", &read_body, Guard());
}

}  // namespace hersey::python
