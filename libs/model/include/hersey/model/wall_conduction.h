#pragma once

#include <memory>
#include <string>

#include "hersey/film/body_journal.h"
#include "hersey/film/body_wall.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// Returns the response of the body that contains the shell to the heat of the bearing's film, null if the shell is not
/// a body (theory manual, thermal.35, thermal.36). Films of other bearings on that body give it no heat.
/// @throws InputError if the body has no steady temperature, or its supports leave it a rigid motion @cost a
///         factorisation of the mesh for temperatures and, if it expands, one for displacements; a solution of each per
///         angle of the film's grid
[[nodiscard]] std::shared_ptr<const film::WallConduction> wall_conduction(const Model& model, const Bearing& bearing);

/// Returns the response of the body that contains the journal, evenly around (theory manual, thermal.59, thermal.61).
/// @throws InputError as wall_conduction() @cost a factorisation each, and two or three solutions
[[nodiscard]] std::shared_ptr<const film::JournalConduction> journal_conduction(const Model& model,
                                                                                const Bearing& bearing);

/// Returns the surroundings of a body that conducts heat: its cooled faces, without the faces of films in its remaining
/// surface (`cooling: {rest: ...}`), and its nodes of given temperature. @pre the body has `heat`
[[nodiscard]] fem::ThermalSurroundings surroundings_of(const Model& model, const Body& body);

/// Returns all data on which `wall_conduction` depends: equal for models with the same result.
[[nodiscard]] std::string fingerprint_of_wall(const Model& model, const Bearing& bearing);
/// Returns all data on which `journal_conduction` depends.
[[nodiscard]] std::string fingerprint_of_journal(const Model& model, const Bearing& bearing);

}  // namespace hersey::model
