#include "bearing_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "hersey/bearing/film_coordinates.h"
#include "hersey/run/film_fields.h"
#include "hersey/study/shear_remarks.h"
#include "table.h"

namespace hersey::cli {
namespace {

using study::BearingFigure;
using study::BearingSolution;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

// Decimals that two digits of the error make sense of: 5.618 +- 0.031.
int decimals_of(double error) { return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12); }

std::string value_text(const BearingFigure& figure) {
  if (figure.grid_error <= 0 || figure.grid_error > std::abs(figure.value)) return fmt::format("{:.5g}", figure.value);
  return fmt::format("{:.{}f}", figure.value, decimals_of(figure.grid_error));
}

std::string grid_error_text(const BearingFigure& figure) {
  if (figure.grid_error < 0) return "";
  if (figure.grid_error < 1e-3) return fmt::format("+- {:.2g} (grid)", figure.grid_error);
  return fmt::format("+- {:.{}f} (grid)", figure.grid_error, decimals_of(figure.grid_error));
}

std::string pressures_of(const film::FilmModel& film) {
  const auto bar = [](double pascal) { return fmt::format("{:.4g} bar", 1e-5 * pascal); };
  const auto outside = [&](const film::Edge& edge) {
    if (edge.kind == film::EdgeKind::leaking)
      return fmt::format("sealed with leakage {:.4g} to {}", edge.leakage, bar(edge.pressure));
    return edge.kind == film::EdgeKind::closed ? std::string("closed") : "at " + bar(edge.pressure);
  };
  const std::string left = outside(film.edge_left), right = outside(film.edge_right);
  std::string text = "edges " + (left == right ? left : left + " and " + right);
  if (film.supply.kind == film::SupplyKind::widest_gap) text += ", fed at the widest gap, " + bar(film.supply.pressure);
  if (film.supply.kind == film::SupplyKind::fixed_angle) {
    text += fmt::format(", fed at {:.4g} deg, {}", film.supply.phi * 57.29577951308232, bar(film.supply.pressure));
  }
  const auto fill = [&](const char* name, const film::Edge& edge) {
    const bool is_open = edge.kind == film::EdgeKind::pressure && edge.pressure <= film.p_cav;
    if (is_open && edge.layer)
      text += fmt::format(", {} one with a layer of {:.4g} um of oil", name, 1e6 * *edge.layer);
    else if (is_open && edge.ambient_fill == 1)
      text += fmt::format(", {} one flooded", name);
    if (is_open && edge.ambient_fill > 0 && edge.ambient_fill < 1)
      text += fmt::format(", {} one in {:.3g} of oil", name, edge.ambient_fill);
  };
  std::string ends;
  for (const film::PatchEnds& end : film.ends) {
    const std::string own = fmt::format(", ends {} and {}", outside(end.first), outside(end.last));
    if (own != ends) text += own;  // those of equal arcs are said once
    ends = own;
  }
  fill("left", film.edge_left);
  fill("right", film.edge_right);
  return film.pressures == film::PressureScale::absolute ? text + " (absolute)" : text;
}

// Describes the roughness of both surfaces, if there is any.
std::string roughness_of(const film::Roughness& roughness) {
  if (!roughness.counts()) return "";
  const auto surface = [](const film::SurfaceRoughness& s) {
    return s.sigma == 0 ? std::string("smooth") : fmt::format("{:.3g} um, gamma {:.3g}", 1e6 * s.sigma, s.gamma);
  };
  return fmt::format("  flow factors of Patir and Cheng: rms roughness of the shell {}, of the journal {}\n",
                     surface(roughness.shell), surface(roughness.journal));
}

std::string heat_of(const BearingSolution& solution) {
  const std::string remark = heat_remark(solution);
  return remark.empty() ? "" : "  " + remark + "\n";
}

// The solver of the film, as in the model file; empty for a bearing of several parts.
std::string solver_of(const BearingSolution& solution) {
  if (!solution.solver) return "";
  switch (*solution.solver) {
    case film::FilmSolver::multigrid:
      return "multigrid";
    case film::FilmSolver::sor:
      return "sor";
    case film::FilmSolver::newton:
      break;
  }
  return "newton";
}

// Under which condition the figures hold: at light loads it decides about them.
std::string condition_of(const BearingSolution& solution) {
  const film::FilmModel& film = solution.model;
  const std::string_view law = film::cavitation_law(film).text();
  const std::string_view cavitation = law.substr(0, law.find(' '));
  const bearing::SteadySummary& work = solution.summary;
  const std::string film_work =
      work.film_iterations > 0 ? fmt::format(" and {} film iterations", work.film_iterations) : "";
  std::string surfaces, shear;
  for (const auto& [name, text] : surface_remarks(solution)) surfaces += fmt::format("  {}: {}\n", name, text);
  for (const auto& [name, text] : study::shear_remarks(solution)) shear += fmt::format("  {}\n", text);
  const std::string solver = solution.solver ? fmt::format(" (solver: {})", solver_of(solution)) : "";
  return fmt::format("  {} cavitation at {:.4g} bar, {}; grid {} x {}; {} film linearisations{}{}, {:.3g} s\n",
                     cavitation, 1e-5 * film.p_cav, pressures_of(film), film.grid.n_phi, film.grid.n_z, work.iterations,
                     film_work, solver, solution.wall_time) +
         shear + roughness_of(film.roughness) + surfaces + heat_of(solution);
}

const BearingFigure& figure(const std::vector<BearingFigure>& figures, const std::string& key) {
  return *std::find_if(figures.begin(), figures.end(), [&](const BearingFigure& f) { return f.key == key; });
}

}  // namespace

