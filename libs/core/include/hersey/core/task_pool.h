#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace hersey {

/// Returns the number of processors that this program may run on (its affinity mask), at least 1.
[[nodiscard]] int available_processors();

/// Pool of threads for independent parts of a computation. Threads are started when first needed and kept, because
/// starting a thread for every evaluation costs more than a short evaluation. The program has one pool. Several threads
/// may use it at the same time; their parts are executed by the workers and by the calling threads, and no more than
/// `threads()` threads work at once. The result of a part does not depend on the thread that executes it.
/// @verified_by task_pool_test.cpp
class TaskPool {
 public:
  /// Returns the pool of the program, which has available_processors() threads.
  static TaskPool& shared();

  /// @param threads  largest number of threads that work at once, >= 1
  explicit TaskPool(int threads = available_processors());
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;
  ~TaskPool();

  /// Returns the number of threads that may work at once, including the caller's.
  [[nodiscard]] int threads() const;
  void set_threads(int threads);  ///< `threads` >= 1; must not be called during run()

  /// Calls part(0) to part(count - 1) in any order and concurrently; returns when all have returned.
  /// @throws the exception of the first part that threw one; the others are done first.
  void run(std::size_t count, const std::function<void(std::size_t)>& part);

  /// Counts a thread that works independently, such as a run of a study, among `threads()` as long as the object
  /// exists.
  class OwnThread {
   public:
    /// Must be constructed in the thread that works.
    explicit OwnThread(TaskPool& pool);
    OwnThread(const OwnThread&) = delete;
    OwnThread& operator=(const OwnThread&) = delete;
    ~OwnThread();

   private:
    TaskPool& pool_;
  };

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey
