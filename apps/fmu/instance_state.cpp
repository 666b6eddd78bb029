#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "instance.h"

namespace hersey::fmu {
namespace {

constexpr std::uint64_t kMark = 0x3154532d59525348;  // "HSRY-ST1"

class Packer {
 public:
  template <class Number>
  void put(const Number& number) {
    static_assert(std::is_arithmetic_v<Number>);
    put_bytes(&number, sizeof number);
  }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    put_bytes(text.data(), text.size());
  }
  template <class Number>
  void put(const std::vector<Number>& list) {
    put(static_cast<std::uint64_t>(list.size()));
    for (const Number value : list) put(value);
  }
  std::vector<unsigned char> take() { return std::move(bytes_); }

 private:
  void put_bytes(const void* from, std::size_t size) {
    const auto* first = static_cast<const unsigned char*>(from);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<unsigned char> bytes_;
};

class Unpacker {
 public:
  Unpacker(const unsigned char* bytes, std::size_t size) : at_(bytes), left_(size) {}

  template <class Number>
  Number number() {
    Number number{};
    copy(&number, sizeof number);
    return number;
  }
  std::string text() {
    std::string text(length(1), '\0');
    copy(text.data(), text.size());
    return text;
  }
  template <class Number>
  std::vector<Number> list() {
    std::vector<Number> values;
    const std::size_t count = length(sizeof(Number));
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) values.push_back(number<Number>());
    return values;
  }
  void require_end() const {
    if (left_ != 0) throw std::runtime_error("a serialised state with more behind its end");
  }

 private:
  // Never more than is there: a damaged length asks for no memory.
  std::size_t length(std::size_t each) {
    const auto count = number<std::uint64_t>();
    if (count > left_ / each) throw std::runtime_error("a serialised state that is cut off");
    return static_cast<std::size_t>(count);
  }
  void copy(void* to, std::size_t size) {
    if (size > left_) throw std::runtime_error("a serialised state that is cut off");
    if (size > 0) std::memcpy(to, at_, size);
    at_ += size;
    left_ -= size;
  }
  const unsigned char* at_;
  std::size_t left_;
};

void put(Packer& packer, const Archive::Content& content) {
  packer.put(static_cast<std::uint64_t>(content.numbers.size()));
  for (const auto& [name, numbers] : content.numbers) {
    packer.put(name);
    packer.put(numbers.shape);
    packer.put(numbers.values);
  }
  packer.put(static_cast<std::uint64_t>(content.texts.size()));
  for (const auto& [name, text] : content.texts) {
    packer.put(name);
    packer.put(text);
  }
}

Archive::Content content_of(Unpacker& unpacker) {
  Archive::Content content;
  for (auto left = unpacker.number<std::uint64_t>(); left > 0; --left) {
    const std::string name = unpacker.text();
    Archive::Numbers& numbers = content.numbers[name];
    numbers.shape = unpacker.list<std::uint64_t>();
    numbers.values = unpacker.list<double>();
  }
  for (auto left = unpacker.number<std::uint64_t>(); left > 0; --left) {
    const std::string name = unpacker.text();
    content.texts[name] = unpacker.text();
  }
  return content;
}

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
  if (state.simulation) put(packer, *state.simulation);
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
  if (unpacker.number<unsigned char>() != 0) state.simulation = content_of(unpacker);
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
  if (kept == nullptr) return error("no room for a state");
  return guarded([&] {
    keep(state_now(), kept);
    return CallStatus::ok;
  });
}

CallStatus Instance::restore(void* kept) {
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