std::string whirl_remark(const BearingSolution& solution) {
  if (solution.whirl.always_stable) return "a rigid rotor is stable at every mass";
  if (solution.whirl.never_stable) return "a rigid rotor is unstable at every mass";
  return "";
}

std::string heat_remark(const BearingSolution& solution) {
  if (!solution.has_temperatures()) return "";
  if (solution.thermal_coefficients == study::ThermalCoefficients::total)
    return "stiffness and damping with temperatures that follow the motion";
  return "stiffness and damping at the temperatures as they are (--thermal-coefficients total: as they follow)";
}

std::vector<std::pair<std::string, std::string>> surface_remarks(const BearingSolution& solution) {
  std::vector<std::pair<std::string, std::string>> remarks;
  if (!solution.elasticity) return remarks;
  const auto add = [&](const char* name, const std::shared_ptr<const bearing::SurfaceFlexibility>& surface) {
    if (!surface) return;
    const SurfaceFunctions& functions = surface->surface->functions;
    remarks.emplace_back(
        name, fmt::format("deforms at rest with the mesh of {}, {} x {} functions; supported at {}", surface->body,
                          functions.around(), functions.along(), fmt::join(surface->supported_at, ", ")));
  };
  add("shell", solution.elasticity->shell);
  add("journal", solution.elasticity->journal);
  return remarks;
}

std::string bearing_text(const BearingSolution& solution) {
  std::vector<std::vector<std::string>> lines;
  for (const BearingFigure& f : study::figures_of(solution)) {
    if (f.words.empty())
      lines.push_back({f.label, value_text(f), f.unit, grid_error_text(f)});
    else
      lines.push_back({f.label, "-", "", f.words});
  }
  return condition_of(solution) + aligned(lines, 2);
}

std::string bearing_comparison_text(const std::vector<BearingSolution>& solutions) {
  std::vector<std::pair<const char*, const char*>> wanted{{"load", "W"},
                                                          {"eccentricity_ratio", "ecc. ratio"},
                                                          {"ring_speed_ratio", "ring speed ratio"},
                                                          {"film_eccentricity_ratio_inner", "ecc. ratio inner"},
                                                          {"film_eccentricity_ratio_outer", "ecc. ratio outer"},
                                                          {"film_h_min_inner", "h_min inner"},
                                                          {"film_h_min_outer", "h_min outer"},
                                                          {"attitude", "attitude"},
                                                          {"h_min", "h_min"},
                                                          {"p_max", "p_max"},
                                                          {"friction_journal", "friction"},
                                                          {"friction_runner", "friction"},
                                                          {"asperity_share", "contact"},
                                                          {"power_films", "power"},
                                                          {"side_flow", "side flow"},
                                                          {"sommerfeld_S", "S"},
                                                          {"load_number", "load number"},
                                                          {"T_effective", "oil"},
                                                          {"T_max", "hottest oil"}};
  // Kinds of bearing and models of heat differ in their figures: those are compared that all have.
  for (const BearingSolution& solution : solutions) {
    if (!solution.solved()) continue;
    const std::vector<BearingFigure> figures = study::figures_of(solution);
    std::erase_if(wanted, [&](const auto& one) {
      return std::none_of(figures.begin(), figures.end(), [&](const BearingFigure& f) { return f.key == one.first; });
    });
  }
  const auto error_of_grid = [](const std::vector<BearingFigure>& figures) {
    const auto at =
        std::find_if(figures.begin(), figures.end(), [](const BearingFigure& f) { return f.key == "h_min"; });
    return at == figures.end() ? -1.0 : at->grid_error;
  };
  const bool has_error = std::any_of(solutions.begin(), solutions.end(), [&](const BearingSolution& solution) {
    return solution.solved() && error_of_grid(study::figures_of(solution)) >= 0;
  });
  std::vector<std::vector<std::string>> lines;
  for (const BearingSolution& solution : solutions) {
    if (!solution.solved()) continue;
    const std::vector<BearingFigure> figures = study::figures_of(solution);
    if (lines.empty()) {
      lines.push_back({""});
      for (const auto& [key, heading] : wanted) lines.back().push_back(with_unit(heading, figure(figures, key).unit));
      if (has_error) lines.back().push_back("h_min +- (grid)");
    }
    lines.push_back({solution.run.label});
    for (const auto& [key, heading] : wanted) lines.back().push_back(fmt::format("{:.5g}", figure(figures, key).value));
    if (!has_error) continue;
    const double error = error_of_grid(figures);
    lines.back().push_back(error < 0 ? "-" : fmt::format("{:.2g}", error));
  }
  const std::string shear = study::shear_remark(solutions);
  return (shear.empty() ? "" : shear + "\n") + aligned(lines, 99);
}

