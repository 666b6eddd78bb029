#pragma once

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/reduction.h"
#include "hersey/mbd/modal_body.h"

namespace hersey::mbd {

/// Returns the reduced body with the static shapes alone: those of its frames, and its film modes.
[[nodiscard]] ModalBodyData static_data(const fem::ElasticBody& body, const fem::ReducedBody& reduced,
                                        const RayleighDamping& damping);

/// Returns the reduced body for strains of any size: the nodes of a frame move rigidly at any rotation, the others
/// respond as those of the undeformed body (theory manual eq. (flexible-bodies.22)). `damping` is that by mass alone.
/// @pre the frames but the first are rigid
[[nodiscard]] ModalBodyData finite_data(const fem::ElasticBody& body, const fem::ReducedBody& reduced,
                                        const RayleighDamping& damping);

/// Returns the constraints that separate the nodes' own displacements from the static shapes: they move no frame, and
/// the pressures that the film modes answer do no work on them (theory manual eq. (flexible-bodies.28)).
[[nodiscard]] fem::FrameSupports supports_of(const fem::ElasticBody& body, const fem::ReducedBody& reduced);

}  // namespace hersey::mbd
