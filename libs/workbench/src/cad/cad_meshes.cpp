#include "cad/cad_meshes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "hersey/workbench/refused.h"

namespace hersey::workbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostAtWork = 2;

std::string ending_of_cad(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// What it said last; nothing more than a notice can show.
std::string end_of_log(const std::filesystem::path& log) {
  constexpr std::size_t kMost = 2000;
  std::ifstream stream(log, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  std::string said = text.str();
  if (said.size() > kMost) said.erase(0, said.size() - kMost);
  while (!said.empty() && std::isspace(static_cast<unsigned char>(said.back())) != 0) said.pop_back();
  return said;
}

}  // namespace

CadMeshes::CadMeshes(const Folder& folder, std::filesystem::path program)
    : folder_(folder), program_(std::move(program)) {}

CadMeshes::~CadMeshes() {
  for (const auto& [name, job] : jobs_) interrupt(job.process, job.file.string());
  // At the end of this program they are interrupted once more: one that is tidying up is left the time for it.
  const Clock::time_point end = Clock::now() + std::chrono::seconds(2);
  for (const auto& [name, job] : jobs_)
    while (is_running(job.process) && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::error_code ignored;
  if (!logs_.empty()) std::filesystem::remove_all(logs_, ignored);
}

std::string CadMeshes::start(const CadRequest& request) {
  Job job;
  job.file = folder_.resolve(request.path);
  const std::string ending = ending_of_cad(job.file);
  constexpr std::array<std::string_view, 5> known{".step", ".stp", ".iges", ".igs", ".brep"};
  if (std::find(known.begin(), known.end(), ending) == known.end())
    throw Refused(422, "'" + request.path + "' is no CAD file.", "It ends with .step, .stp, .iges, .igs or .brep.");
  if (!std::filesystem::is_regular_file(job.file))
    throw Refused(404, "There is no file '" + request.path + "'.", "Choose one of the list.");
  job.output_name = request.output.empty()
                        ? std::filesystem::path(request.path).replace_extension(".msh").generic_string()
                        : request.output;
  if (std::filesystem::path(job.output_name).extension() != ".msh")
    throw Refused(422, "The mesh is to be called '" + job.output_name + "'.", "Give a name that ends with .msh.");
  if (request.order != 1 && request.order != 2)
    throw Refused(422, "Elements of the order " + std::to_string(request.order) + ".", "The order is 1 or 2.");
  job.output = folder_.resolve(job.output_name);
  const std::lock_guard lock(mutex_);
  if (std::filesystem::exists(job.output) || std::filesystem::is_symlink(job.output))
    throw Refused(409, "There is a file '" + job.output_name + "' already.", "Choose another name.");
  const auto is_at_work = [](const auto& one) { return is_running(one.second.process); };
  if (std::any_of(jobs_.begin(), jobs_.end(),
                  [&](const auto& one) { return one.second.output == job.output && is_at_work(one); }))
    throw Refused(409, "The mesh '" + job.output_name + "' is being made already.", "Wait for it, or stop it.");
  if (static_cast<std::size_t>(std::count_if(jobs_.begin(), jobs_.end(), is_at_work)) >= kMostAtWork)
    throw Refused(503, "Two meshes are being made already.", "Wait for one of them, or stop it.");
  if (logs_.empty()) {
    std::string pattern = (std::filesystem::temp_directory_path() / "hersey-cad-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::system_error(errno, std::generic_category(), pattern);
    logs_ = pattern;
  }
  const std::string name = std::to_string(next_++);
  job.log = logs_ / (name + ".txt");
  // With "=" no value can be an option of its own.
  std::vector<std::string> words{program_.string(),
                                 "mesh",
                                 job.file.string(),
                                 "--size=" + request.size,
                                 "--order=" + std::to_string(request.order),
                                 "--around=" + std::to_string(request.around),
                                 "--output=" + job.output.string()};
  if (!request.length_unit.empty()) words.push_back("--length-unit=" + request.length_unit);
  job.began = Clock::now();
  job.process = start_attached(words, folder_.path(), job.log);
  jobs_[name] = std::move(job);
  return name;
}

CadMeshes::Job& CadMeshes::job(const std::string& name) {
  const auto found = jobs_.find(name);
  if (found == jobs_.end()) throw Refused(404, "This mesh is not known here.", "Start it anew.");
  return found->second;
}

CadState CadMeshes::state(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Job& one = job(name);
  CadState state;
  state.output = one.output_name;
  state.seconds = std::chrono::duration<double>(Clock::now() - one.began).count();
  if (is_running(one.process)) {
    // One that was just beginning may not have heard it.
    constexpr std::chrono::seconds kPatience(2);
    if (one.is_stopped && Clock::now() - one.asked_to_stop > kPatience) ask_to_stop(one);
    return state;
  }
  std::error_code ignored;
  const bool is_made = std::filesystem::exists(one.output, ignored);
  state.at = is_made ? CadState::At::made : CadState::At::failed;
  if (!is_made) state.message = one.is_stopped ? "It was stopped." : end_of_log(one.log);
  return state;
}

void CadMeshes::stop(const std::string& name) {
  const std::lock_guard lock(mutex_);
  ask_to_stop(job(name));
}

void CadMeshes::ask_to_stop(Job& job) {
  job.is_stopped = true;
  job.asked_to_stop = Clock::now();
  interrupt(job.process, job.file.string());
}

}  // namespace hersey::workbench