std::string bearing_csv(const std::vector<BearingSolution>& solutions) {
  // Some figures belong to some solutions only: a column exists if one of them has it, and is empty where it has none.
  std::vector<std::string> columns;
  std::vector<std::map<std::string, double>> figures;
  for (const BearingSolution& solution : solutions) {
    std::map<std::string, double>& row = figures.emplace_back();
    if (!solution.solved()) continue;
    auto next = columns.begin();  // where a column that is new belongs
    const auto add = [&](const std::string& name, double value) {
      auto at = std::find(columns.begin(), columns.end(), name);
      if (at == columns.end()) at = columns.insert(next, name);
      next = at + 1;
      row[name] = value;
    };
    for (const BearingFigure& f : study::figures_of(solution)) {
      add(with_unit(f.key, f.unit), f.value);
      if (f.grid_error >= 0) add(with_unit(f.key + " grid error", f.unit), f.grid_error);
    }
  }
  std::string text;
  for (std::size_t k = 0; k < solutions.size(); ++k) {
    if (!solutions[k].solved()) continue;
    std::vector<std::string> head, cells;
    for (const model::StudyValue& value : solutions[k].run.values) {
      head.push_back(with_unit(value.name, value.unit));
      cells.push_back(fmt::format("{:.10g}", value.number));
    }
    for (const std::string& name : columns)
      cells.push_back(figures[k].contains(name) ? fmt::format("{:.10g}", figures[k].at(name)) : "");
    head.insert(head.end(), columns.begin(), columns.end());
    if (text.empty()) text = fmt::format("{}\n", fmt::join(head, ", "));
    text += fmt::format("{}\n", fmt::join(cells, ", "));
  }
  return text;
}

std::string bearing_fields_csv(const BearingSolution& solution) {
  const film::FilmModel& model = solution.model;
  const film::FilmFields fields = study::fields_of(solution);
  std::vector<const run::FilmField*> shown;
  std::vector<Eigen::VectorXd> columns;
  const bearing::FilmCoordinate along = bearing::coordinate_along(model), across = bearing::coordinate_across(model);
  const bool is_round = film::is_round(model.surface);
  const double shown_along = is_round ? 180 / std::numbers::pi : 1e3;
  std::string text = fmt::format("{}, {} [mm]", is_round ? "angle [deg]" : "y [mm]", across.name);
  for (const run::FilmField& field : run::film_fields()) {
    Eigen::VectorXd values = field.values(fields);
    if (values.size() == 0) continue;
    text += ", " + with_unit(field.label, field.shown_unit);
    shown.push_back(&field);
    columns.push_back(std::move(values));
  }
  text += "\n";
  for (int i = 0; i < model.grid.n_phi; ++i) {
    for (int j = 0; j < model.grid.n_z; ++j) {
      text += fmt::format("{:.8g}, {:.8g}", shown_along * along.values[i], 1e3 * across.values[j]);
      for (std::size_t k = 0; k < columns.size(); ++k)
        text += fmt::format(", {:.8g}", shown[k]->shown_per_si * columns[k][model.grid.index(i, j)]);
      text += "\n";
    }
  }
  return text;
}

