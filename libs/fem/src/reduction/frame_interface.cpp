#include "reduction/frame_interface.h"

#include <fmt/format.h>

#include "hersey/fem/frame_motion.h"
#include "hersey/fem/ties.h"
#include "reduction/interface_motion.h"

namespace hersey::fem {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr double kLargestTieResidual =
    0.1;  // of a frame's own displacement: two frames differ by all of it, a gap of a tie by little

std::string tie_fault(const std::vector<InterfaceFrame>& frames, const Interface& interface) {
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (Index k = 6 * static_cast<Index>(f); k < 6 * static_cast<Index>(f) + 6; ++k)
      if (interface.tie_residual.rows() > 0 &&
          interface.tie_residual.col(k).cwiseAbs().maxCoeff() >
              kLargestTieResidual * interface.prescribed.col(k).cwiseAbs().maxCoeff())
        return fmt::format(
            "frame '{}' and another one are both rigid and hold nodes that a tie of the mesh joins; take nodes that "
            "are "
            "not tied, or the connection `average`",
            frames[f].name);
  return {};
}

}  // namespace

std::string fault_of(const Mesh& mesh, const std::vector<InterfaceFrame>& frames) {
  std::vector<const InterfaceFrame*> owner(mesh.nodes.size(), nullptr);
  for (const InterfaceFrame& frame : frames) {
    if (frame.nodes.empty()) return fmt::format("frame '{}' sits on no node", frame.name);
    if (!nodes_span_rotations(mesh, frame))
      return fmt::format(
          "the nodes of frame '{}' lie on one line, about which nothing would fix it; take a face or an edge that "
          "bends, or the connection `average`, which rotates with the elements around",
          frame.name);
    if (frame.connection == Connection::average) continue;
    for (const int node : frame.nodes) {
      const InterfaceFrame*& taken = owner[static_cast<std::size_t>(node)];
      if (taken && taken != &frame)
        return fmt::format("frames '{}' and '{}' are both rigid and share node {}", taken->name, frame.name,
                           mesh.node_labels.empty() ? node + 1 : mesh.node_labels[static_cast<std::size_t>(node)]);
      taken = &frame;
    }
  }
  return mesh.ties.empty() ? "" : tie_fault(frames, interface_of(mesh, frames));
}

Interface interface_of(const Mesh& mesh, const std::vector<InterfaceFrame>& frames) {
  Interface interface;
  const auto dofs = 3 * static_cast<Index>(mesh.nodes.size()), coordinates = 6 * static_cast<Index>(frames.size());
  interface.prescribed = MatrixXd::Zero(dofs, coordinates);
  interface.motion = MatrixXd::Zero(coordinates, coordinates);
  std::vector<Eigen::Triplet<double>> entries;
  Index rows = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const InterfaceFrame& frame = frames[f];
    const auto first = 6 * static_cast<Index>(f);
    if (frame.connection == Connection::rigid) {
      for (const int node : frame.nodes)
        interface.prescribed.block<3, 6>(3 * node, first) =
            frame_to_node(frame, mesh.nodes[static_cast<std::size_t>(node)]);
      const std::vector<int> fixed_dofs = dofs_of(frame.nodes);
      interface.fixed_dofs.insert(interface.fixed_dofs.end(), fixed_dofs.begin(), fixed_dofs.end());
      continue;
    }
    const Eigen::SparseMatrix<double> C = frame_motion(mesh, frame);
    for (Index j = 0; j < C.outerSize(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(C, j); entry; ++entry)
        entries.emplace_back(static_cast<int>(rows + entry.row()), static_cast<int>(j), entry.value());
    interface.motion.block<6, 6>(rows, first).setIdentity();
    rows += 6;
  }
  const TieConstraints ties = tie_constraints(mesh, interface.fixed_dofs);
  for (Index j = 0; j < ties.C.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(ties.C, j); entry; ++entry)
      entries.emplace_back(static_cast<int>(rows + entry.row()), static_cast<int>(j), entry.value());
  interface.tie_residual = ties.on_fixed * interface.prescribed;
  const Index averages = rows;
  rows += ties.C.rows();
  interface.C.resize(rows, dofs);
  interface.C.setFromTriplets(entries.begin(), entries.end());
  interface.motion.conservativeResize(rows, coordinates);
  interface.motion.bottomRows(rows - averages).setZero();
  return interface;
}

MatrixXd constraint_modes(const ElasticBody& body, const Interface& interface, const ConstrainedStiffness& stiffness) {
  const MatrixXd d = interface.motion - interface.C * interface.prescribed;
  return interface.prescribed + stiffness.solve(-(body.K * interface.prescribed), d);
}

}  // namespace hersey::fem
