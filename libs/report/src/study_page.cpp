#include "hersey/report/study_page.h"

#include <nlohmann/json.hpp>

#include "hersey/results/error.h"
#include "page_file.h"

namespace hersey::report {

void write_study_page(const std::string& data, const std::filesystem::path& out) {
  nlohmann::json study = nlohmann::json::parse(data, nullptr, false);
  if (study.is_discarded()) throw results::WriteError(out, "the study's data is no JSON");
  const std::string title = study.value("title", "Study");
  write_page({{"title", title}, {"runs", nlohmann::json::array()}, {"study", std::move(study)}}, out);
}

}  // namespace hersey::report
