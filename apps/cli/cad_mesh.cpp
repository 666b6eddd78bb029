// gmsh is GPL: it is only ever run as a program of its own (docs/decisions/0002-dependencies.md).
#include "cad_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <system_error>

#include "child_program.h"
#include "hersey/core/input_file.h"
#include "hersey/core/write_file.h"
#include "hersey/fem/mesh_file.h"
#include "interrupt.h"
#include "standard_streams.h"

namespace hersey::cli {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr std::size_t kLinesShown = 12;  // of gmsh's messages

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// A temporary folder for the files of gmsh, removed with this object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hersey-gmsh-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Options by their names of gmsh 4.8 and of later versions: the others are constants that nobody asks for.
std::string script_for(const std::string& part, const CadOptions& options, double unit) {
  const double size = options.size / unit;
  return fmt::format(
      "SetFactory(\"OpenCASCADE\");\n"
      "Geometry.OCCTargetUnit = \"MM\";\n"
      "Merge \"{}\";\n"
      "solids() = Volume{{:}};\n"
      "If (#solids() > 1)\n"
      "  Coherence;\n"
      "EndIf\n"
      "Mesh.CharacteristicLengthMax = {};\n"
      "Mesh.CharacteristicLengthFromCurvature = {};\n"
      "Mesh.MinimumElementsPerTwoPi = {};\n"
      "Mesh.ElementOrder = {};\n"
      "Mesh.SecondOrderIncomplete = 1;\n"
      "Mesh.HighOrderOptimize = 1;\n"  // unfolds elements at round surfaces
      "Mesh.MshFileVersion = 4.1;\n"
      "Mesh.Binary = 0;\n"
      "Mesh.SaveAll = 1;\n",
      part, size, options.around, options.around, options.order);
}

/// Returns the last lines of gmsh's output; only error messages if there are any.
std::string messages_in(const std::filesystem::path& log) {
  std::ifstream file(log);
  std::deque<std::string> last, errors;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("Error")) errors.push_back(line);
    last.push_back(std::move(line));
    for (std::deque<std::string>* lines : {&last, &errors})
      if (lines->size() > kLinesShown) lines->pop_front();
  }
  std::string text;
  for (const std::string& line : errors.empty() ? last : errors) text += "\n  gmsh: " + line;
  return text;
}

void require_good_end(const ChildEnd& end, const std::filesystem::path& path, const std::filesystem::path& log,
                      double time_limit) {
  using Reason = ChildEnd::Reason;
  if (end.reason == Reason::not_found)
    throw std::runtime_error(
        "gmsh is not installed or not on PATH: it makes meshes of CAD files. On Debian: apt-get install gmsh; else "
        "from "
        "https://gmsh.info");
  if (end.reason == Reason::took_too_long)
    throw std::runtime_error(
        fmt::format("{}: gmsh took longer than {:.4g} s and was stopped; give a larger --size, or more time: "
                    "--time-limit 2h{}",
                    path.string(), time_limit, messages_in(log)));
  if (end.reason == Reason::killed)
    throw std::runtime_error(
        fmt::format("{}: gmsh was ended by signal {}{}", path.string(), end.code, messages_in(log)));
  if (end.code != 0)
    throw std::runtime_error(
        fmt::format("{}: gmsh failed with exit code {}{}", path.string(), end.code, messages_in(log)));
}

}  // namespace

bool has_no_unit(const std::filesystem::path& path) { return ending_of(path) == ".brep"; }

bool is_cad_file(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return has_no_unit(path) || ending == ".step" || ending == ".stp" || ending == ".iges" || ending == ".igs";
}

std::string unit_stated_in(const std::filesystem::path& path) {
  const InputFile file = read_input_file(path);
  // An entity of several types, in any order: ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) ).
  static const std::regex si(R"(SI_UNIT\s*\(\s*(\$|\.[A-Z]+\.)\s*,\s*\.METRE\.\s*\))");
  static const std::regex other(R"(CONVERSION_BASED_UNIT\s*\(\s*'([^']*)')");
  std::size_t at = 0;
  std::string unit;
  while ((at = file.content.find("LENGTH_UNIT", at)) != std::string::npos) {
    const std::size_t begin = file.content.rfind(';', at), end = file.content.find(';', at);
    const std::size_t from = begin == std::string::npos ? 0 : begin;
    const std::string entity = file.content.substr(from, end == std::string::npos ? end : end - from);
    std::smatch match;
    // An inch is defined by a metre: it is the one that lengths are in.
    if (std::regex_search(entity, match, other)) {
      unit = match[1];
      std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
      return unit;
    }
    if (std::regex_search(entity, match, si)) {
      std::string prefix = match[1];
      std::erase_if(prefix, [](char c) { return c == '.' || c == '$'; });
      std::transform(prefix.begin(), prefix.end(), prefix.begin(), [](unsigned char c) { return std::tolower(c); });
      unit = prefix + "metres";
    }
    at += 1;
  }
  return unit;
}

std::optional<fem::Mesh> mesh_of_cad(const std::filesystem::path& path, const CadOptions& options) {
  if (const auto fault = unreadable(path))
    throw InputError(Fault{{path.string(), 0, 0}, "", *fault, "a CAD file: STEP, IGES or BREP", "check its path"});
  const std::atomic<bool>& stop = catch_interrupts();
  const ScratchFolder folder;
  const std::string part = "part" + ending_of(path);
  std::filesystem::create_symlink(std::filesystem::absolute(path), folder / part);
  // gmsh converts lengths with a unit to millimetres.
  const double unit = has_no_unit(path) ? options.length_unit : kMillimetre;
  write_file(folder / "part.geo", {script_for(part, options, unit)});
  const std::filesystem::path log = folder / "log";
  const ChildEnd end = run_program({"gmsh", "-3", "part.geo", "-o", "part.msh", "-nopopup"}, folder.path(), log,
                                   options.time_limit, stop);
  interrupt_is_heeded();
  if (end.reason == ChildEnd::Reason::interrupted) return std::nullopt;
  require_good_end(end, path, log, options.time_limit);
  try {
    return fem::read_mesh(folder / "part.msh", unit);
  } catch (const InputError&) {
    throw std::runtime_error(
        fmt::format("{}: gmsh made no mesh of solids of it; the file must hold solids, not surfaces alone{}",
                    path.string(), messages_in(log)));
  }
}

}  // namespace hersey::cli
