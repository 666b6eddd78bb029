#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/units.h"
#include "hersey/session/output_file.h"
#include "hersey/session/session.h"
#include "interrupt.h"
#include "orbits_page.h"
#include "page_text.h"
#include "standard_streams.h"

namespace hersey::cli {
namespace {

/// Range of a parameter, in the unit in which it was written.
struct Along {
  std::string name, unit;
  double from = 0, to = 0;
};

[[noreturn]] void refuse_along(const std::string& found) {
  throw InputError(Fault{{"--along", 0, 0}, "", found, "a parameter and its range: speed=4000:9000rpm", ""});
}

/// `name=from:to`; one unit is enough.
Along along_of(const std::string& text) {
  const std::size_t equals = text.find('='), colon = text.find(':');
  if (equals == std::string::npos || equals == 0 || colon == std::string::npos || colon < equals)
    refuse_along("'" + text + "'");
  try {
    const Quantity from = split_quantity(text.substr(equals + 1, colon - equals - 1));
    const Quantity to = split_quantity(text.substr(colon + 1));
    if (!from.unit.empty() && !to.unit.empty() && from.unit != to.unit) refuse_along("'" + text + "', with two units");
    if (from.number == to.number) refuse_along("'" + text + "', a range without length");
    return {text.substr(0, equals), from.unit.empty() ? to.unit : from.unit, from.number, to.number};
  } catch (const QuantityError& error) {
    throw InputError(Fault{{"--along", 0, 0}, "", error.found, error.expected, error.suggestion});
  }
}

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::size_t first = text.find_first_not_of(' ', at), last = text.find_last_not_of(' ', comma - 1);
    if (first < comma) names.push_back(text.substr(first, last + 1 - first));
    at = comma + 1;
  }
  return names;
}

/// The model with another value. Its other values have been read before: what is refused is what `--along` asks for.
model::Model with_value(const session::Session& session, std::vector<std::string> overrides, const Along& along,
                        double value) {
  overrides.push_back(fmt::format("{}={:.17g}{}{}", along.name, value, along.unit.empty() ? "" : " ", along.unit));
  try {
    return session.with(std::move(overrides)).model();
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults)
      if (fault.position.file == "--set") fault.position.file = "--along";
    throw InputError(std::move(faults));
  }
}

/// Its model, with a periodic motion to be found.
model::Model model_at(const session::Session& session, const std::vector<std::string>& overrides, const Along& along,
                      double value) {
  model::Model model = with_value(session, overrides, along, value);
  if (model.simulation.analysis != model::Analysis::dynamics || !model.simulation.cycle ||
      model.simulation.cycle->lead_in != model::LeadIn::shooting)
    throw InputError(Fault{model.position_of("simulation"), "simulation", "no periodic motion that is looked for",
                           "`analysis: dynamics` with cycle: {period: ..., lead_in: shooting}", ""});
  return model;
}

}  // namespace

int orbits_command(const OrbitsArguments& arguments) {
  const Along along = along_of(arguments.along);
  const session::Session session(arguments.model, arguments.overrides);
  const std::vector<session::OutputFile> outputs{{"--results", arguments.results}, {"--report", arguments.report}};
  session::require_separate(outputs, session.files());
  session::require_writable(outputs);
  warn(session.model().warnings);
  OrbitFindings found{{}, along.name, along.unit};
  run::BranchOptions options;
  options.from = along.from, options.to = along.to;
  options.step = arguments.step, options.most = arguments.most;
  options.tolerance = arguments.tolerance, options.multipliers = arguments.multipliers;
  options.observed = names_in(arguments.observe);
  options.stop = &catch_interrupts();
  options.on_orbit = [&](const run::OrbitAtValue& orbit) {
    note_step();
    say("{} = {:.6g}{}{}: {}, {} periods\n", along.name, orbit.value, along.unit.empty() ? "" : " ", along.unit,
        orbit.is_stable() ? "stable" : "unstable", orbit.periods);
  };
  found.branch =
      run::follow_branch([&](double value) { return model_at(session, arguments.overrides, along, value); }, options);
  interrupt_is_heeded();
  if (!found.branch.solved()) {
    say("hersey: no first orbit at {} = {:.6g} {}: {}\n", along.name, along.from, along.unit, found.branch.message);
    return kFailed;
  }
  const std::string json =
      arguments.json || !arguments.results.empty() ? orbits_json(found, arguments.model).dump(2) + "\n" : std::string();
  fmt::print("{}", arguments.json ? json : orbits_text(found));
  if (!arguments.results.empty()) write_text(arguments.results, json);
  if (!arguments.report.empty()) {
    report::write_html(orbits_page(found, session.model(), arguments.model), arguments.report);
    if (!arguments.json) fmt::print("report: {}\n", arguments.report.string());
  }
  return kOk;
}

}  // namespace hersey::cli
