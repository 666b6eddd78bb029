#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "description.h"
#include "hersey/core/blas_threads.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/unit_database.h"
#include "hersey/fmi/fmu_file.h"
#include "hersey/session/session.h"
#include "licence.h"
#include "package.h"
#include "system_structure.h"
#include "terminals.h"
#include "variables.h"

namespace hersey::fmu {
namespace {

constexpr int kFailed = 1, kWrongInput = 2;

struct Arguments {
  std::string model;
  std::vector<std::string> overrides;
  std::filesystem::path fmu, ssp;
  int version = 2;
  bool force = false;
};

/// Path of the library beside the program, where it was built or installed.
std::filesystem::path find_library() {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string name = std::string(kModelIdentifier) + ".so";
  for (const char* subfolder : {".", "../lib/hersey"}) {
    const std::filesystem::path candidate = folder / subfolder / name;
    if (std::filesystem::exists(candidate)) return std::filesystem::canonical(candidate);
  }
  throw std::runtime_error(
      fmt::format("{} is neither beside the program nor in ../lib/hersey: 'make fmu' builds it", name));
}

std::uint64_t hash_of(const std::string& text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// The same model, program and version of the standard have the same token.
std::string token_of(const std::string& description, const PackedModel& packed, const model::Model& model) {
  std::string all = description + packed.text;
  for (const std::string& change : packed.overrides) all += change + "\n";
  for (const auto& [name, hash] : model.files) all += fmt::format("{}{:x}", name, hash);
  const std::uint64_t a = hash_of(all, 0xcbf29ce484222325U), b = hash_of(all, a);
  return fmt::format("{{{:08x}-{:04x}-{:04x}-{:04x}-{:012x}}}", a >> 32, (a >> 16) & 0xffff, a & 0xffff, b >> 48,
                     b & 0xffffffffffff);
}

std::vector<PackedFile> binaries(int version) {
  const std::filesystem::path library = find_library();
  const std::string folder = "binaries/" + hersey::fmi::platform(version) + "/";
  std::vector<PackedFile> files{{library, folder + kModelIdentifier + ".so"}};
  for (const PackedFile& needed : libraries_of(library)) files.push_back({needed.from, folder + needed.name});
  return files;
}

/// The database of units, without which no model is read: a file that names others beside it.
std::vector<PackedFile> files_of_units() {
  std::vector<PackedFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(hersey::unit_database().parent_path()))
    if (entry.path().extension() == ".xml")
      files.push_back({entry.path(), "resources/udunits/" + entry.path().filename().string()});
  return files;
}

/// Writes the FMU of the session's model to a file that is no input of it.
Variables write_fmu(const session::Session& session, const std::vector<std::string>& overrides,
                    const std::filesystem::path& target, int version) {
  run::Simulation simulation = session.simulation();
  model::Model model = session.model();
  model.simulation = simulation.model().simulation;  // with its period, where that is found
  Variables variables;
  variables.list = variables_of(session.text(), simulation, version);
  const PackedModel packed = pack(model, session.text(), overrides);
  variables.overrides = packed.overrides;
  variables.token = token_of(description_xml(model, variables, version), packed, model);
  std::vector<PackedFile> files = packed.files;
  const std::vector<PackedFile> libraries = binaries(version);
  for (const std::vector<PackedFile>& more : {libraries, files_of_units(), licences_of(libraries)})
    files.insert(files.end(), more.begin(), more.end());
  std::vector<std::pair<std::string, std::string>> texts{
      {"modelDescription.xml", description_xml(model, variables, version)},
      {"resources/variables.json", to_json(variables)},
      {"resources/model.yaml", packed.text},
      {"documentation/index.html", documentation_html(model, variables, version)},
      {"documentation/licenses/license.txt", kLicence}};
  if (version == 3) {
    texts.emplace_back("terminalsAndIcons/terminalsAndIcons.xml", terminals_xml(model, variables));
    texts.emplace_back("terminalsAndIcons/icon.png", icon());
  }
  write_zip(target, texts, files);
  return variables;
}

std::filesystem::path with_ending(std::filesystem::path path, const char* ending) {
  path += ending;
  return path;
}

void require_no_input(const session::Session& session, const std::filesystem::path& target, const char* option) {
  for (const std::filesystem::path& file : session.files()) {
    std::error_code ignored;
    if (std::filesystem::equivalent(file, target, ignored))
      throw InputError(Fault{{option, 0, 0}, "", target.string() + ", which the model reads", "another file", ""});
  }
}

int export_fmu(const Arguments& arguments) {
  const std::filesystem::path& target = arguments.fmu;
  const session::Session session(arguments.model, arguments.overrides);
  const model::Model& model = session.model();
  if (!model.fmus.empty())
    throw InputError(Fault{model.position_of("fmus"), "fmus", "a model with FMUs of its own",
                           "`--ssp FILE.ssp`, a system of its machine and its FMUs; or a model without", ""});
  require_no_input(session, target, "--fmu");
  const std::filesystem::path unfinished = with_ending(target, ".unfinished");
  const Variables variables = write_fmu(session, arguments.overrides, unfinished, arguments.version);
  std::filesystem::rename(unfinished, target);
  const auto count = [&](Variable::Kind kind) {
    return std::count_if(variables.list.begin(), variables.list.end(),
                         [&](const Variable& one) { return one.kind == kind; });
  };
  fmt::print("{}: FMI {}.0 for co-simulation, {} inputs, {} outputs, {} parameters\n", target.string(),
             arguments.version, count(Variable::Kind::input), count(Variable::Kind::output),
             count(Variable::Kind::parameter));
  return 0;
}

// The machine as one FMU beside those that its model names.
int export_ssp(const Arguments& arguments) {
  const std::filesystem::path& target = arguments.ssp;
  const session::Session whole(arguments.model, arguments.overrides);
  const model::Model& model = whole.model();
  if (model.fmus.empty())
    throw InputError(Fault{{model.file, 0, 0},
                           "",
                           "a model without `fmus`",
                           "a model whose FMUs are connected with its machine; `--fmu FILE.fmu` writes a machine alone",
                           ""});
  require_no_input(whole, target, "--ssp");
  std::vector<std::string> overrides = arguments.overrides;
  for (const std::string& change : changes_to_machine(model)) overrides.push_back(change);
  const session::Session machine(arguments.model, overrides);
  const std::filesystem::path fmu = with_ending(target, ".machine"), unfinished = with_ending(target, ".unfinished");
  try {
    const Variables variables = write_fmu(machine, overrides, fmu, arguments.version);
    std::vector<PackedFile> files{{fmu, "resources/" + machine_name(model) + ".fmu"}};
    for (const model::Fmu& one : model.fmus) files.push_back({one.file, "resources/" + one.name + ".fmu"});
    write_zip(unfinished, {{"SystemStructure.ssd", system_structure_xml(model, variables)}}, files);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(fmu, ignored);
    throw;
  }
  std::filesystem::remove(fmu);
  std::filesystem::rename(unfinished, target);
  fmt::print("{}: SSP 1.0, {} and {} FMUs connected with it\n", target.string(), machine_name(model),
             model.fmus.size());
  for (const std::string& hold : lost_holds(model))
    fmt::print("{} is not in it: how outputs go on between exchanges is the importing program's choice\n", hold);
  return 0;
}

/// Writes what is asked for, unless it is there.
int write_export(const Arguments& arguments) {
  const bool is_ssp = !arguments.ssp.empty();
  if (is_ssp == !arguments.fmu.empty())
    throw InputError(Fault{{"", 0, 0},
                           "hersey export",
                           is_ssp ? "--fmu and --ssp together" : "neither --fmu nor --ssp",
                           "one of them",
                           ""});
  const std::filesystem::path& target = is_ssp ? arguments.ssp : arguments.fmu;
  if (std::filesystem::exists(target) && !arguments.force) {
    fmt::print(stderr, "hersey: {} exists already; use --force to replace it\n", target.string());
    return kWrongInput;
  }
  return is_ssp ? export_ssp(arguments) : export_fmu(arguments);
}

int exported(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Write a co-simulation FMU of a model, or a system of FMUs", "hersey export"};
  app.add_option("MODEL", arguments.model, "Model file")->required();
  app.add_option("--fmu", arguments.fmu, "The FMU to write")->type_name("FILE.fmu");
  app.add_option("--ssp", arguments.ssp, "The system to write, of the machine and the FMUs of its model")
      ->type_name("FILE.ssp");
  app.add_option("--fmi", arguments.version, "Version of the standard: 2 or 3 (default: 2)")
      ->check(CLI::IsMember({2, 3}));
  app.add_option("--set", arguments.overrides, "Override a parameter or any key")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--force", arguments.force, "Replace the FMU if it exists");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongInput;
  }
  use_one_blas_thread();
  return write_export(arguments);
}

// An error while exiting must not throw any more.
void complain(const char* prefix, const std::string& text) {
  std::fputs(prefix, stderr);
  std::fputs(text.c_str(), stderr);
  std::fputs("\n", stderr);
}

}  // namespace
}  // namespace hersey::fmu

int main(int argc, char** argv) {
  using namespace hersey;
  try {
    return fmu::exported(argc, argv);
  } catch (const InputError& error) {
    fmu::complain("", error.what());
    return fmu::kWrongInput;
  } catch (const std::exception& error) {
    fmu::complain("hersey: ", error_text(error));
    return fmu::kFailed;
  } catch (...) {
    fmu::complain("hersey: ", "internal error, please report it with the model");
    return fmu::kFailed;
  }
}
