#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "hersey/model/read.h"

namespace hersey::model {

/// One parameter's value in one run of a study.
struct StudyValue {
  std::string name;   ///< the parameter or key path
  std::string text;   ///< as written, "100 N"
  double number = 0;  ///< in `unit`; 0 if the value is a word
  std::string unit;   ///< unit of the parameter's first value, common to all runs; empty for a bare number or a word
};

/// One combination of the study's parameters.
struct StudyRun {
  std::vector<std::string> overrides;  ///< given overrides followed by the study's; arguments of `read`
  std::string label;                   ///< "load = 100 N, clearance = 34 um"
  std::string slug;                    ///< the same, fit for a file name: "load_100_N-clearance_34_um"
  std::vector<StudyValue> values;      ///< in the order of study.parameters
};

/// The parameters of the study that vary: a parameter named in `overrides` is fixed at that value. Each is checked at
/// every value, or at the ends of its distribution. None if the model has no study.
/// @throws InputError with the faults of the file and of every such value.
[[nodiscard]] std::vector<StudyParameter> check_study(const ModelFile& file,
                                                      const std::vector<std::string>& overrides = {});
/// Opens the file at `path` first.
[[nodiscard]] std::vector<StudyParameter> check_study(const std::string& path,
                                                      const std::vector<std::string>& overrides = {});

/// Returns a fingerprint of all data, besides the values given to it, that decide the result of a run of the model file
/// at `path`: the content of the file and of all files it names, without comments, texts and the study. 16 hexadecimal
/// digits.
/// @throws InputError
[[nodiscard]] std::string model_fingerprint(const std::string& path);

/// Every run of a study that writes them out (Study::is_written_out): combinations of study.parameters, the last
/// parameter varying fastest; empty if the model has no study. A study parameter named in `overrides` is fixed at that
/// value and no longer varied.
/// @throws InputError with the faults of the file and of every combination; for a plan that draws its runs.
[[nodiscard]] std::vector<StudyRun> expand_study(const ModelFile& file, const std::vector<std::string>& overrides = {});
/// Opens the file at `path` first.
[[nodiscard]] std::vector<StudyRun> expand_study(const std::string& path,
                                                 const std::vector<std::string>& overrides = {});

/// Every combination of `parameters`, as expand_study for parameters that do not stand in the file.
/// @throws InputError with the faults of the file and of every value.
[[nodiscard]] std::vector<StudyRun> expand_parameters(const ModelFile& file, const std::vector<std::string>& overrides,
                                                      const std::vector<StudyParameter>& parameters);
/// Opens the file at `path` first.
[[nodiscard]] std::vector<StudyRun> expand_parameters(const std::string& path,
                                                      const std::vector<std::string>& overrides,
                                                      const std::vector<StudyParameter>& parameters);

}  // namespace hersey::model
