/// The parallel loop over an index: every index once, errors come through, cancelling ends it.
#include "slapstick/sweep/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

#include "slapstick/base/error.hpp"

namespace slapstick::sweep {
namespace {

TEST(ForEachIndex, EveryIndexOnceOnAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<int> calls(1000, 0);
    EXPECT_TRUE(for_each_index(1000, threads, [&](int i) { ++calls[static_cast<std::size_t>(i)]; }));
    EXPECT_EQ(calls, std::vector<int>(1000, 1)) << threads;
  }
  EXPECT_TRUE(for_each_index(0, 2, [](int) { FAIL(); }));
}

TEST(ForEachIndex, WhatABodyThrowsComesThrough) {
  const auto body = [](int i) {
    if (i == 5) throw std::runtime_error("five");
  };
  EXPECT_THROW(for_each_index(100, 2, body), std::runtime_error);
  EXPECT_THROW(for_each_index(-1, 2, body), InputError);
  EXPECT_THROW(for_each_index(1, -2, body), InputError);
}

TEST(ForEachIndex, CancelledItBeginsNoMore) {
  std::atomic<bool> cancel = false;
  std::atomic<int> calls = 0;
  const auto body = [&](int) {
    const int call = ++calls;
    if (call == 3) cancel = true;
    while (call > 3 && !cancel) std::this_thread::yield();  // until the third has told it
  };
  EXPECT_FALSE(for_each_index(1000, 2, body, &cancel));
  EXPECT_LE(calls.load(), 4);
}

TEST(ForEachIndex, ABodyMayLoopItself) {
  std::atomic<int> calls = 0;
  EXPECT_TRUE(for_each_index(4, 2, [&](int) { for_each_index(10, 2, [&](int) { ++calls; }); }));
  EXPECT_EQ(calls.load(), 40);
}

}  // namespace
}  // namespace slapstick::sweep
