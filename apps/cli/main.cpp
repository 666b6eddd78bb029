#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>

#include "cache_folder.h"
#include "command_line.h"
#include "crash.h"
#include "exit_code.h"
#include "hersey/core/blas_threads.h"
#include "hersey/core/contract.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/version.h"
#include "hersey/model/reduction_folder.h"
#include "hersey/results/error.h"
#include "hersey/results/output_lock.h"
#include "standard_streams.h"

namespace hersey::cli {
namespace {

constexpr const char* kAbout =
    "hersey: oil-film journal bearings inside moving machines.\n"
    "A model file (YAML, with units) describes bodies, joints, loads and bearings; a run simulates it in time and\n"
    "leaves one HDF5 results file and one self-contained HTML report.";

constexpr const char* kFooter =
    "Examples:\n"
    "  hersey init big_end my_rod                                    a commented model to begin with\n"
    "  hersey recipes size-a-bearing                                 a task step by step\n"
    "  hersey explain bearings.main.supply                           what a key means, its unit and default\n"
    "  hersey open my_rod.yaml                                       write it and see it in the browser\n"
    "  hersey run examples/paper_big_end/model.yaml                  all runs of its study\n"
    "  hersey run model.yaml --set load=500N --output out            one parameter changed\n"
    "  hersey run model.yaml --resume                                goes on after Ctrl-C or a crash\n"
    "  hersey run model.yaml --set bearings.big_end.grid.circumferential=120\n"
    "  hersey bearing model.yaml --sweep load=100N:2500N:10          one bearing by itself\n"
    "  hersey rotor rotor.yaml --sweep speed=1000rpm:9000rpm:41      its modes and unbalance response over speed\n"
    "  hersey check model.yaml                                       every fault, nothing simulated\n"
    "  hersey mesh conrod.msh --length-unit mm                       a mesh: sets, mass, quality, bores\n"
    "  hersey mesh conrod.step --size 4mm                            a mesh of a CAD file, by gmsh\n"
    "  hersey modes conrod.msh --length-unit mm --hold big_end       its natural frequencies\n"
    "  hersey export rotor.yaml --fmu rotor.fmu                      for co-simulation in other programs\n"
    "  hersey export results.h5 --loads calculix --output loads      pressures of films for a strength program\n"
    "  hersey export results.h5 --films films.vtkhdf                 films over time for ParaView\n"
    "  hersey stress results.h5 --vtkhdf rod.vtkhdf                  stresses of a flexible body over a run\n"
    "  hersey oil iso_vg_46 --at 40degC 100degC                      viscosity and density of an oil\n"
    "  hersey convert old.yaml --in-place                            a model file of an earlier version\n"
    "  hersey schema > hersey.schema.json                            completion and checking in an editor\n"
    "\n"
    "Exit codes:\n"
    "  0    done\n"
    "  1    the simulation failed or its results could not be written; what was written stays readable\n"
    "  2    wrong usage or input, or results exist already (see --force); nothing was written\n"
    "  130  stopped by Ctrl-C; results up to then are complete and the report shows them\n";

// Returns the message for a first word that is not a command: "unknown command 'rnu': did you mean 'run'?".
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  const std::string given = argc > 1 ? argv[1] : "";
  if (given.empty() || given.starts_with('-')) return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == given) return {};
    if (!command->get_group().empty()) names.push_back(command->get_name());  // the others are hersey's own
  }
  const std::string hint = did_you_mean(given, names);
  return fmt::format("unknown command '{}': {}", given, hint.empty() ? "expected " + one_of(names) : hint);
}

// Declares the command line and calls the command named in it.
int dispatch(int argc, char** argv) {
  CLI::App app{kAbout, "hersey"};
  app.footer(kFooter);
  app.set_version_flag("--version", fmt::format("hersey {}", version()));
  app.require_subcommand(1);

  app.formatter(std::make_shared<HelpFormatter>());

  Commands commands;
  add_run_commands(app, commands);
  add_open_command(app, commands, argv[0]);
  add_mesh_commands(app, commands);
  add_study_commands(app, commands, argv[0]);
  add_file_commands(app, commands);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string unknown = unknown_command(app, argc, argv); !unknown.empty()) {
      say("hersey: {}\n", unknown);
      return kWrongInput;
    }
    return app.exit(error) == 0 ? kOk : kWrongInput;
  }
  const auto named =
      std::find_if(commands.begin(), commands.end(), [](const Command& command) { return command.app->parsed(); });
  HERSEY_REQUIRE(named != commands.end(), "one command is required");
  return named->act();
}

}  // namespace
}  // namespace hersey::cli

int main(int argc, char** argv) {
  using namespace hersey;
  try {
    cli::open_standard_streams();
    cli::report_crashes_of_damaged_files();
    use_one_blas_thread();
    end_blas_threads();
    model::keep_reductions_in(cli::cache_folder());
    const int code = cli::dispatch(argc, argv);
    return cli::finish_standard_output() || code != cli::kOk ? code : static_cast<int>(cli::kFailed);
  } catch (const InputError& error) {
    cli::say("{}\n", error.what());
    if (error.faults().size() > 1) cli::say("hersey: {} faults\n", error.faults().size());
    return cli::kWrongInput;
  } catch (const results::FileExists& error) {
    cli::say("hersey: {}; use --force to replace it or --output to write elsewhere\n", error.what());
    return cli::kWrongInput;
  } catch (const results::FileBusy& error) {
    cli::say("hersey: {}\n", error.what());
    return cli::kWrongInput;
  } catch (const results::ReadError& error) {
    cli::say("hersey: {}\n", error.what());
    return cli::kWrongInput;
  } catch (const std::exception& error) {
    cli::say("hersey: {}\n", error_text(error));
    return cli::kFailed;
  } catch (...) {
    cli::say("hersey: internal error, please report it with the model\n");
    return cli::kFailed;
  }
}
