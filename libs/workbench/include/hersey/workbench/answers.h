#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "hersey/workbench/refused.h"

namespace hersey::workbench {

class Kept;

/// What the texts of models say: answers of the workbench to its page, JSON in and JSON out, without any HTTP.
///
/// A request names a model file by `path`, relative to the folder, and brings its text, which need not be saved. Files
/// that the model names (tables, meshes) are read beside it. Lines and columns count from 1, columns in UTF-16 units as
/// editors in browsers count them; 0 means unknown. A wrong model is an answer with faults; what cannot be answered is
/// thrown as Refused.
///
/// Answers may be asked from several threads at once. Models read lately and solutions of bearings are kept, the
/// oldest dropped.
/// @verified_by answers_check_test.cpp, answers_scene_test.cpp, answers_bearing_test.cpp, answers_edit_test.cpp
class Answers {
 public:
  /// @param folder  where the paths of requests start
  explicit Answers(const std::filesystem::path& folder);
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;
  ~Answers();

  /// `{path, text, set: ["load=500 N"], depth: "text"|"start", scene: true}` -> `{faults: [F], warnings: [F], runs,
  /// parameters: {name: text}, scene: S|null, missing: [...], outline: [...], left_out: {faults, warnings, outline},
  /// depth, time}`. At most 500 faults, warnings and parts of the outline are listed; `left_out` counts the others.
  ///
  /// With the depth `text` faults are those of the reader; with `start`, the usual one, also those of the start of the
  /// run, which takes longer: a loop that does not close, a journal that touches its shell, and the warnings about it.
  /// F = `{line, column, endLine, endColumn, file, path, message, found, expected, suggestion, repairs: [{label, edits:
  /// [{line, column, endLine, endColumn, text}]}]}`; `file` is relative to the folder, and repairs are of the text of
  /// the request. `missing` lists the parts that a run, or without bodies a bearing, still needs.
  ///
  /// S is a run with one instant, as the front end of the report reads it, with `sources` and `bearings` beside: see
  /// scene(). It is null where the text cannot be read as a model; a model that cannot start is drawn as far as it can
  /// be assembled.
  [[nodiscard]] std::string check(std::string_view request) const;

  /// `{path, text, set, joint, coordinate, value}` -> `{bodies: {name: {position: [3], orientation: [w, x, y, z]}},
  /// joints: {name: [{name, unit, value}]}, residual}`: the machine with that coordinate (without `coordinate`: the
  /// joint's first) at `value` [rad or m]. Drives are released, loops close by the assembly of the mechanism on the
  /// branch on which they start; what no loop moves keeps still. Refused with 422 where a loop does not close.
  [[nodiscard]] std::string move(std::string_view request) const;

  /// `{path, text, bearing, set: ["load=500 N"], previous: id, averaged: false, fields: ["pressure", "thickness"]}` ->
  /// `{id, solved, message, figures: [{key, group, name, unit, value, words}], position: {e, angle, ratio}, solution,
  /// conditions, warnings, started_from, averaged, grid, time, solving}`. Names in `set` are parameters, key paths or
  /// the short names of `hersey bearing`; a load replaces a position of the text and the other way round.
  ///
  /// `solution` is what a page of a bearing by itself reads of one solution (SolutionText of web/src/data.ts), with the
  /// fields asked for. The solution is kept under `id`, so that the next one, `previous`, starts from it. Without
  /// `averaged`, stiffness and damping are those of the grid alone: quicker, and less exact by some percent.
  /// No error of the grid is estimated.
  [[nodiscard]] std::string bearing(std::string_view request) const;

  /// `{path, length_unit: "mm"}` -> what `hersey mesh --json` tells of a mesh file of the folder: sizes, sets,
  /// `found` surfaces that could be bores or journals; and `lines`, the text of a model that uses them. `uses`: for
  /// each surface that the file names `{name, key, frame, bearing}`, the value of a frame there and of the bearing that
  /// it could be, of the body `body`. With `picture: true` also the triangles of every surface, and of the rest.
  [[nodiscard]] std::string mesh_info(std::string_view request) const;

  /// `{path, length_unit, output}` -> `{path}`: writes the mesh with its found surfaces by name, as `hersey mesh
  /// --output` does, in metres and without materials. An existing file is left as it is: 409.
  [[nodiscard]] std::string name_surfaces(std::string_view request) const;

  /// `{key}` -> `{title, text, kind, unit, units, default, required, allowed: [{text, meaning}], keys: [...], example,
  /// plain}` as `hersey explain`; `plain` is its text, with all variants.
  [[nodiscard]] std::string explain(std::string_view request) const;
  /// `{text: "45 mm", unit: "in"}` -> `{text: "1.7716535 in", units: ["mm", ...]}`; without `unit` the units alone.
  [[nodiscard]] std::string convert(std::string_view request) const;
  /// The JSON Schema of model files, as `hersey schema`.
  [[nodiscard]] std::string schema() const;

  /// `{path, text, key: "bearings.main.features.hole.phi", value: "45 deg"}` -> `{text, edits: [...]}`: the value is
  /// replaced, or the key inserted where it is missing; null removes it. Comments, order and layout of all the rest
  /// stay; where the text is written so that anything else would change, the request is refused with 422.
  [[nodiscard]] std::string set_value(std::string_view request) const;

  /// The models of `hersey init`: `[{name, title, text}]`.
  [[nodiscard]] std::string templates() const;
  /// The examples that came with the program, if they are found: `[{name: "slider_crank/model.yaml", title, text}]`.
  [[nodiscard]] std::string examples() const;
  /// `{template}` or `{example}` -> `{scene}`, as of check(). Files that an example names are those beside it.
  [[nodiscard]] std::string template_scene(std::string_view request) const;
  /// `{template, path}` -> `{path}`: writes a new model into the folder; `{example, path}` -> `{path, files}` a copy of
  /// an example, with the tables and meshes that it reads at the same places beside it. An existing file is left as it
  /// is: 409.
  std::string new_model(std::string_view request) const;

 private:
  std::unique_ptr<Kept> kept_;
};

}  // namespace hersey::workbench
