#include "run_stress.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/fem/vtkhdf_file.h"
#include "hersey/results/error.h"
#include "hersey/run/body_stress.h"
#include "hersey/run/model_of_results.h"
#include "hersey/session/output_file.h"
#include "instant_option.h"
#include "table.h"

namespace hersey::cli {
namespace {

constexpr double per_megapascal = 1e-6, per_millisecond = 1e3, per_millimetre = 1e3;
constexpr double degrees = 180 / std::numbers::pi;

/// Options of constant loads, which a run brings itself.
void require_no_constant_loads(const SolidArguments& a) {
  std::vector<Fault> faults;
  const auto refuse = [&](const char* option, bool is_given) {
    if (is_given)
      faults.push_back({{"", 0, 0},
                        option,
                        "it belongs to the stress of a mesh under constant loads",
                        "results alone: loads, supports and materials are those of the run",
                        ""});
  };
  refuse("--hold", !a.hold.empty()), refuse("--pressure", !a.pressure.empty()), refuse("--gravity", !a.gravity.empty());
  refuse("--temperature", !a.temperature.empty()), refuse("--cooling", !a.cooling.empty());
  refuse("--heat", !a.heat.empty()), refuse("--youngs-modulus", !a.young.empty());
  refuse("--poisson-ratio", !a.poisson.empty()), refuse("--orthotropic", !a.orthotropic.empty());
  refuse("--density", !a.density.empty()), refuse("--part", !a.part.empty()), refuse("--vtu", !a.vtu.empty());
  if (!faults.empty()) throw InputError(std::move(faults));
}

void write_stresses(const std::filesystem::path& path, const run::BodyStress& stress,
                    const run::BodyStress::Envelope& envelope, const std::vector<std::size_t>& instants) {
  std::vector<double> times;
  for (const std::size_t k : instants) times.push_back(stress.times()[k]);
  fem::VtkHdfFile file(path, fem::vtk_cells(stress.mesh()),
                       {{.name = "displacement", .components = 3},
                        {.name = "stress", .components = 6},
                        {.name = "von_mises"},
                        {.name = "von_mises_largest", .is_constant = true},
                        {.name = "time_of_largest", .is_constant = true},
                        {.name = "node", .is_constant = true}},
                       times);
  for (std::size_t step = 0; step < instants.size(); ++step) {
    const run::BodyStressAt at = stress.at(instants[step]);
    file.write(step, 0, at.displacement);
    file.write(step, 1, at.stress);
    file.write(step, 2, at.von_mises.transpose());
  }
  const std::vector<long>& labels = stress.mesh().node_labels;
  const Eigen::VectorXd nodes =
      Eigen::Map<const Eigen::Matrix<long, Eigen::Dynamic, 1>>(labels.data(), static_cast<Eigen::Index>(labels.size()))
          .cast<double>();
  file.write(0, 3, envelope.largest.transpose());
  file.write(0, 4, envelope.when.transpose());
  file.write(0, 5, nodes.transpose());
  file.close();
}

nlohmann::json json_of(const run::BodyStress& stress, const run::StressPeak& peak) {
  const Vector3& x = stress.mesh().nodes[static_cast<std::size_t>(peak.node)];
  nlohmann::json line{{"time", peak.time},
                      {"von_mises", peak.von_mises},
                      {"node", stress.mesh().node_labels[static_cast<std::size_t>(peak.node)]},
                      {"position", {x.x(), x.y(), x.z()}}};
  if (peak.crank_angle) line["crank_angle"] = *peak.crank_angle;
  return line;
}

void print_peaks(const run::BodyStress& stress, const std::vector<run::StressPeak>& peaks) {
  const bool has_crank = !peaks.empty() && peaks.front().crank_angle;
  std::vector<std::vector<std::string>> lines{{"time [ms]"}};
  if (has_crank) lines[0].emplace_back("crank [deg]");
  for (const char* head : {"von Mises [MPa]", "node", "x [mm]", "y [mm]", "z [mm]"}) lines[0].emplace_back(head);
  for (const run::StressPeak& peak : peaks) {
    std::vector<std::string>& line = lines.emplace_back();
    line.push_back(fmt::format("{:.6g}", peak.time * per_millisecond));
    if (has_crank) line.push_back(fmt::format("{:.6g}", *peak.crank_angle * degrees));
    line.push_back(fmt::format("{:.5g}", peak.von_mises * per_megapascal));
    line.push_back(fmt::format("{}", stress.mesh().node_labels[static_cast<std::size_t>(peak.node)]));
    for (const double x : stress.mesh().nodes[static_cast<std::size_t>(peak.node)])
      line.push_back(fmt::format("{:.4g}", x * per_millimetre));
  }
  fmt::print("{}", aligned(lines, lines[0].size()));
}

}  // namespace

bool is_results_file(const std::string& file) { return file.ends_with(".h5") || file.ends_with(".hdf5"); }

void require_no_run_options(const SolidArguments& arguments) {
  const auto refuse = [](const char* option) {
    throw InputError(
        Fault{{"", 0, 0}, option, "it belongs to the stresses of a run", "results (.h5) in place of a mesh", ""});
  };
  if (!arguments.body.empty()) refuse("--body");
  if (!arguments.instants.empty()) refuse("--instant");
  if (!arguments.vtkhdf.empty()) refuse("--vtkhdf");
  if (!arguments.model_file.empty()) refuse("--model");
}

int run_stress_command(const SolidArguments& arguments) {
  require_no_constant_loads(arguments);
  session::require_separate({{"--vtkhdf", arguments.vtkhdf}}, {arguments.file});
  if (!arguments.vtkhdf.empty() && !arguments.force && std::filesystem::exists(arguments.vtkhdf))
    throw InputError(
        Fault{{"", 0, 0}, "--vtkhdf", arguments.vtkhdf.string() + " exists", "a new file, or --force", ""});
  const results::Reader results(arguments.file);
  const model::Model model = run::model_of_results(results, arguments.model_file);
  const run::BodyStress stress(results, model, arguments.body);
  const run::BodyStress::Envelope envelope = stress.envelope();
  std::vector<run::StressPeak> shown =
      run::largest_stresses(envelope.peaks, static_cast<std::size_t>(arguments.largest));
  const run::StressPeak largest = shown.front();
  if (!arguments.instants.empty()) {
    std::vector<double> angles;
    for (const run::StressPeak& peak : envelope.peaks)
      if (peak.crank_angle) angles.push_back(*peak.crank_angle);
    shown.clear();
    for (const std::size_t k : named_instants(arguments.instants, stress.times(), angles))
      shown.push_back(envelope.peaks[k]);
  }
  if (!arguments.vtkhdf.empty()) {
    std::vector<std::size_t> instants;
    for (const run::StressPeak& peak : shown) instants.push_back(peak.instant);
    std::sort(instants.begin(), instants.end());
    write_stresses(arguments.vtkhdf, stress, envelope, instants);
  }
  if (arguments.json) {
    nlohmann::json document{{"file", arguments.file},
                            {"body", stress.body()},
                            {"nodes", stress.mesh().nodes.size()},
                            {"instants_of_run", stress.times().size()},
                            {"largest", json_of(stress, largest)},
                            {"instants", nlohmann::json::array()},
                            {"units", {{"time", "s"}, {"crank_angle", "rad"}, {"von_mises", "Pa"}, {"position", "m"}}}};
    for (const run::StressPeak& peak : shown) document["instants"].push_back(json_of(stress, peak));
    fmt::print("{}\n", document.dump(2));
    return kOk;
  }
  fmt::print("body      {}, {} nodes, {} shapes\n", stress.body(), stress.mesh().nodes.size(), stress.shapes());
  fmt::print("instants  {}, from {:.6g} ms to {:.6g} ms\n\n", stress.times().size(),
             stress.times().front() * per_millisecond, stress.times().back() * per_millisecond);
  fmt::print("{}\n", arguments.instants.empty() ? "instants of largest stress (mean of the elements at a node)"
                                                : "largest stress at these instants (mean of the elements at a node)");
  print_peaks(stress, shown);
  if (!arguments.vtkhdf.empty()) fmt::print("\nfor ParaView: {}\n", arguments.vtkhdf.string());
  return kOk;
}

}  // namespace hersey::cli
