/// Chains of cells: each begins where the one before handed on, whatever the threads do; nothing is run twice or lost.
#include "sweep/executor.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "slapstick/base/error.hpp"

namespace slapstick::sweep {
namespace {

/// A number that only the right order of a chain gives.
double next_of(double before, const Cell& cell) { return 1.5 * before + cell.step + 10.0 * cell.chain; }

std::vector<double> run_all(const Chains& chains, int threads) {
  std::vector<double> found(static_cast<std::size_t>(chains.chains * chains.length));
  EXPECT_TRUE(run_chains(chains, threads, [&](const Cell& cell, const Starts& start, const HandOn& hand_on) {
    const double value = next_of(start.empty() ? 1.0 : start.front().state.front(), cell);
    hand_on({{{value}, 0.0}});
    found[static_cast<std::size_t>(cell.chain * chains.length + cell.step)] = value;
  }));
  return found;
}

TEST(Executor, EachCellBeginsWhereTheOneBeforeHandedOnForAnyNumberOfThreads) {
  for (const Chains chains : {Chains{1, 50}, Chains{7, 13}, Chains{40, 1}}) {
    std::vector<double> expected;
    for (int chain = 0; chain < chains.chains; ++chain) {
      double value = 1.0;
      for (int step = 0; step < chains.length; ++step) expected.push_back(value = next_of(value, {chain, step}));
    }
    for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(run_all(chains, threads), expected) << threads << " threads";
  }
}

TEST(Executor, CellThatHandsNothingOnPassesItsOwnStart) {
  std::vector<std::size_t> sizes;
  EXPECT_TRUE(run_chains({1, 4}, 1, [&](const Cell& cell, const Starts& start, const HandOn& hand_on) {
    sizes.push_back(start.size());
    if (cell.step == 1) hand_on(Starts(3));
  }));
  EXPECT_EQ(sizes, (std::vector<std::size_t>{0, 0, 3, 3}));
}

constexpr std::chrono::minutes hangs{10};  ///< a guard: no test says with it how fast a run is

/// The first cell does not end before the second has begun.
TEST(Executor, NextCellBeginsAsSoonAsItIsHandedOn) {
  std::mutex mutex;
  std::condition_variable changed;
  bool begun = false, seen = false;
  EXPECT_TRUE(run_chains({1, 2}, 2, [&](const Cell& cell, const Starts&, const HandOn& hand_on) {
    std::unique_lock lock(mutex);
    if (cell.step == 1) {
      begun = true;
      changed.notify_all();
      return;
    }
    hand_on({});
    seen = changed.wait_for(lock, hangs, [&] { return begun; });
  }));
  EXPECT_TRUE(seen);
}

TEST(Executor, HandingOnTwiceRunsNoCellTwice) {
  std::atomic<int> calls{0};
  EXPECT_TRUE(run_chains({3, 5}, 2, [&](const Cell&, const Starts&, const HandOn& hand_on) {
    ++calls;
    hand_on({});
    hand_on({});
  }));
  EXPECT_EQ(calls, 15);
}

TEST(Executor, FailureEndsTheRunAndComesThrough) {
  std::atomic<int> calls{0};
  const auto body = [&](const Cell& cell, const Starts&, const HandOn&) {
    ++calls;
    if (cell.step == 2) throw NumericalError("here");
  };
  for (const int threads : {1, 4}) EXPECT_THROW(run_chains({4, 1000}, threads, body), NumericalError);
  EXPECT_LT(calls, 200);
}

TEST(Executor, CancelledRunBeginsNoFurtherCellAndSaysSo) {
  std::atomic<bool> cancel{false};
  std::atomic<int> calls{0};
  EXPECT_FALSE(run_chains(
      {2, 1000}, 2,
      [&](const Cell&, const Starts&, const HandOn&) {
        const int call = ++calls;
        if (call == 10) cancel = true;
        while (call > 10 && !cancel) std::this_thread::yield();  // until the tenth has told it
      },
      &cancel));
  EXPECT_LE(calls, 11);
  EXPECT_FALSE(run_chains(
      {2, 2}, 1, [&](const Cell&, const Starts&, const HandOn&) { ADD_FAILURE(); }, &cancel));
}

TEST(Executor, RefusesNegativeNumbers) {
  const Body nothing = [](const Cell&, const Starts&, const HandOn&) {};
  EXPECT_THROW(run_chains({-1, 1}, 1, nothing), InputError);
  EXPECT_THROW(run_chains({1, 0}, 1, nothing), InputError);
  EXPECT_THROW(run_chains({1, 1}, -1, nothing), InputError);
  EXPECT_TRUE(run_chains({0, 1}, 1, nothing));
}

}  // namespace
}  // namespace slapstick::sweep
