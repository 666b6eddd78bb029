#include "command_line.h"

namespace hersey::cli {

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  repeatable(
      command
          .add_option("--set", overrides, "Override a parameter (load=500N) or any key (bearings.big_end.width=20mm)")
          ->type_name("NAME=VALUE"));
}

CLI::Option* repeatable(CLI::Option* option) {
  return option->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

namespace {

bool is_repeatable(const CLI::Option& option) {
  return option.nonpositional() && option.get_items_expected_max() > 1 && !option.get_allow_extra_args() &&
         option.get_delimiter() == '\0';
}

}  // namespace

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  std::string text = CLI::Formatter::make_option_opts(option);
  const std::string several = " ...";
  const std::size_t at = text.find(several);
  if (is_repeatable(*option) && at != std::string::npos) text.erase(at, several.size());
  return text;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return CLI::Formatter::make_option_desc(option) + (is_repeatable(*option) ? "; repeatable" : "");
}

}  // namespace hersey::cli
