#include "bearing_page.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <utility>

#include "bearing_table.h"
#include "hersey/core/version.h"
#include "hersey/run/assumptions.h"
#include "hersey/study/shear_remarks.h"
#include "hersey/workbench/solution_page.h"

namespace hersey::cli {
namespace {

using study::BearingSolution;

report::PageSolution page_with_remark(const BearingSolution& solution) {
  report::PageSolution page = workbench::page_of(solution);
  if (solution.solved()) page.remark = whirl_remark(solution);
  return page;
}

}  // namespace

report::BearingPage bearing_page(const BearingArguments& arguments, const model::Model& model,
                                 const std::vector<BearingSolution>& solutions) {
  const model::Bearing& bearing = study::bearing_called(model, arguments.bearing);
  report::BearingPage page;
  page.title = model.title.empty() ? bearing.name : model.title;
  page.description = model.description;
  page.file = arguments.model;
  page.bearing = bearing.name;
  page.version = version();
  page.created = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  page.conditions = run::bearing_assumptions(bearing);
  if (solutions.size() == 1) {
    for (auto& [name, text] : study::shear_remarks(solutions.front()))
      page.conditions.emplace_back(bearing.name + ": " + name, std::move(text));
  } else if (std::string text = study::shear_remark(solutions); !text.empty()) {
    page.conditions.emplace_back(bearing.name + ": cavitated shear", std::move(text));
  }
  for (auto& [surface, text] : surface_remarks(solutions.front()))
    page.conditions.emplace_back(bearing.name + ": " + surface, std::move(text));
  if (const std::string remark = heat_remark(solutions.front()); !remark.empty())
    page.conditions.emplace_back(bearing.name + ": heat", remark);
  page.solutions.reserve(solutions.size());
  for (const BearingSolution& solution : solutions) page.solutions.push_back(page_with_remark(solution));
  return page;
}

}  // namespace hersey::cli
