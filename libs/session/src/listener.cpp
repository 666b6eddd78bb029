#include "hersey/session/listener.h"

namespace hersey::session {

void Listener::warned(std::size_t /*run*/, const std::vector<Fault>& /*warnings*/) {}

void Listener::stepped(std::size_t /*run*/, const run::Progress& /*progress*/) {}

void Listener::cycle_ended(std::size_t /*run*/, const run::CycleProgress& /*cycle*/) {}

void Listener::stopping() {}

void Listener::finished(std::size_t /*run*/, const study::RunResult& /*result*/) {}

}  // namespace hersey::session
