#include <stdexcept>

#include "hersey/core/packer.h"
#include "instance.h"

namespace hersey::fmu {
namespace {

constexpr std::uint64_t kMark = 0x3154532d59525348;  // "HSRY-ST1"

}  // namespace

std::vector<unsigned char> to_bytes(const InstanceState& state) {
  Packer packer;
  packer.put(kMark);
  packer.put(static_cast<int>(state.phase));
  packer.put(state.values);
  packer.put(static_cast<std::uint64_t>(state.is_set.size()));
  for (const bool is_set : state.is_set) packer.put(is_set);
  packer.put(state.start_time);
  packer.put(state.is_set_up);
  packer.put(state.stop_time.has_value());
  packer.put(state.stop_time.value_or(0));
  packer.put(state.time);
  packer.put(state.simulation.has_value());
  if (state.simulation) packer.put(*state.simulation);
  return packer.take();
}

InstanceState from_bytes(const unsigned char* bytes, std::size_t size) {
  Unpacker unpacker(bytes, size);
  if (unpacker.number<std::uint64_t>() != kMark) throw std::runtime_error("bytes that are no serialised state");
  InstanceState state;
  const int phase = unpacker.number<int>();
  if (phase < 0 || phase > static_cast<int>(Phase::failed)) throw std::runtime_error("a damaged serialised state");
  state.phase = static_cast<Phase>(phase);
  state.values = unpacker.list<double>();
  for (const unsigned char is_set : unpacker.list<unsigned char>()) state.is_set.push_back(is_set != 0);
  if (state.is_set.size() != state.values.size()) throw std::runtime_error("a damaged serialised state");
  state.start_time = unpacker.number<double>();
  state.is_set_up = unpacker.number<unsigned char>() != 0;
  const bool has_stop = unpacker.number<unsigned char>() != 0;
  const auto stop = unpacker.number<double>();
  if (has_stop) state.stop_time = stop;
  state.time = unpacker.number<double>();
  if (unpacker.number<unsigned char>() != 0) state.simulation = unpacker.content();
  unpacker.require_end();
  return state;
}

namespace {

// Puts a state into a place of the importer's, which may hold one already.
void keep(InstanceState state, void** kept) {
  if (*kept == nullptr) *kept = new KeptState;
  *static_cast<KeptState*>(*kept) = {std::move(state)};
}

}  // namespace

CallStatus Instance::save(void** kept) {
  if (const CallStatus refused = refuse_in_update(); refused != CallStatus::ok) return refused;
  if (kept == nullptr) return error("no room for a state");
  return guarded([&] {
    keep(state_now(), kept);
    return CallStatus::ok;
  });
}

CallStatus Instance::restore(void* kept) {
  if (const CallStatus refused = refuse_in_update(); refused != CallStatus::ok) return refused;
  if (kept == nullptr) return error("no state to restore");
  return guarded([&] {
    take(static_cast<KeptState*>(kept)->state);
    return CallStatus::ok;
  });
}

CallStatus Instance::serialised_size(void* kept, std::size_t* size) {
  if (kept == nullptr || size == nullptr) return error("no state to serialise");
  auto& one = *static_cast<KeptState*>(kept);
  if (one.bytes.empty()) one.bytes = to_bytes(one.state);
  *size = one.bytes.size();
  return CallStatus::ok;
}

CallStatus Instance::serialise(void* kept, unsigned char* bytes, std::size_t size) {
  std::size_t needed = 0;
  if (const CallStatus outcome = serialised_size(kept, &needed); outcome != CallStatus::ok) return outcome;
  if (bytes == nullptr || size < needed) return error("too little room for the serialised state");
  std::memcpy(bytes, static_cast<KeptState*>(kept)->bytes.data(), needed);
  return CallStatus::ok;
}

CallStatus Instance::deserialise(const unsigned char* bytes, std::size_t size, void** kept) {
  if (bytes == nullptr || kept == nullptr) return error("no bytes of a serialised state");
  keep(from_bytes(bytes, size), kept);
  return CallStatus::ok;
}

CallStatus Instance::free_state(void** kept) {
  if (kept == nullptr) return CallStatus::ok;
  delete static_cast<KeptState*>(*kept);
  *kept = nullptr;
  return CallStatus::ok;
}

}  // namespace hersey::fmu
