#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hersey::workbench {

/// Writes into the record of a run how its study is to be done: `{on, jobs, partition}` of a request.
/// @throws Refused 422 for what `hersey study` does not take
void note_study(const nlohmann::json& request, nlohmann::json& record);

/// Options of `hersey study` that a record asks for; what the program has not written into it is left out.
void add_study_words(const nlohmann::json& record, std::vector<std::string>& words);

}  // namespace hersey::workbench
