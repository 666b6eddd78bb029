// A journal in its film, stepped from outside: half way through another load is put on.
#include <hersey/core/input_error.h>
#include <hersey/model/read.h>
#include <hersey/run/simulation.h>

#include <cstdio>

int main(int argc, char** argv) {
  using namespace hersey;
  if (argc < 2) return std::fprintf(stderr, "usage: rotor MODEL\n"), 2;
  try {
    run::Simulation simulation(model::read(argv[1]));
    const double middle = (simulation.start() + simulation.end()) / 2;
    run::Advance advance = simulation.advance_to(middle);
    std::printf("film %.2f um", 1e6 * simulation.output("bearings.film.h_min")[0]);
    simulation.set("forces.weight.components.y", -900);  // [N]
    while (advance.status == run::Advance::Status::advanced) advance = simulation.step();
    if (!advance.solved()) return std::fprintf(stderr, "%s\n", advance.message.c_str()), 1;
    std::printf(", at the end %.2f um\n", 1e6 * simulation.output("bearings.film.h_min")[0]);
  } catch (const InputError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
