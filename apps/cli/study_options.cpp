#include <CLI/CLI.hpp>
#include <memory>

#include "command_line.h"
#include "commands.h"
#include "study_command.h"

namespace hersey::cli {
namespace {

void add_study(CLI::App& app, Commands& commands, const std::string& program) {
  const auto study = std::make_shared<StudyArguments>();
  study->program = program;
  CLI::App* command = app.add_subcommand(
      "study", "Plan the runs of a model's study, do those that are missing, sum up: uncertainty, optimum, figures");
  command->add_option("MODEL", study->model, "Model file with a section `study`")->required();
  add_overrides(*command, study->overrides);
  command->add_option("--out,--output", study->output, "The study's folder (default: studies/<model>)")
      ->type_name("DIR");
  command->add_option("--on", study->on, "Where runs are done (default: local)")
      ->check(CLI::IsMember({"local", "slurm"}).description(""))
      ->type_name("local|slurm");
  command
      ->add_option("--jobs", study->jobs,
                   "Runs, or tasks of the cluster, at the same time (default: one per processor)")
      ->check(CLI::PositiveNumber);
  command->add_option("--partition", study->partition, "Partition of the cluster (default: its own)")
      ->type_name("NAME");
  command->add_option("--chunk", study->chunk, "Runs of one task of the cluster (default: as many as take a while)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--again", study->again, "Do failed runs again too");
  command->add_option("--runner", study->runner, "Another program that answers runs, one line of JSON each")
      ->type_name("COMMAND");
  command->add_flag("--json", study->json, "Print the results as JSON");
  command->add_option("--plan", study->plan, "Write the runs that are planned as JSON (-: print them), and do none")
      ->type_name("FILE");
  command->add_option("--text", study->text, "File with a text in place of the model's")->group("");
  commands.push_back({command, [study] { return study_command(*study); }});
}

// The commands that the module of studies calls are in no list.
void add_study_plan(CLI::App& app, Commands& commands) {
  const auto plan = std::make_shared<StudyPlanArguments>();
  CLI::App* command = app.add_subcommand("study-plan", "Print a model's study, checked, as JSON")->group("");
  command->add_option("MODEL", plan->model, "Model file")->required();
  add_overrides(*command, plan->overrides);
  command->add_flag("--any-figure", plan->any_figure, "Do not check names of figures");
  command->add_option("--text", plan->text, "File with a text in place of the model's");
  commands.push_back({command, [plan] { return study_plan_command(*plan); }});
}

void add_study_task(CLI::App& app, Commands& commands) {
  const auto task = std::make_shared<StudyTaskArguments>();
  CLI::App* command = app.add_subcommand("study-task", "Answer runs given as JSON, one a line")->group("");
  command->add_option("MODEL", task->model, "Model file")->required();
  add_overrides(*command, task->overrides);
  command->add_option("--analysis", task->analysis, "What a run is")->check(CLI::IsMember({"steady", "simulation"}));
  repeatable(command->add_option("--figure", task->outputs, "A figure that is wanted"));
  command->add_flag("--end-with-parent", task->end_with_parent, "End when the program ends that started this one");
  commands.push_back({command, [task] { return study_task_command(*task); }});
}

void add_study_page(CLI::App& app, Commands& commands) {
  struct StudyPaths {
    std::filesystem::path data, page;
  };
  const auto paths = std::make_shared<StudyPaths>();
  CLI::App* command = app.add_subcommand("study-page", "Write the page of a study from its data")->group("");
  command->add_option("DATA", paths->data, "JSON")->required();
  command->add_option("PAGE", paths->page, "HTML file to write")->required();
  commands.push_back({command, [paths] { return study_page_command(paths->data, paths->page); }});
}

}  // namespace

void add_study_commands(CLI::App& app, Commands& commands, const std::string& program) {
  add_study(app, commands, program);
  add_study_plan(app, commands);
  add_study_task(app, commands);
  add_study_page(app, commands);
}

}  // namespace hersey::cli
