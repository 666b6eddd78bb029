// A model file from its faults to its results, with what happens on the way.
#include <hersey/results/error.h>
#include <hersey/session/session.h>

#include <cstdio>

class Screen : public hersey::session::Listener {
 public:
  void warned(std::size_t /*run*/, const std::vector<hersey::Fault>& warnings) override {
    for (const hersey::Fault& warning : warnings) std::printf("warning: %s\n", warning.text().c_str());
  }
  void finished(std::size_t /*run*/, const hersey::study::RunResult& result) override {
    std::printf("%d steps, results in %s\n", result.summary.steps, result.summary.results.c_str());
  }
};

int main(int argc, char** argv) {
  using namespace hersey;
  if (argc < 3) return std::fprintf(stderr, "usage: run MODEL RESULTS [NAME=VALUE ...]\n"), 2;
  try {
    const session::Session session(argv[1], {argv + 3, argv + argc});
    Screen screen;
    const run::Summary summary = session.run(argv[2], {.check_start = true}, screen);
    if (!summary.solved()) return std::fprintf(stderr, "%s\n", summary.message.c_str()), 1;
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) std::fprintf(stderr, "%s\n", fault.text().c_str());
    return 2;
  } catch (const results::FileError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
