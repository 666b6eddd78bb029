#include "timing_table.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "hersey/core/task_pool.h"
#include "table.h"

namespace hersey::cli {
namespace {

constexpr std::size_t most_films = 4;  // with a line of their own; the costliest has its parts besides
constexpr double visible = 5e-4;       // of the total: what is less would be printed as 0.0 %

using Lines = std::vector<std::vector<std::string>>;

/// Adds lines with seconds and their share of the whole.
class Times {
 public:
  Times(double total, Lines& lines) : total_(total), lines_(lines) {}

  void add(const std::string& name, double seconds, const std::string& remark = {}) {
    if (seconds < visible * total_) return;
    lines_.push_back({name, fmt::format("{:.3f}", seconds), fmt::format("{:.1f}", 100 * seconds / total_), remark});
  }

 private:
  double total_;
  Lines& lines_;
};

std::string each(double seconds, double count, const char* what) {
  return count > 0 ? fmt::format("{:.3g} ms each of {:.0f} {}", 1e3 * seconds / count, count, what) : "";
}

// @param seconds   of all that belongs to the film
// @param scale     of its parts to the time that was waited for them
// @param indent    of the names of its parts
void add_parts(const film::FilmWork& work, double seconds, double scale, const std::string& indent, Times& times) {
  times.add(indent + "nodes and flows", scale * work.balance, each(work.balance, work.evaluations, "evaluations"));
  times.add(indent + "Jacobian", scale * work.jacobian);
  times.add(indent + "factors", scale * work.factors, each(work.factors, work.factorisations, "factorisations"));
  times.add(indent + "right-hand sides", scale * work.solutions);
  times.add(indent + "along motions", scale * work.derivatives);
  times.add(indent + "forces", scale * work.forces);
  times.add(indent + "surfaces, heat, history", scale * (seconds - work.total()));
}

std::string speed_of(const film::FilmWork& work, int nodes) {
  return fmt::format("{} nodes; {:.2g} million unknowns evaluated a second", nodes,
                     1e-6 * nodes * static_cast<double>(work.evaluations) / work.total());
}

// @returns part and film of each, the costliest first
std::vector<std::pair<double, const run::FilmCost*>> costliest_films(const run::Work& work) {
  std::vector<std::pair<double, const run::FilmCost*>> films;
  for (const run::FilmCost& film : work.films)
    for (const run::WorkPart& part : work.parts)
      if (part.name == "film " + film.bearing && film.seconds > 0) films.emplace_back(part.seconds, &film);
  std::stable_sort(films.begin(), films.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  return films;
}

// Films are solved in parallel: parts are scaled to the time that the steps waited for them.
void add_films(const run::Work& work, Times& times) {
  const auto films = costliest_films(work);
  double others = 0;
  for (std::size_t k = 0; k < films.size(); ++k) {
    const auto& [waited, film] = films[k];
    if (k < most_films)
      times.add("    film " + film->bearing, waited, speed_of(film->work, film->nodes));
    else
      others += waited;
    if (k == 0) add_parts(film->work, film->seconds, waited / film->seconds, "        ", times);
  }
  if (films.size() > most_films)
    times.add("    other films", others, fmt::format("{} of them", films.size() - most_films));
}

}  // namespace

double largest_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-3 * static_cast<double>(usage.ru_maxrss);  // Linux counts in kB
}

std::string timing_text(const run::Summary& summary, double total) {
  const run::Work& work = summary.work;
  Lines lines{{"computing time", "s", "%", ""}};
  Times times(total, lines);
  times.add("in all", total,
            fmt::format("{} threads at most, {:.0f} MB of memory", TaskPool::shared().threads(), largest_memory()));
  times.add("start", work.start_up, "reading, meshes, reduction, starting state");
  times.add("steps", work.stepping,
            each(work.stepping, summary.steps, "steps") +
                fmt::format("; {:.1f} Newton iterations", work.newton_iterations.mean));
  add_films(work, times);
  for (const run::WorkPart& part : work.parts)
    if (!part.name.starts_with("film ")) times.add("    " + part.name, part.seconds);
  times.add("closing results, report", total - work.start_up - work.stepping);
  return aligned(lines, 3);
}

std::string timing_text(const study::BearingSolution& solution) {
  const film::FilmWork& work = solution.summary.work;
  Lines lines{{"computing time", "s", "%", ""}};
  Times times(solution.wall_time, lines);
  times.add("in all", solution.wall_time,
            fmt::format("{} threads at most, {:.0f} MB of memory", TaskPool::shared().threads(), largest_memory()));
  if (work.total() == 0) return aligned(lines, 3);
  times.add("film", work.total(), speed_of(work, solution.model.grid.size()));
  add_parts(work, work.total(), 1, "    ", times);
  times.add("other grids, coefficients", solution.wall_time - work.total());
  return aligned(lines, 3);
}

}  // namespace hersey::cli
