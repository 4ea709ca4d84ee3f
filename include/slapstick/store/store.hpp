#pragma once
/// A store: the cells of a long run in an SQLite database, each a row that is there for good once its tile is finished.
///
///     Store store = Store::to_write("chart.db", facts, resume);  // refuses a store of another run
///     store.add(cells);                                          // one transaction
///
/// Any death of the program loses what was not added yet and nothing else (write-ahead log; a transaction is whole or
/// absent). A row has a checksum, so that bytes that changed on the disk are noticed where they are read. One program
/// writes at a time; others may read meanwhile. Not for network file systems. SQLite lives in store.cpp and nowhere
/// else.
/// Threads: one at a time. Cost: about 3 us a cell. Source: sqlite.org/wal.html.
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace slapstick::store {

struct StoredCell {
  std::int64_t number = 0;
  std::vector<double> numbers;  ///< what was found; what they mean is the verb's matter
  std::string failure;          ///< why nothing was found; else empty
  std::vector<double> carried;  ///< the start that is handed to the next cell
  friend bool operator==(const StoredCell&, const StoredCell&) = default;
};

/// What all cells have in common, by name, in order: verb, version, kernel, model, options, number of cells.
using StoreFacts = std::vector<std::pair<std::string, std::string>>;

class Store {
 public:
  /// A new store, or with `resume` also one that is there.
  /// @throws InputError if it is there without `resume`, or its facts are others (naming the first that differs);
  /// StorageError if it cannot be written, is damaged, or another program writes it
  [[nodiscard]] static Store to_write(const std::string& path, const StoreFacts& facts, bool resume);
  /// @throws StorageError if it is no store, or is damaged
  [[nodiscard]] static Store to_read(const std::string& path);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  [[nodiscard]] const StoreFacts& facts() const;
  /// @throws StorageError if there is no such fact
  [[nodiscard]] const std::string& fact(const std::string& name) const;
  [[nodiscard]] long count() const;
  /// Cells that are there already must be equal.
  /// @throws StorageError where that fails; then no cell is added
  void add(std::span<const StoredCell> cells);
  [[nodiscard]] std::optional<StoredCell> find(std::int64_t number) const;
  /// In the order of their numbers. @throws StorageError at the first damaged cell, naming its number
  void for_each(const std::function<void(const StoredCell&)>& use) const;
  /// Looks at every page and every cell. @throws StorageError for a damaged one
  void check() const;
  /// Of the facts without the shard, and of the cells. Equal results have equal hashes, in whatever order they came.
  [[nodiscard]] std::string hash() const;

 private:
  struct Database;
  explicit Store(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace slapstick::store
