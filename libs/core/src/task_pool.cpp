#include "hersey/core/task_pool.h"

#include <sched.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "hersey/core/contract.h"

namespace hersey {

int available_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));  // more processors than the set counts
}

namespace {

/// Parts of one call of run().
struct Batch {
  const std::function<void(std::size_t)>* part = nullptr;
  std::size_t count = 0;
  std::size_t next = 0;  ///< first part that no thread has taken
  std::size_t done = 0;
  std::exception_ptr error;
  std::condition_variable finished;
};

}  // namespace

struct TaskPool::Impl {
  mutable std::mutex mutex;  // protects all members
  std::condition_variable work;
  int threads = 1;
  int own = 0;   // number of threads that work independently
  int busy = 0;  // number of workers that execute a part
  bool ends = false;
  std::deque<Batch*> batches;  // batches with parts that no thread has taken
  std::vector<std::thread> workers;

  /// The caller of run() works as well.
  [[nodiscard]] int helpers() const { return threads - std::max(own, 1); }

  /// Takes a part of `batch` and executes it without the lock.
  void do_part(Batch& batch, std::unique_lock<std::mutex>& lock) {
    const std::size_t i = batch.next++;
    if (batch.next == batch.count) batches.erase(std::find(batches.begin(), batches.end(), &batch));
    lock.unlock();
    std::exception_ptr error;
    try {
      (*batch.part)(i);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (error && !batch.error) batch.error = error;
    if (++batch.done == batch.count) batch.finished.notify_one();
  }

  void serve() {
    std::unique_lock lock(mutex);
    for (;;) {
      work.wait(lock, [this] { return ends || (!batches.empty() && busy < helpers()); });
      if (ends) return;
      ++busy;
      do_part(*batches.front(), lock);
      --busy;
    }
  }

  void run(std::size_t count, const std::function<void(std::size_t)>& part) {
    Batch batch{&part, count, 0, 0, {}, {}};
    std::unique_lock lock(mutex);
    batches.push_back(&batch);
    while (static_cast<int>(workers.size()) < helpers()) workers.emplace_back([this] { serve(); });
    lock.unlock();
    for (std::size_t i = 1; i < count; ++i) work.notify_one();
    lock.lock();
    while (batch.next < batch.count) do_part(batch, lock);  // workers continue with the remaining parts
    batch.finished.wait(lock, [&] { return batch.done == batch.count; });
    if (batch.error) std::rethrow_exception(batch.error);
  }

  void end_workers() {
    {
      const std::scoped_lock lock(mutex);
      ends = true;
    }
    work.notify_all();
    for (std::thread& worker : workers) worker.join();
    workers.clear();
    ends = false;
  }
};

TaskPool& TaskPool::shared() {
  static TaskPool pool;
  return pool;
}

TaskPool::TaskPool(int threads) : impl_(std::make_unique<Impl>()) { set_threads(threads); }

TaskPool::~TaskPool() { impl_->end_workers(); }

int TaskPool::threads() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->threads;
}

void TaskPool::set_threads(int threads) {
  HERSEY_REQUIRE(threads >= 1, "someone has to work");
  impl_->end_workers();
  impl_->threads = threads;
}

void TaskPool::run(std::size_t count, const std::function<void(std::size_t)>& part) {
  const bool alone = [&] {
    const std::scoped_lock lock(impl_->mutex);
    return count < 2 || impl_->helpers() < 1;
  }();
  if (!alone) return impl_->run(count, part);
  std::exception_ptr error;
  for (std::size_t i = 0; i < count; ++i) {
    try {
      part(i);
    } catch (...) {
      if (!error) error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);
}

TaskPool::OwnThread::OwnThread(TaskPool& pool) : pool_(pool) {
  const std::scoped_lock lock(pool_.impl_->mutex);
  ++pool_.impl_->own;
}

TaskPool::OwnThread::~OwnThread() {
  const std::scoped_lock lock(pool_.impl_->mutex);
  --pool_.impl_->own;
}

}  // namespace hersey
