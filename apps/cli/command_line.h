#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace hersey::cli {

/// A command as it is declared: what it does, with the arguments it keeps, where the command line names it.
struct Command {
  const CLI::App* app = nullptr;
  std::function<int()> act;  ///< @returns an ExitCode
};
using Commands = std::vector<Command>;

void add_run_commands(CLI::App& app, Commands& commands);  ///< run, check, report, bearing
/// open. @param program  argv[0]
void add_open_command(CLI::App& app, Commands& commands, const std::string& program);
void add_mesh_commands(CLI::App& app, Commands& commands);  ///< mesh, reduce, modes, stress
/// study, and what it calls itself. @param program  argv[0]
void add_study_commands(CLI::App& app, Commands& commands, const std::string& program);
void add_file_commands(CLI::App& app, Commands& commands);  ///< oil, export, init, convert, explain, schema

/// `--set NAME=VALUE`.
void add_overrides(CLI::App& command, std::vector<std::string>& overrides);

/// An option that takes one value and may be given again and again.
CLI::Option* repeatable(CLI::Option* option);

/// Help that says so of such options, where CLI11's would show values one behind the other.
class HelpFormatter : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace hersey::cli
