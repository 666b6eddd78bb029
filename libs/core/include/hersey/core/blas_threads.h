#pragma once

namespace hersey {

/// Keeps BLAS and OpenMP to one thread each: their sums depend on how many there are, and results of a run must not
/// depend on the machine's processors. For programs to call before they compute.
void use_one_blas_thread();

}  // namespace hersey
