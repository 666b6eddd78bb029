#include "series/work_record.h"

#include <algorithm>
#include <numeric>

namespace hersey::run {
namespace {

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

double total_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::string scheme_of(const model::Coupling& coupling) {
  if (coupling.scheme == model::CouplingScheme::monolithic) return "monolithic";
  switch (coupling.acceleration) {
    case solver::Acceleration::constant:
      return "partitioned, constant relaxation";
    case solver::Acceleration::aitken:
      return "partitioned, Aitken";
    case solver::Acceleration::quasi_newton:
      return "partitioned, quasi-Newton";
  }
  return {};
}

void persist_work(Archive& archive, film::FilmWork& work) {
  archive.io("balance", work.balance), archive.io("jacobian", work.jacobian), archive.io("factors", work.factors);
  archive.io("solutions", work.solutions), archive.io("derivatives", work.derivatives);
  archive.io("forces", work.forces), archive.io("evaluations", work.evaluations);
  archive.io("factorisations", work.factorisations);
}

}  // namespace

void StepCounts::take(int count) {
  const auto index = static_cast<std::size_t>(std::max(count, 0));
  if (index >= times_.size()) times_.resize(index + 1, 0);
  ++times_[index];
}

PerStep StepCounts::per_step() const {
  PerStep figures;
  const long long steps = std::accumulate(times_.begin(), times_.end(), 0LL);
  if (steps == 0) return figures;
  // The median is the mean of the two middle ones, which may be the same.
  const long long lower = (steps - 1) / 2, upper = steps / 2;
  long long counted = 0;
  double total = 0;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const auto count = static_cast<double>(k);
    for (const long long middle : {lower, upper})
      if (counted <= middle && middle < counted + times_[k]) figures.median += 0.5 * count;
    counted += times_[k];
    total += count * times_[k];
    if (times_[k] > 0) figures.most = static_cast<int>(k);
  }
  figures.mean = total / static_cast<double>(steps);
  return figures;
}

WorkRecord::WorkRecord(const model::Model& model, const model::Machine& machine, const solver::Integrator& integrator)
    : model_(model),
      machine_(machine),
      integrator_(integrator),
      made_(Clock::now()),
      began_(made_),
      films_before_(model.bearings.size()),
      film_iterations_(model.bearings.size()),
      exchanges_(model.bearings.size()) {}

void WorkRecord::begin() {
  began_ = Clock::now();
  spent_at_begin_ = spent();
  is_begun_ = true;
}

void WorkRecord::take(const StepRecord& step) {
  if (step.dt == 0) return;
  newton_iterations_.take(step.newton_iterations);
  for (std::size_t i = 0; i < step.bearings.size(); ++i) {
    film_iterations_[i].take(step.bearings[i].film_iterations);
    exchanges_[i].take(step.bearings[i].exchanges);
  }
}

std::vector<double> WorkRecord::spent() const {
  const mbd::MechanismTiming& timing = machine_.mechanism->timing();
  const double own = total_of(timing.force), elastic = total_of(timing.elastic);
  const double share = own > 0 ? timing.forces / own : 0;
  std::vector<double> seconds;
  double films = 0;
  for (const model::BuiltBearing& bearing : machine_.bearings) {
    seconds.push_back(share * timing.force[static_cast<std::size_t>(bearing.force.index)]);
    films += seconds.back();
  }
  seconds.insert(seconds.end(), {elastic, timing.total - elastic - films, integrator_.linear_solve_time(), recording_});
  if (!model_.fmus.empty()) seconds.push_back(fmus_);
  return seconds;
}

double WorkRecord::start_up() const {
  const auto own = is_begun_ ? std::chrono::duration<double>(began_ - made_).count() : seconds_since(made_);
  return start_up_before_ + own;
}

// The last entry is the time that no part accounts for.
std::vector<double> WorkRecord::stepping() const {
  std::vector<double> seconds = spent();
  seconds.push_back(0);
  if (is_begun_) {
    for (std::size_t i = 0; i < spent_at_begin_.size(); ++i) seconds[i] -= spent_at_begin_[i];
    seconds.back() = seconds_since(began_) - total_of(seconds);
  } else {
    std::fill(seconds.begin(), seconds.end(), 0.0);
  }
  for (std::size_t i = 0; i < spent_before_.size(); ++i) seconds[i] += spent_before_[i];
  return seconds;
}

