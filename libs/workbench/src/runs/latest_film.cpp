#include "runs/latest_film.h"

#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "runs/process.h"
#include "runs/temporary_folder.h"

namespace hersey::workbench {

std::string latest_film(const std::filesystem::path& program, const std::filesystem::path& folder, const RunEntry& run,
                        const std::string& bearing) {
  std::filesystem::path newest;
  std::filesystem::file_time_type time = std::filesystem::file_time_type::min();
  for (const std::string& file : run.results) {
    std::error_code error;
    const auto written = std::filesystem::last_write_time(folder / file, error);
    if (!error && written > time) newest = folder / file, time = written;
  }
  const std::string none = R"({"t":null,"datasets":{}})";
  if (newest.empty()) return none;
  const TemporaryFolder temporary;
  const std::filesystem::path answer = temporary.file("film.json");
  const std::vector<std::string> words{program.string(),       "film",     newest.string(),
                                       "--bearing=" + bearing, "--output", answer.string()};
  constexpr double kMostTime = 20;  // [s]
  std::string output;
  if (run_to_end(words, folder, kMostTime, output) != 0) return none;
  std::ifstream stream(answer, std::ios::binary);
  std::string film{std::istreambuf_iterator<char>(stream), {}};
  return film.empty() ? none : film;
}

}  // namespace hersey::workbench
