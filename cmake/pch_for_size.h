// What pch.h is to the rest, for what is compiled for size: there Eigen's functions are each object's own. Of an inline
// function the linker keeps one copy for all, and the products of matrices of every step must not end in one that is
// small and slow (docs/decisions/0019-compilers.md).
#pragma once

// What Eigen includes for the instructions of a processor, outside of the pragma.
#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <climits>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iosfwd>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <ostream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#pragma clang attribute push(__attribute__((internal_linkage)), apply_to = function)
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#pragma clang attribute pop
