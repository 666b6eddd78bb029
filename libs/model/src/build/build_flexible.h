#pragma once

#include "build/fingerprint.h"
#include "hersey/core/input_error.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/reduction.h"
#include "hersey/model/machine.h"

namespace hersey::model {

/// Assembles and reduces the mesh of a flexible body, or takes it from one reduced before that was the same.
/// @param surfaces  of bearings that lie on it: it gets their film modes
/// @param starts_undeformed whether its nodes start undeformed, not as forces hold them
/// @param kept      receives what it keeps of each
/// @throws InputError at the body's line: folded elements, frames that share nodes, parts that nothing holds, a mesh
/// that
///         does not fit into memory.
[[nodiscard]] BuiltFlexible build_flexible(const Body& body, const std::vector<const DeformingSurface*>& surfaces,
                                           bool starts_undeformed, std::vector<BuiltSurface>& kept);

/// The shapes of a modal body. @throws InputError as build_flexible
[[nodiscard]] mbd::ModalBodyData modal_shapes(const Body& body, const std::vector<const DeformingSurface*>& surfaces);

/// The mesh of a flexible body, its frames on it, and the fault of one that its frames do not hold.
[[nodiscard]] fem::ElasticBody assembled(const Body& body);
[[nodiscard]] std::vector<fem::InterfaceFrame> interface_frames(const Body& body);
[[nodiscard]] InputError insufficient_supports(const Body& body, const std::string& why);

/// Everything that the reduced body depends on.
void add_reduction(const Body& body, const std::vector<const DeformingSurface*>& surfaces, Fingerprint& print);

/// Surfaces of bearings that lie on the mesh of `body`, in the order of the bearings, the shell's first.
[[nodiscard]] std::vector<const DeformingSurface*> surfaces_on(const Model& model, const Body& body);

/// A bearing's surface by shapes of its body, displacements `U` of the nodes (3 nodes, shapes), in the axes of the
/// body's frame `frame` ("": its own axes).
[[nodiscard]] std::shared_ptr<const bearing::ElasticSurface> elastic_surface(const DeformingSurface& surface,
                                                                             const Body& body, const std::string& frame,
                                                                             const Eigen::MatrixXd& U);

}  // namespace hersey::model
