#pragma once
/// A block of doubles at the alignment of lanes, for several arrays at once.
#include <cstddef>
#include <memory>
#include <new>

#include "event/window.hpp"

namespace slapstick::event {

struct LaneDeleter {
  void operator()(double* block) const { ::operator delete(block, LaneAllocator<Lane8>::alignment); }
};
using LaneBlock = std::unique_ptr<double[], LaneDeleter>;

/// Hands out arrays of a block, one after the other, each at the alignment of its lanes.
class LaneBlockBuilder {
 public:
  /// Not zeroed.
  explicit LaneBlockBuilder(std::size_t doubles)
      : block_(static_cast<double*>(::operator new(doubles * sizeof(double), LaneAllocator<Lane8>::alignment))),
        next_(block_.get()) {}

  template <class Lane>
  Lane* take(std::ptrdiff_t lanes) {
    auto* const array = reinterpret_cast<Lane*>(next_);
    next_ += lanes * static_cast<std::ptrdiff_t>(sizeof(Lane) / sizeof(double));
    return array;
  }
  LaneBlock release() { return std::move(block_); }

 private:
  LaneBlock block_;
  double* next_;
};

}  // namespace slapstick::event
