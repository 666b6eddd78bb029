#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/core/spatial.h"
#include "hersey/model/model.h"
#include "hersey/results/writer.h"

namespace hersey::run {

/// The positions of a machine at its start and along its joints, for drawing it before it runs: loops are closed by the
/// assembly of the start, but nothing is asked of forces, films and masses, and deformable bodies keep their shape. It
/// takes milliseconds where the start of the run takes films and reduced meshes.
/// @verified_by picture_test.cpp
class Picture {
 public:
  /// @param model  outlives this
  explicit Picture(const model::Model& model);
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  ~Picture();

  /// Unsolved where loops stay open at the start, with the distances; the poses are then the closest found.
  [[nodiscard]] const Outcome& assembly() const;

  /// Names of the bodies and their poses in ground, in the order of the model.
  [[nodiscard]] std::vector<std::pair<std::string, Pose>> poses() const;
  /// Value of a scalar joint coordinate [rad or m]. @throws InputError if there is none of that name
  [[nodiscard]] double coordinate(const std::string& joint, const std::string& name) const;
  /// Largest constraint residual of these poses, relative to the lengths and angles compared.
  [[nodiscard]] double residual() const;

  /// Moves one joint coordinate to `value` [rad or m]; drives are released, all else follows as the loops demand and
  /// keeps still where they do not. The coordinate goes there in small steps, so that loops stay on their branch.
  /// @returns unsolved, with the reason and the poses left as they were, where a loop does not close on the way
  /// @throws InputError if there is no such coordinate
  [[nodiscard]] Outcome move(const std::string& joint, const std::string& name, double value);

  /// Writes what a results file has for pictures (docs/results-file.md) and one row: shapes, joints, bearings and
  /// forces with their bodies, the poses of bodies and the coordinates of joints.
  void write(results::Writer& writer) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::run
