#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "export_target.h"
#include "hersey/fem/vtkhdf_file.h"
#include "hersey/run/film_surfaces.h"
#include "instant_option.h"

namespace hersey::cli {
namespace {

run::FilmPlacement placement_of(const std::string& name) {
  static const std::map<std::string, run::FilmPlacement> placements{{"machine", run::FilmPlacement::machine},
                                                                    {"bearing", run::FilmPlacement::bearing},
                                                                    {"unwrapped", run::FilmPlacement::unwrapped}};
  return placements.at(name);
}

void write_films(const std::filesystem::path& path, const run::FilmSurfaces& films,
                 const std::vector<std::size_t>& instants, bool moves) {
  std::vector<double> times;
  for (const std::size_t k : instants) times.push_back(films.times()[k]);
  std::vector<fem::VtkHdfField> fields;
  for (const auto& [name, unit] : films.fields()) fields.push_back({.name = name});
  fields.push_back({.name = "bearing", .on_cells = true, .is_constant = true});
  fem::VtkHdfFile file(path, films.cells(), fields, times, moves);
  for (std::size_t step = 0; step < instants.size(); ++step) {
    if (moves) file.write_points(step, films.points(instants[step]));
    for (std::size_t f = 0; f < films.fields().size(); ++f)
      file.write(step, f, films.field(instants[step], films.fields()[f].first));
  }
  file.write(0, films.fields().size(), films.bearing_of_cells());
  file.write_names("hersey/bearings", films.bearings());
  file.close();
}

void print_films_json(const run::FilmSurfaces& films, const std::vector<std::size_t>& instants,
                      const std::string& path) {
  nlohmann::json document{{"file", path},
                          {"bearings", films.bearings()},
                          {"points", films.cells().points.cols()},
                          {"cells", films.cells().types.size()},
                          {"instants", nlohmann::json::array()},
                          {"fields", nlohmann::json::object()},
                          {"units", {{"instants", "s"}}}};
  for (const std::size_t k : instants) document["instants"].push_back(films.times()[k]);
  for (const auto& [name, unit] : films.fields()) document["fields"][name] = unit;
  fmt::print("{}\n", document.dump(2));
}

void print_films(const run::FilmSurfaces& films, const std::vector<std::size_t>& instants, const std::string& path) {
  constexpr double to_millisecond = 1e3;
  const std::vector<std::string> names = films.bearings();
  for (std::size_t b = 0; b < names.size(); ++b) fmt::print("bearing {:<10}{}\n", b, names[b]);
  fmt::print("grid              {} points, {} cells\n", films.cells().points.cols(), films.cells().types.size());
  for (const auto& [name, unit] : films.fields()) fmt::print("field             {} [{}]\n", name, unit);
  fmt::print("instants          {}, from {:.6g} ms to {:.6g} ms\n", instants.size(),
             films.times()[instants.front()] * to_millisecond, films.times()[instants.back()] * to_millisecond);
  fmt::print("wrote             {}\n", path);
}

}  // namespace

int films_command(const ExportArguments& arguments) {
  require_results_target(arguments, "--films", arguments.films, ".vtkhdf");
  const results::Reader results(arguments.file);
  const run::FilmPlacement placement = placement_of(arguments.surface.empty() ? "machine" : arguments.surface);
  const run::FilmSurfaces films(results, arguments.loads.bearings, placement);
  const std::vector<std::string> asked =
      arguments.loads.instants.empty() ? std::vector<std::string>{"all"} : arguments.loads.instants;
  const std::vector<std::size_t> instants = named_instants(asked, films.times(), films.crank_angles());
  write_films(arguments.films, films, instants, placement == run::FilmPlacement::machine);
  if (arguments.json)
    print_films_json(films, instants, arguments.films.string());
  else
    print_films(films, instants, arguments.films.string());
  return kOk;
}

}  // namespace hersey::cli
