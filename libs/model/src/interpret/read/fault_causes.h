#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "tree/source_tree.h"

namespace hersey::model {

/// Removes what follows from a key that is spelled wrongly: the key that is missing for it, and all that refers to what
/// stands in it. Faults that the text would not have with the key as it is meant are gone; the unknown key stays.
/// @param root    the document as it is written
/// @param faults_of  the faults of another document, tidied
/// @verified_by read_fault_test.cpp
[[nodiscard]] std::vector<Fault> without_consequences(std::vector<Fault> faults, const Node& root,
                                                      const std::function<std::vector<Fault>(const Node&)>& faults_of);

/// Leads to a parameter where none of its uses takes its value, as with a wrong unit: one fault at the parameter in
/// place of one at each use.
/// @param text  of the document
/// @verified_by read_fault_test.cpp
void lead_to_parameters(const std::string& text, const Node& root, std::vector<Fault>& faults);

}  // namespace hersey::model
