#include "hersey/fem/load_vectors.h"

#include "surface/face_quadrature.h"

namespace hersey::fem {
Eigen::VectorXd gravity_load(const ElasticBody& body, const Vector3& g) {
  const Eigen::VectorXd nodal = body.m * Eigen::VectorXd::Ones(body.node_count());
  Eigen::VectorXd f(body.size());
  for (Eigen::Index a = 0; a < nodal.size(); ++a) f.segment<3>(3 * a) = nodal[a] * g;
  return f;
}

Eigen::VectorXd traction_load(const Mesh& mesh, const std::vector<ElementFace>& faces, const Traction& traction) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const ElementFace& face : faces)
    visit_face(mesh, face, [&](const std::vector<int>& nodes, const FacePoint& point) {
      const Vector3 force = point.area * traction(point.x, point.normal);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        f.segment<3>(3 * nodes[a]) += point.N[static_cast<Eigen::Index>(a)] * force;
    });
  return f;
}

Eigen::VectorXd pressure_load(const Mesh& mesh, const std::vector<ElementFace>& faces, double pressure) {
  return traction_load(mesh, faces,
                       [&](const Vector3&, const Vector3& normal) -> Vector3 { return -pressure * normal; });
}

std::vector<double> nodal_areas(const Mesh& mesh, const std::vector<ElementFace>& faces, const std::vector<int>& index,
                                std::size_t count) {
  std::vector<double> areas(count, 0);
  for (const ElementFace& face : faces) {
    NodeValues squares;
    std::vector<int> of_face;
    double area = 0;
    visit_face(mesh, face, [&](const std::vector<int>& nodes, const FacePoint& point) {
      if (of_face.empty()) squares.setZero(point.N.size());
      of_face = nodes;
      squares += point.area * point.N.cwiseAbs2();
      area += point.area;
    });
    for (std::size_t a = 0; a < of_face.size(); ++a)
      areas[static_cast<std::size_t>(index[static_cast<std::size_t>(of_face[a])])] +=
          area * squares[static_cast<Eigen::Index>(a)] / squares.sum();
  }
  return areas;
}

Eigen::Matrix3Xd nodal_normals(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const ElementFace& face : faces) {
    Eigen::Matrix3Xd of_face;
    std::vector<int> at;
    double squares = 0;
    visit_face(mesh, face, [&](const std::vector<int>& nodes, const FacePoint& point) {
      if (at.empty()) of_face.setZero(3, point.N.size());
      at = nodes;
      of_face += point.area * point.normal * point.N.cwiseAbs2().transpose();
      squares += point.area * point.N.squaredNorm();
    });
    // Weights as in nodal_areas: with int N_a dA midside nodes would carry the whole load.
    const double share = area_of(mesh, {face}) / squares;
    for (std::size_t a = 0; a < at.size(); ++a) normals.col(at[a]) += share * of_face.col(static_cast<Eigen::Index>(a));
  }
  return normals;
}

double area_of(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  double area = 0;
  for (const ElementFace& face : faces)
    visit_face(mesh, face, [&](const std::vector<int>&, const FacePoint& point) { area += point.area; });
  return area;
}

}  // namespace hersey::fem