std::vector<FilmCost> WorkRecord::films() const {
  std::vector<FilmCost> films = films_before_;
  for (std::size_t i = 0; i < films.size(); ++i) {
    const model::BuiltBearing& bearing = machine_.bearings[i];
    films[i].bearing = model_.bearings[i].name;
    films[i].nodes = bearing.bearing->model().grid.size();
    films[i].seconds += machine_.mechanism->timing().force[static_cast<std::size_t>(bearing.force.index)];
    films[i].work += bearing.bearing->work();
  }
  return films;
}

Work WorkRecord::work() const {
  Work work{.start_up = start_up(), .newton_iterations = newton_iterations_.per_step(), .films = films()};
  const std::vector<double> seconds = stepping();
  work.stepping = total_of(seconds);
  std::vector<std::string> names;
  for (const model::Bearing& bearing : model_.bearings) names.push_back("film " + bearing.name);
  names.insert(names.end(), {"elastic bodies", "other bodies and forces", "linear solve", "recording"});
  if (!model_.fmus.empty()) names.emplace_back("FMUs");
  names.emplace_back("rest");
  for (std::size_t i = 0; i < names.size(); ++i) work.parts.push_back({names[i], seconds[i]});
  for (std::size_t i = 0; i < model_.bearings.size(); ++i) {
    const model::Bearing& bearing = model_.bearings[i];
    const bool exchanges = bearing.coupling.scheme == model::CouplingScheme::partitioned;
    work.couplings.push_back({.bearing = bearing.name,
                              .scheme = scheme_of(bearing.coupling),
                              .film_iterations = film_iterations_[i].per_step(),
                              .exchanges = exchanges_[i].per_step(),
                              .steps_as_one = exchanges ? exchanges_[i].without() : 0});
  }
  return work;
}

void WorkRecord::persist(Archive& archive) {
  newton_iterations_.persist(archive, "newton_iterations");
  for (std::size_t i = 0; i < film_iterations_.size(); ++i) {
    const Archive::Group group(archive, model_.bearings[i].name);
    film_iterations_[i].persist(archive, "film_iterations");
    exchanges_[i].persist(archive, "exchanges");
  }
  std::vector<FilmCost> costs = films();
  for (FilmCost& film : costs) {
    const Archive::Group group(archive, film.bearing);
    archive.io("seconds", film.seconds);
    persist_work(archive, film.work);
  }
  double start = start_up();
  std::vector<double> seconds = stepping();
  archive.io("start_up", start), archive.io("seconds", seconds);
  if (!archive.restores()) return;
  films_before_ = std::move(costs);
  start_up_before_ = start;
  spent_before_ = seconds;
}

