#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "edited.h"
#include "good_model.h"
#include "hersey/model/read.h"

namespace hersey::model {

/// Returns the faults that the reader reports for `text`, one a line.
inline std::string faults_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)read_text(text, "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

/// Returns the faults that the reader reports for the good model with `from` replaced by `to`.
inline std::string faults_after(const std::string& from, const std::string& to) {
  return faults_of(edited(good_model, from, to));
}

}  // namespace hersey::model
