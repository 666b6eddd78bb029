#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hersey::solver {

/// Order in which a sparse matrix of one pattern is eliminated by dense fronts, a front for each group of unknowns: the
/// group with its border, the later unknowns that its elimination couples.
struct Elimination {
  /// A value of the pattern, and where it stands in the block of its front.
  struct Entry {
    int slot = 0;           ///< in the pattern
    std::ptrdiff_t at = 0;  ///< in the block's rows, padded as DenseFront says
  };
  struct Front {
    int own = 0;                        ///< unknowns of the group
    std::vector<int> positions;         ///< in the order of elimination, of the group and then of the border, ascending
    std::vector<Entry> upper, lower;    ///< that no earlier front has, in own rows and in those of the border
    std::vector<int> children;          ///< fronts whose complement goes into this one
    std::vector<int> place_in_parent;   ///< columns of the border's unknowns in the parent's upper block, ascending
    int in_parents_group = 0;           ///< so many of them the parent eliminates
    std::size_t complement = 0;         ///< where the Schur complement on the border waits for the parent
    std::size_t complement_length = 0;  ///< numbers, padded

    [[nodiscard]] int size() const { return static_cast<int>(positions.size()); }
    [[nodiscard]] int outside() const { return size() - own; }
    [[nodiscard]] int first() const { return positions.front(); }
  };
  /// An unknown alone in its row: known before all others.
  struct Known {
    int unknown = 0;
    std::size_t slot = 0;
  };
  /// What a known unknown adds to another row.
  struct FromKnown {
    int row = 0, known = 0;
    std::size_t slot = 0;
  };

  Elimination() = default;
  Elimination(int n, std::span<const int> column_start, std::span<const int> row_index,
              std::span<const std::vector<int>> groups);

  [[nodiscard]] int eliminated() const { return static_cast<int>(unknown_at.size()); }

  int entries = 0;  ///< of the pattern
  std::vector<Front> fronts;
  std::vector<int> unknown_at;  ///< at every position
  std::vector<Known> known;
  std::vector<FromKnown> from_known;
  std::size_t complement_room = 0;  ///< numbers that complements need, those apart whose parents have taken them

 private:
  void find_known(int n, std::span<const int> column_start, std::span<const int> row_index);
  void place_groups(int n, std::span<const std::vector<int>> groups);
  void find_fronts(std::span<const int> column_start, std::span<const int> row_index);
  void adopt(int child);
  void place_entries(std::span<const int> column_start, std::span<const int> row_index);
  void place_complements();

  std::vector<int> position_of_;  ///< of every unknown; -1: known
  std::vector<int> group_of_;     ///< of every position
};

}  // namespace hersey::solver