namespace {

struct Cost {
  const Work& work;
  double wall_time = 0;  ///< [s]
  int steps = 0;
};

/// The three figures of a number per step.
template <class Plan>
void add_per_step(const std::string& name, const char* of, const std::function<PerStep(const Plan&)>& get,
                  std::vector<Attribute<Plan>>& table) {
  table.push_back({name + "_median", "1", std::string(of) + ", median of accepted steps",
                   [get](const Plan& plan) { return get(plan).median; }});
  table.push_back({name + "_mean", "1", "the same, mean", [get](const Plan& plan) { return get(plan).mean; }});
  table.push_back({name + "_most", "1", "the same, most", [get](const Plan& plan) { return get(plan).most; }});
}

const std::vector<Attribute<Cost>>& of_run() {
  static const std::vector<Attribute<Cost>> table{
      {"wall_time", "s", "computing time", &Cost::wall_time, {.note = "of a finished run; 0 before its end"}}};
  return table;
}

const std::vector<Attribute<Cost>>& of_timing() {
  static const std::vector<Attribute<Cost>> table = [] {
    std::vector<Attribute<Cost>> lines{
        {"start_up", "s", "reading, meshes, reduction, the starting state",
         [](const Cost& cost) { return cost.work.start_up; }},
        {"stepping", "s", "all steps, rejected ones and recording included",
         [](const Cost& cost) { return cost.work.stepping; }},
        {"steps", "1", "number of steps", &Cost::steps},
        {"part_names", "", "names of the parts of `stepping`",
         [](const Cost& cost) {
           std::vector<std::string> names;
           for (const WorkPart& part : cost.work.parts) names.push_back(part.name);
           return names;
         }},
    };
    add_per_step<Cost>(
        "newton_iterations", "Newton iterations of a step",
        [](const Cost& cost) { return cost.work.newton_iterations; }, lines);
    return lines;
  }();
  return table;
}

const std::vector<Attribute<Cost>>& of_parts() {
  static const std::vector<Attribute<Cost>> table{
      {"<part>",
       "s",
       "its share of `stepping`",
       [](const Cost& cost, std::size_t k) { return cost.work.parts[k].seconds; },
       {.note = "each film, elastic bodies, other bodies and forces, linear solve, recording, FMUs where there are "
                "some, rest",
        .each = [](const Cost& cost) {
          std::vector<std::string> names;
          for (const WorkPart& part : cost.work.parts) names.push_back(part.name);
          return names;
        }}}};
  return table;
}

const std::vector<Attribute<CouplingWork>>& of_coupling() {
  static const std::vector<Attribute<CouplingWork>> table = [] {
    std::vector<Attribute<CouplingWork>> lines{
        {"scheme", "", "of the coupling of film and bodies", &CouplingWork::scheme},
        {"steps_as_one", "1", "steps of a partitioned coupling solved as one system, as their exchange came to no end",
         &CouplingWork::steps_as_one},
    };
    add_per_step<CouplingWork>("film_iterations", "linearisations of the film in a step",
                               &CouplingWork::film_iterations, lines);
    add_per_step<CouplingWork>("exchanges", "wrenches that film and bodies exchange in a step",
                               &CouplingWork::exchanges, lines);
    return lines;
  }();
  return table;
}

const std::vector<Attribute<FilmCost>>& of_film() {
  static const std::vector<Attribute<FilmCost>> table{
      {"nodes", "1", "of its grid", &FilmCost::nodes},
      {"seconds", "s", "in all, surfaces, temperatures and history included", &FilmCost::seconds},
      {"evaluations", "1", "of its residual, the start's included",
       [](const FilmCost& cost) { return cost.work.evaluations; }},
      {"factorisations", "1", "of its Jacobian", [](const FilmCost& cost) { return cost.work.factorisations; }},
      {"balance", "s", "properties of the oil at the nodes, flows between them, residuals",
       [](const FilmCost& cost) { return cost.work.balance; }},
      {"jacobian", "s", "derivatives of the residual by the unknowns",
       [](const FilmCost& cost) { return cost.work.jacobian; }},
      {"factors", "s", "factorisations", [](const FilmCost& cost) { return cost.work.factors; }},
      {"solutions", "s", "right-hand sides, by factors or multigrid",
       [](const FilmCost& cost) { return cost.work.solutions; }},
      {"derivatives", "s", "residual and forces along motions of the surfaces",
       [](const FilmCost& cost) { return cost.work.derivatives; }},
      {"forces", "s", "sums of pressure and shear, with their derivatives by the unknowns",
       [](const FilmCost& cost) { return cost.work.forces; }},
  };
  return table;
}

}  // namespace

void write_work(const Work& work, double wall_time, int steps, results::Writer& writer) {
  const Cost cost{work, wall_time, steps};
  write_once(of_run(), "/", cost, writer);
  write_once(of_timing(), "/timing/", cost, writer);
  write_once(of_parts(), "/timing/parts/", cost, writer);
  for (const CouplingWork& coupling : work.couplings)
    write_once(of_coupling(), "/timing/couplings/" + coupling.bearing + "/", coupling, writer);
  for (const FilmCost& film : work.films) write_once(of_film(), "/timing/films/" + film.bearing + "/", film, writer);
}

std::vector<QuantityGroup> describe_work() {
  QuantityGroup run{.path = "/", .heading = "of the run", .quantities = {}};
  QuantityGroup timing{.path = "/timing/", .heading = "of a run over time, zeros before its end", .quantities = {}};
  QuantityGroup parts{.path = "/timing/parts/", .heading = "of the parts of the computing time", .quantities = {}};
  QuantityGroup couplings{
      .path = "/timing/couplings/<bearing>/", .heading = "of the coupling of a bearing", .quantities = {}};
  QuantityGroup films{.path = "/timing/films/<bearing>/",
                      .heading = "of the cost of a bearing's film, in the film's own thread",
                      .quantities = {}};
  describe(of_run(), "n", run);
  describe(of_timing(), "n", timing);
  describe(of_parts(), "n", parts);
  describe(of_coupling(), "n", couplings);
  describe(of_film(), "n", films);
  return {run, timing, parts, couplings, films};
}

}  // namespace hersey::run