namespace {

// Slopes that are no number are left out.
nlohmann::json sensitivity_json(const BearingSolution& solution, const study::Sensitivity& sensitivity) {
  nlohmann::json document{{"parameter", sensitivity.parameter},
                          {"value", sensitivity.value},
                          {"unit", sensitivity.unit},
                          {"exact", sensitivity.exact}};
  if (!sensitivity.solved()) document["error"] = sensitivity.message;
  const std::vector<BearingFigure> figures = study::figures_of(solution);
  for (std::size_t k = 0; k < sensitivity.slopes.size(); ++k)
    if (std::isfinite(sensitivity.slopes[k])) document["derivatives"][figures[k].key] = sensitivity.slopes[k];
  return document;
}

// Returns the last two parts of a key path, which distinguish parameters: "main.width", "operating_point.load" is
// "load".
std::string short_name(const std::string& path) {
  const std::size_t dot = path.find_last_of('.');
  const std::string last = path.substr(dot + 1);
  if (last != "pressure" && last != "temperature") return last;
  const std::size_t before = path.find_last_of('.', dot - 1);
  return path.substr(before + 1);
}

// A percentage of zero, of an angle or of an error is meaningless.
bool has_percentage(const BearingFigure& figure) {
  const bool is_error = figure.key.find("error") != std::string::npos;
  const bool is_position = figure.unit == "deg" || figure.key.ends_with("_z");
  return figure.value != 0 && figure.words.empty() && !is_error && !is_position && figure.unit != "degC";
}

}  // namespace

std::string sensitivity_text(const BearingSolution& solution, const std::vector<study::Sensitivity>& sensitivities) {
  std::string remarks;
  std::vector<std::vector<std::string>> lines{{"change in % where grows by 1 %:"}};
  std::vector<const study::Sensitivity*> columns;
  for (const study::Sensitivity& s : sensitivities) {
    if (!s.solved()) {
      remarks += fmt::format("  no sensitivity to {}: {}\n", s.parameter, s.message);
      continue;
    }
    if (!s.exact) remarks += fmt::format("  {}: from two solutions beside this one\n", s.parameter);
    columns.push_back(&s);
    lines.front().push_back(short_name(s.parameter));
  }
  const std::vector<BearingFigure> figures = study::figures_of(solution);
  for (std::size_t k = 0; k < figures.size(); ++k) {
    if (!has_percentage(figures[k])) continue;
    std::vector<std::string>& line = lines.emplace_back(std::vector<std::string>{figures[k].label});
    for (const study::Sensitivity* s : columns) {
      const double share = s->slopes[k] * s->value / (figures[k].si * figures[k].value);
      line.push_back(!std::isfinite(share) ? "-" : fmt::format("{:.3f}", std::abs(share) < 5e-4 ? 0 : share));
    }
  }
  return "\n" + aligned(lines, 99) + remarks;
}

nlohmann::json bearing_json(const BearingSolution& solution, const std::vector<study::Sensitivity>& sensitivities) {
  nlohmann::json document{{"label", solution.run.label}, {"error", solution.message}};
  for (const model::StudyValue& value : solution.run.values) document["values"][value.name] = value.text;  // as given
  if (!solution.solved()) return document;
  for (const auto& [name, text] : surface_remarks(solution)) document["surfaces"][name] = text;
  for (const auto& [name, text] : study::shear_remarks(solution)) document["conditions"][name] = text;
  if (!solution.warnings.empty()) document["warnings"] = solution.warnings;
  if (solution.solver) document["solver"] = solver_of(solution);
  document["linearisations"] = solution.summary.iterations;
  document["film_iterations"] = solution.summary.film_iterations;
  document["wall_time"] = solution.wall_time;
  for (const BearingFigure& f : study::figures_of(solution)) {
    nlohmann::json& entry = document["figures"][f.key];
    entry = {{"name", f.name}, {"value", f.si * f.value}, {"unit", f.si_unit}};
    if (f.label != f.name) entry["label"] = f.label;  // in the printed table
    if (f.grid_error >= 0) entry["grid_error"] = f.si * f.grid_error;
    if (!f.words.empty()) entry["value"] = nullptr, entry["words"] = f.words;
  }
  const auto rows = [](const auto& M) {
    nlohmann::json list = nlohmann::json::array();
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
      const Eigen::VectorXd row = M.row(i);
      list.push_back(std::vector<double>(row.begin(), row.end()));
    }
    return list;
  };
  if (solution.has_temperatures()) {
    const bool follow = solution.thermal_coefficients == study::ThermalCoefficients::total;
    document["thermal_coefficients"] = follow ? "total" : "frozen";
  }
  document["stiffness_with_tilt"] = rows(solution.state.coefficients.stiffness);
  document["damping_with_tilt"] = rows(solution.state.coefficients.damping);
  if (solution.pads) {
    const study::PadBearingSolution& pads = *solution.pads;
    document["pads"] = {{"coordinates", pads.coordinates},
                        {"whirl_ratio", pads.whirl_ratio},
                        {"stiffness", rows(pads.stiffness)},
                        {"damping", rows(pads.damping)},
                        {"mass", rows(pads.mass)}};
  }
  for (const study::Sensitivity& sensitivity : sensitivities)
    document["sensitivities"].push_back(sensitivity_json(solution, sensitivity));
  return document;
}

}  // namespace hersey::cli
