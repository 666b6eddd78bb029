#pragma once

#include <memory>
#include <string>

#include "hersey/film/body_journal.h"
#include "hersey/film/body_wall.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// What the heat of a bearing's film does to the body its shell is in, null where the shell is none (theory manual,
/// thermal.35, thermal.36). Films of other bearings on that body give it no heat.
/// @throws InputError where the body has no steady temperature, or what keeps it in place leaves it a motion
/// @cost a factorisation of the mesh for temperatures and, where it expands, one for displacements; a solution of each
///   per angle of the film's grid
[[nodiscard]] std::shared_ptr<const film::WallConduction> wall_conduction(const Model& model, const Bearing& bearing);

/// Likewise to the body its journal is in, evenly around (theory manual, thermal.59, thermal.61).
/// @throws InputError as wall_conduction() @cost a factorisation each, and two or three solutions
[[nodiscard]] std::shared_ptr<const film::JournalConduction> journal_conduction(const Model& model,
                                                                                const Bearing& bearing);

/// All that `wall_conduction` depends on, in a row: equal for models with the same answer.
[[nodiscard]] std::string fingerprint_of_wall(const Model& model, const Bearing& bearing);
/// Likewise `journal_conduction`.
[[nodiscard]] std::string fingerprint_of_journal(const Model& model, const Bearing& bearing);

}  // namespace hersey::model
