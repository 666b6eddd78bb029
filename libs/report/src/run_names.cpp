#include "run_names.h"

#include <algorithm>
#include <map>
#include <set>

#include "hersey/core/contract.h"

namespace hersey::report {
namespace {

/// A file's name that grows by the folders before it.
class RunName {
 public:
  explicit RunName(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::path whole = std::filesystem::weakly_canonical(file, ignored);
    if (whole.empty()) whole = file;
    for (const std::filesystem::path& part : whole.parent_path().relative_path()) parts_.push_back(part.string());
    const std::string stem = file.stem().string();
    if (stem != "results" || parts_.empty()) parts_.push_back(stem);
  }

  [[nodiscard]] std::string text() const {
    std::string text;
    for (auto part = parts_.end() - count_; part != parts_.end(); ++part) text += (text.empty() ? "" : "/") + *part;
    return text;
  }

  /// Adds one more folder in front; returns false if there is none.
  bool grow() {
    if (count_ == static_cast<std::ptrdiff_t>(parts_.size())) return false;
    ++count_;
    return true;
  }

 private:
  std::vector<std::string> parts_;
  std::ptrdiff_t count_ = 1;
};

std::map<std::string, int> counted(const std::vector<RunName>& names) {
  std::map<std::string, int> count;
  for (const RunName& name : names) ++count[name.text()];
  return count;
}

}  // namespace

std::vector<std::string> run_names(const std::vector<std::filesystem::path>& results,
                                   const std::vector<std::string>& given) {
  if (!given.empty()) {
    HERSEY_REQUIRE(given.size() == results.size(), "a name for each run");
    HERSEY_REQUIRE(std::set<std::string>(given.begin(), given.end()).size() == given.size(), "names that differ");
    return given;
  }
  std::vector<RunName> names(results.begin(), results.end());
  for (bool grows = true; grows;) {
    grows = false;
    const std::map<std::string, int> count = counted(names);
    for (RunName& name : names) grows = (count.at(name.text()) > 1 && name.grow()) || grows;
  }
  std::vector<std::string> texts;
  for (const RunName& name : names) {
    std::string text = name.text();
    for (int number = 2; std::find(texts.begin(), texts.end(), text) != texts.end(); ++number)
      text = name.text() + " (" + std::to_string(number) + ")";
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace hersey::report
