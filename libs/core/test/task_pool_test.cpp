#include "hersey/core/task_pool.h"

#include <doctest/doctest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace hersey {
namespace task_pool_test {

TEST_CASE("TaskPool_EveryPartIsDoneOnce_WithAnyNumberOfThreads") {
  for (const int threads : {1, 2, 5}) {
    TaskPool pool(threads);
    for (const std::size_t count : {0u, 1u, 2u, 7u, 100u}) {
      std::vector<int> done(count, 0);
      pool.run(count, [&](std::size_t i) { ++done[i]; });
      for (const int times : done) CHECK(times == 1);
    }
  }
}

TEST_CASE("TaskPool_KeepsItsThreads") {
  TaskPool pool(3);
  std::mutex mutex;
  std::set<std::thread::id> visited;
  for (int round = 0; round < 50; ++round) {
    pool.run(8, [&](std::size_t) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      const std::scoped_lock lock(mutex);
      visited.insert(std::this_thread::get_id());
    });
  }
  CHECK(visited.size() <= 3);
  CHECK(visited.size() >= 2);
}

TEST_CASE("TaskPool_NeverMoreThreadsAtWorkThanItMayHave") {
  TaskPool pool(2);
  std::atomic<int> now = 0, most = 0;
  pool.run(20, [&](std::size_t) {
    const int n = ++now;
    for (int largest = most; largest < n && !most.compare_exchange_weak(largest, n);) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    --now;
  });
  CHECK(most <= 2);
}

TEST_CASE("TaskPool_ThreadsOfTheirOwnLeaveFewerHelpers") {
  TaskPool pool(2);
  const TaskPool::OwnThread first(pool), second(pool);
  std::set<std::thread::id> visited;
  pool.run(8, [&](std::size_t) { visited.insert(std::this_thread::get_id()); });
  CHECK(visited == std::set{std::this_thread::get_id()});
}

TEST_CASE("TaskPool_SeveralCallersAtOnce") {
  TaskPool pool(3);
  std::atomic<int> done = 0;
  std::vector<std::thread> callers;
  callers.reserve(4);
  for (int c = 0; c < 4; ++c)
    callers.emplace_back([&] {
      for (int round = 0; round < 20; ++round) pool.run(5, [&](std::size_t) { ++done; });
    });
  for (std::thread& caller : callers) caller.join();
  CHECK(done == 4 * 20 * 5);
}

TEST_CASE("TaskPool_AnExceptionReachesTheCaller_AfterAllParts") {
  TaskPool pool(2);
  std::atomic<int> done = 0;
  const auto part = [&](std::size_t i) {
    ++done;
    if (i == 3) throw std::runtime_error("the fourth");
  };
  CHECK_THROWS_WITH(pool.run(10, part), "the fourth");
  CHECK(done == 10);
  CHECK_NOTHROW(pool.run(3, [](std::size_t) {}));
}

TEST_CASE("AvailableProcessors_FollowTheAffinity") {
  cpu_set_t before;
  REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
  CHECK(available_processors() == 1);
  REQUIRE(sched_setaffinity(0, sizeof before, &before) == 0);
  CHECK(available_processors() == CPU_COUNT(&before));
}

}  // namespace task_pool_test
}  // namespace hersey
