#pragma once

#include <cmath>
#include <cstring>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/// Kernels are compiled twice where a processor may have more instructions than all of its kind: a kernel is inlined
/// into a function for plain ones and into one for fused ones. Its lambdas, functions of their own, say so by
/// themselves.
#if defined(__x86_64__)
#define HERSEY_KERNEL [[gnu::always_inline]] inline
#define HERSEY_FUSED [[gnu::target("avx2,fma")]]
/// Behind the parameters of a lambda of a kernel.
#define HERSEY_INLINED __attribute__((always_inline))
#else
#define HERSEY_KERNEL inline
#define HERSEY_FUSED
#define HERSEY_INLINED
#endif

// Kernels return packed numbers only to functions into which they are inlined: nothing depends on the registers in
// which they would be passed.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace hersey {

#if defined(__x86_64__)
/// True if the processor multiplies and adds four numbers at once.
inline bool has_fused_instructions() {
  static const bool has = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  return has;
}
#else
/// Other processors have one kind of function.
constexpr bool has_fused_instructions() { return false; }
#endif

/// Four numbers that a law is evaluated for at once: one register with fused instructions, two without. A law written
/// for a type `Number` takes them as it takes a double; where it decides, it does so by select().
struct Packed {
  static constexpr int width = 4;
  using Values = double __attribute__((vector_size(32)));
  Values values{};

  Packed() = default;
  /// The numbers of a register.
  HERSEY_KERNEL Packed(const Values& of) : values(of) {}
  /// One number, four times.
  HERSEY_KERNEL Packed(double all) : values{all, all, all, all} {}
  /// Four numbers that follow one another in memory, at any address.
  [[nodiscard]] HERSEY_KERNEL static Packed load(const double* from) {
    Packed packed;
    std::memcpy(&packed.values, from, sizeof(Values));
    return packed;
  }
  /// Writes them to where four numbers follow one another.
  HERSEY_KERNEL void store(double* to) const { std::memcpy(to, &values, sizeof(Values)); }
  HERSEY_KERNEL Packed operator-() const { return -values; }
  HERSEY_KERNEL Packed& operator+=(const Packed& b) {
    values += b.values;
    return *this;
  }
};

/// The outcomes of a comparison of Packed.
struct PackedMask {
  using Values = decltype(Packed::Values{} < Packed::Values{});
  Values values{};
};

HERSEY_KERNEL Packed operator+(const Packed& a, const Packed& b) { return a.values + b.values; }
HERSEY_KERNEL Packed operator-(const Packed& a, const Packed& b) { return a.values - b.values; }
HERSEY_KERNEL Packed operator*(const Packed& a, const Packed& b) { return a.values * b.values; }
HERSEY_KERNEL Packed operator/(const Packed& a, const Packed& b) { return a.values / b.values; }
HERSEY_KERNEL PackedMask operator<(const Packed& a, const Packed& b) { return {a.values < b.values}; }
HERSEY_KERNEL PackedMask operator<=(const Packed& a, const Packed& b) { return {a.values <= b.values}; }
HERSEY_KERNEL PackedMask operator>(const Packed& a, const Packed& b) { return b < a; }
HERSEY_KERNEL PackedMask operator>=(const Packed& a, const Packed& b) { return b <= a; }
HERSEY_KERNEL PackedMask operator==(const Packed& a, const Packed& b) { return {a.values == b.values}; }
HERSEY_KERNEL PackedMask operator&(const PackedMask& a, const PackedMask& b) { return {a.values & b.values}; }
HERSEY_KERNEL PackedMask operator|(const PackedMask& a, const PackedMask& b) { return {a.values | b.values}; }
HERSEY_KERNEL PackedMask operator!(const PackedMask& a) { return {~a.values}; }

/// Returns `yes` where the condition holds, else `no`.
HERSEY_KERNEL Packed select(const PackedMask& condition, const Packed& yes, const Packed& no) {
  return condition.values ? yes.values : no.values;
}
HERSEY_KERNEL double select(bool condition, double yes, double no) { return condition ? yes : no; }

/// Returns `first` where the first condition holds, else `second` where the second does, else `third`.
HERSEY_KERNEL Packed select(const PackedMask& is_first, const Packed& first, const PackedMask& is_second,
                            const Packed& second, const Packed& third) {
  return select(is_first, first, select(is_second, second, third));
}
HERSEY_KERNEL double select(bool is_first, double first, bool is_second, double second, double third) {
  return is_first ? first : is_second ? second : third;
}

/// True if the condition holds for all numbers.
HERSEY_KERNEL bool all(const PackedMask& m) { return (m.values[0] & m.values[1] & m.values[2] & m.values[3]) != 0; }
HERSEY_KERNEL bool all(bool condition) { return condition; }

/// Square roots; of a negative number not a number.
HERSEY_KERNEL Packed square_root(const Packed& a) {
  Packed root;
#if defined(__SSE2__)
  // As instructions: the function would be called for its `errno`.
  for (int k = 0; k < Packed::width; k += 2) {
    const __m128d two = _mm_sqrt_pd(_mm_set_pd(a.values[k + 1], a.values[k]));
    root.values[k] = two[0], root.values[k + 1] = two[1];
  }
#else
  for (int k = 0; k < Packed::width; ++k) root.values[k] = std::sqrt(a.values[k]);
#endif
  return root;
}
/// The square root; of a negative number not a number.
HERSEY_KERNEL double square_root(double a) { return std::sqrt(a); }

/// Number `k` of those that are packed.
HERSEY_KERNEL double lane(const Packed& a, int k) { return a.values[k]; }

}  // namespace hersey

#pragma GCC diagnostic pop
