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
#include "hersey/session/session.h"
#include "licence.h"
#include "package.h"
#include "terminals.h"
#include "variables.h"

namespace hersey::fmu {
namespace {

constexpr int kFailed = 1, kWrongInput = 2;

struct Arguments {
  std::string model;
  std::vector<std::string> overrides;
  std::filesystem::path fmu;
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
  const std::string folder = version == 2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
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

int export_fmu(const Arguments& arguments) {
  const std::filesystem::path& target = arguments.fmu;
  if (std::filesystem::exists(target) && !arguments.force) {
    fmt::print(stderr, "hersey: {} exists already; use --force to replace it\n", target.string());
    return kWrongInput;
  }
  const session::Session session(arguments.model, arguments.overrides);
  const model::Model& model = session.model();
  if (!model.fmus.empty())
    throw InputError(Fault{model.position_of("fmus"), "fmus", "a model with FMUs of its own",
                           "a model without: FMUs of the parts, which the importing program connects", ""});
  for (const std::filesystem::path& file : session.files()) {
    std::error_code ignored;
    if (std::filesystem::equivalent(file, target, ignored))
      throw InputError(Fault{{"--fmu", 0, 0}, "", target.string() + ", which the model reads", "another file", ""});
  }
  run::Simulation simulation = session.simulation();
  Variables variables;
  variables.list = variables_of(session.text(), simulation, arguments.version);
  const PackedModel packed = pack(model, session.text(), arguments.overrides);
  variables.overrides = packed.overrides;
  variables.token = token_of(description_xml(model, variables, arguments.version), packed, model);
  std::vector<PackedFile> files = packed.files;
  const std::vector<PackedFile> libraries = binaries(arguments.version);
  for (const std::vector<PackedFile>& more : {libraries, files_of_units(), licences_of(libraries)})
    files.insert(files.end(), more.begin(), more.end());
  std::filesystem::path unfinished = target;
  unfinished += ".unfinished";
  std::vector<std::pair<std::string, std::string>> texts{
      {"modelDescription.xml", description_xml(model, variables, arguments.version)},
      {"resources/variables.json", to_json(variables)},
      {"resources/model.yaml", packed.text},
      {"documentation/index.html", documentation_html(model, variables, arguments.version)},
      {"documentation/licenses/license.txt", kLicence}};
  if (arguments.version == 3) {
    texts.emplace_back("terminalsAndIcons/terminalsAndIcons.xml", terminals_xml(model, variables));
    texts.emplace_back("terminalsAndIcons/icon.png", icon());
  }
  write_zip(unfinished, texts, files);
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

int exported(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Write a co-simulation FMU of a model", "hersey export"};
  app.add_option("MODEL", arguments.model, "Model file")->required();
  app.add_option("--fmu", arguments.fmu, "The FMU to write")->type_name("FILE.fmu")->required();
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
  return export_fmu(arguments);
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
