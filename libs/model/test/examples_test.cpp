#include <doctest/doctest.h>

#include <filesystem>

#include "hersey/model/read.h"
#include "hersey/model/study.h"
#include "source_dir.h"

namespace hersey::model {
namespace examples_test {

std::vector<std::string> example_files() {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::string(hersey::source_dir()) + "/examples")) {
    // What a command makes first is not there.
    if (entry.path().parent_path().filename() == "parts") continue;
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  }
  return files;
}

TEST_CASE("Examples_AreReadWithoutFault") {
  REQUIRE(example_files().size() >= 2);
  for (const std::string& file : example_files()) {
    CAPTURE(file);
    try {
      const Model model = read(file);
      CHECK_FALSE(model.title.empty());
      CHECK(model.bearings.size() + model.composites.size() + model.joints.size() > 0);
      CHECK_NOTHROW((void)check_study(file));
      if (!model.study || !model.study->is_written_out()) continue;
      for (const StudyRun& run : expand_study(file)) CHECK_NOTHROW((void)read(file, run.overrides));
    } catch (const InputError& error) {
      FAIL_CHECK(error.what());
    }
  }
}

}  // namespace examples_test
}  // namespace hersey::model
