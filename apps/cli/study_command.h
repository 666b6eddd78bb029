#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hersey::cli {

/// What `hersey study` hands on to the Python module that plans and sums up.
struct StudyArguments {
  std::string model;
  std::vector<std::string> overrides;
  std::filesystem::path output;  ///< empty: studies/<name of the model>
  std::string on = "local";      ///< or slurm
  std::string runner;            ///< program that answers runs; empty: this one
  std::string partition;         ///< of the cluster; empty: its default
  int jobs = 0;                  ///< 0: one per processor
  int chunk = 0;                 ///< runs of one task of the cluster; 0: chosen
  bool again = false;            ///< failed runs too
  bool json = false;
  std::string plan;     ///< file to write the planned runs to, none of which is done; -: printed
  std::string text;     ///< file whose text stands in for the model's
  std::string program;  ///< argv[0]
};

/// `hersey study`: plans runs, has them done, sums up. Starts Python. @returns an ExitCode. @throws InputError
[[nodiscard]] int study_command(const StudyArguments& arguments);

struct StudyPlanArguments {
  std::string model;
  std::vector<std::string> overrides;
  bool any_figure = false;  ///< names of figures are not checked: another program answers
  std::string text;         ///< file whose text stands in for the model's
};

/// `hersey study-plan`: the model's study, checked, as JSON. @returns an ExitCode. @throws InputError
[[nodiscard]] int study_plan_command(const StudyPlanArguments& arguments);

struct StudyTaskArguments {
  std::string model;
  std::vector<std::string> overrides;  ///< of all runs
  std::string analysis = "steady";     ///< or simulation
  std::vector<std::string> outputs;    ///< figures requested besides those that are always reported
  bool end_with_parent = false;
};

/// `hersey study-task`: reads runs as JSON, one a line, from standard input and answers each by one line on standard
/// output. @returns an ExitCode.
[[nodiscard]] int study_task_command(const StudyTaskArguments& arguments);

/// `hersey study-page`: the report page of a study from its data as JSON. @returns an ExitCode.
[[nodiscard]] int study_page_command(const std::filesystem::path& data, const std::filesystem::path& page);

}  // namespace hersey::cli
