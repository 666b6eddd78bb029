#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace hersey {

/// Processors this program may run on (its affinity mask), at least 1.
[[nodiscard]] int available_processors();

/// The program's threads for parts of a computation that do not depend on each other. They are started when first
/// needed and kept: a thread that is started for every evaluation costs more than many evaluations take.
///
/// There is one for the whole program. Several threads may use it at the same time; what they hand out is done by the
/// workers and by themselves, with never more threads at work than `threads()`. In which thread a part is done does not
/// show in its result.
/// @verified_by task_pool_test.cpp
class TaskPool {
 public:
  /// The one of the whole program, made with available_processors() threads.
  static TaskPool& shared();

  /// At most `threads` are at work at once, >= 1.
  explicit TaskPool(int threads = available_processors());
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;
  ~TaskPool();

  /// How many threads may work at once, the caller's included.
  [[nodiscard]] int threads() const;
  void set_threads(int threads);  ///< >= 1; between uses

  /// Calls part(0) to part(count - 1), in any order and several at once, and returns when all have returned.
  /// @throws the exception of the first part that threw one; the others are done first.
  void run(std::size_t count, const std::function<void(std::size_t)>& part);

  /// Counts a thread that works by itself, such as one of a study's runs, among `threads()` while it lives.
  class OwnThread {
   public:
    /// Counts from here to the end of its life; made in the thread that works.
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
