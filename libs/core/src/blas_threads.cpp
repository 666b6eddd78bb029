#include "hersey/core/blas_threads.h"

// Functions of the BLAS and OpenMP libraries with which the program is linked; null for those of other libraries.
extern "C" {
__attribute__((weak)) void openblas_set_num_threads(int threads);
__attribute__((weak)) int blas_thread_shutdown_();
__attribute__((weak)) void MKL_Set_Num_Threads(int threads);
__attribute__((weak)) void bli_thread_set_num_threads(long threads);
__attribute__((weak)) void omp_set_num_threads(int threads);
}

namespace hersey {

void use_one_blas_thread() {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  if (MKL_Set_Num_Threads != nullptr) MKL_Set_Num_Threads(1);
  if (bli_thread_set_num_threads != nullptr) bli_thread_set_num_threads(1);
  if (omp_set_num_threads != nullptr) omp_set_num_threads(1);
}

void end_blas_threads() {
  if (blas_thread_shutdown_ != nullptr) (void)blas_thread_shutdown_();
}

}  // namespace hersey
