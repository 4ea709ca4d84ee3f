#pragma once
/// Which pixels of a grid must be computed so that the others can be filled in: a coarse grid, and then the halves of
/// every cell that holds pixels of different kinds. Knows no mechanics; a kind is a number.
///
///     Refinement refinement(columns, rows, 16);
///     for (auto wanted = refinement.wanted(); !wanted.empty(); wanted = refinement.wanted())
///       for (const std::int32_t pixel : wanted) refinement.set(pixel, kind_at(pixel));
///     const std::vector<std::int32_t> sources = refinement.sources();
///
/// A cell is a rectangle with its rim; neighbours share the rim. A cell is divided as long as any two computed pixels
/// in it differ, those that a finer neighbour has put on its rim included: so a boundary that is met anywhere is
/// followed to its end.
///
/// Pixels of one kind that hang together by edges are a region. What is certain: a filled pixel is wrong only if the
/// whole region of its kind has no computed pixel, so that it holds no pixel of the coarse grid. For two cells that
/// share a piece of rim share two corners of the smaller one: both are of one kind. A path inside a region that begins
/// at a wrong pixel therefore meets cells of the wrong kind only, and never a computed pixel of its own.
/// And any two neighbouring pixels of different kinds are both computed.
///
/// What is wanted depends on the kinds only. Memory: 4 bytes a pixel and 16 a cell. Cost of a round: the rims of cells.
#include <cstdint>
#include <vector>

namespace slapstick::sweep {

class Refinement {
 public:
  /// @param cell  side of the coarse cells in pixels, >= 2
  Refinement(int columns, int rows, int cell);

  /// The pixels of the next round, ascending; empty when there is nothing left to divide. All of them must be set
  /// before the next call.
  [[nodiscard]] std::vector<std::int32_t> wanted();
  /// @param pixel  iy * columns + ix
  /// @param kind   >= 0
  void set(std::int32_t pixel, std::int32_t kind) { kinds_[static_cast<std::size_t>(pixel)] = kind; }

  /// After the last round, for each pixel a computed one that stands for it: itself, or one in its cell.
  [[nodiscard]] std::vector<std::int32_t> sources() const;

 private:
  struct Interval {
    std::int32_t begin, end;  // both in it
  };
  struct Cell {
    Interval x, y;
  };
  static std::vector<Interval> intervals(int count, int cell);
  static std::vector<Interval> halves(const Interval& whole);
  [[nodiscard]] std::int32_t at(std::int32_t x, std::int32_t y) const { return y * columns_ + x; }
  [[nodiscard]] bool may_be_divided(const Cell& cell) const;
  [[nodiscard]] bool is_mixed(const Cell& cell) const;
  void demand_corners(const Cell& cell, std::vector<std::int32_t>& wanted);

  static constexpr std::int32_t unknown = -1, asked = -2;
  int columns_;
  std::vector<std::int32_t> kinds_;
  std::vector<Cell> cells_;
  bool begun_ = false;
};

}  // namespace slapstick::sweep
