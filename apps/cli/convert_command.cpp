#include <fmt/format.h>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/write_file.h"
#include "hersey/model/convert.h"
#include "hersey/model/read.h"
#include "hersey/session/output_file.h"
#include "standard_streams.h"

namespace hersey::cli {

int convert_command(const ConvertArguments& arguments) {
  const std::string file = arguments.model.string();
  session::require_separate({{"--output", arguments.output}}, {arguments.model});
  const model::Conversion conversion = model::converted(model::file_text(file), file);
  for (const model::Change& change : conversion.changes)
    say("{}:{}:{}: {}: {}\n", file, change.position.line, change.position.column, change.path, change.what);
  if (conversion.changes.empty()) say("{}: nothing to convert\n", file);
  if (arguments.in_place && !conversion.changes.empty())
    write_file(arguments.model, {conversion.text});
  else if (!arguments.output.empty())
    write_file(arguments.output, {conversion.text});
  else if (!arguments.in_place)
    fmt::print("{}", conversion.text);
  (void)model::read_text(conversion.text, file);  // reports the other faults
  return kOk;
}

}  // namespace hersey::cli
