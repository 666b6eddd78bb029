#pragma once

namespace hersey {

/// Limits BLAS and OpenMP to one thread each. The round-off of their sums depends on the number of threads, and results
/// of a run must not depend on the machine's processors. Programs call it before they compute.
void use_one_blas_thread();

}  // namespace hersey
