#pragma once

namespace hersey {

/// Limits BLAS and OpenMP to one thread each. The round-off of their sums depends on the number of threads, and results
/// of a run must not depend on the machine's processors. Programs call it before they compute.
void use_one_blas_thread();

/// Ends the threads that OpenBLAS has begun while it was loaded, which wait for work in a busy loop of some 50 ms of
/// each core. For programs of our own: in others, such as Python, they serve other libraries. Comes after
/// use_one_blas_thread(); does nothing with other libraries.
void end_blas_threads();

}  // namespace hersey
