/// Keeps cells in an SQLite database.
#include "slapstick/store/store.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "store/checksum.hpp"

namespace slapstick::store {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

namespace {

constexpr int application = 0x534c4150;  // "SLAP": what `file` shows
constexpr const char* schema =
    "CREATE TABLE facts(place INTEGER PRIMARY KEY, name TEXT NOT NULL, value TEXT NOT NULL, checksum INTEGER NOT NULL);"
    "CREATE TABLE cells(number INTEGER PRIMARY KEY, numbers BLOB NOT NULL, failure TEXT NOT NULL, carried BLOB NOT "
    "NULL, "
    "checksum INTEGER NOT NULL);";

std::int64_t checksum_of(const StoredCell& cell) {
  return Checksum().add(cell.number).add(cell.numbers).add(cell.failure).add(cell.carried).sum();
}

std::int64_t checksum_of(std::int64_t place, const std::string& name, const std::string& value) {
  return Checksum().add(place).add(name).add(value).sum();
}

/// The lock of the one writer: it ends with the process, whatever ends that. The file is not SQLite's own handle, and
/// flock() knows nothing of the locks that SQLite takes.
class WriterLock {
 public:
  WriterLock() = default;
  explicit WriterLock(const std::string& path) : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0)
      throw StorageError("cannot write " + in_quotes(path) + ": " + std::generic_category().message(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    ::close(std::exchange(descriptor_, -1));
    throw StorageError("cannot write " + in_quotes(path) + ": " +
                       (error == EWOULDBLOCK ? "another run writes it" : std::generic_category().message(error)));
  }
  ~WriterLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  WriterLock(WriterLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  WriterLock& operator=(WriterLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

 private:
  int descriptor_ = -1;
};

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
struct EndStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, EndStatement>;

std::vector<double> numbers_at(sqlite3_stmt* statement, int column) {
  const auto bytes = static_cast<std::size_t>(sqlite3_column_bytes(statement, column));
  std::vector<double> numbers(bytes / sizeof(double));
  if (!numbers.empty())
    std::memcpy(numbers.data(), sqlite3_column_blob(statement, column), numbers.size() * sizeof(double));
  return numbers;
}

std::string text_at(sqlite3_stmt* statement, int column) {
  const auto* text = sqlite3_column_text(statement, column);
  return text == nullptr ? ""
                         : std::string(reinterpret_cast<const char*>(text), sqlite3_column_bytes(statement, column));
}

/// Of texts of several lines the first that differs, behind the line before it.
std::string difference(const std::string& name, const std::string& there, const std::string& wanted) {
  const std::vector<std::string> a = split(there, '\n'), b = split(wanted, '\n');
  std::size_t i = 0;
  while (i + 1 < std::min(a.size(), b.size()) && a[i] == b[i]) ++i;
  const std::string after = i > 0 ? " after " + in_quotes(a[i - 1]) : "";
  return "its " + name + " has " + in_quotes(a[i]) + after + ", not " + in_quotes(b[i]);
}

}  // namespace

struct Store::Database {
  std::string path;
  WriterLock lock;
  std::unique_ptr<sqlite3, CloseDatabase> handle;
  Statement insert, one, all;
  StoreFacts facts;

  [[noreturn]] void fail(const char* doing) const {
    throw StorageError(std::string("cannot ") + doing + " " + in_quotes(path) + ": " +
                       in_quotes(sqlite3_errmsg(handle.get())));
  }
  [[noreturn]] void damaged(const std::string& what) const {
    throw StorageError("store " + in_quotes(path) + " is damaged: " + what + "; take it from a copy, or begin it anew");
  }

  void open(int flags) {
    sqlite3* opened = nullptr;
    const int status = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
    handle.reset(opened);
    if (status != SQLITE_OK) fail("open");
    sqlite3_busy_timeout(handle.get(), 10'000);  // a reader may hold a writer up for a moment
  }

  void run(const char* sql, const char* doing = "write") const {
    if (sqlite3_exec(handle.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(doing);
  }

  [[nodiscard]] Statement prepare(const char* sql, const char* doing = "read") const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(handle.get(), sql, -1, &statement, nullptr) != SQLITE_OK) fail(doing);
    return Statement(statement);
  }

  /// The next row. @returns false after the last row
  [[nodiscard]] bool step(sqlite3_stmt* statement) const {
    const int status = sqlite3_step(statement);
    if (status != SQLITE_ROW && status != SQLITE_DONE) {
      sqlite3_reset(statement);
      if (status == SQLITE_CORRUPT || status == SQLITE_NOTADB) damaged(in_quotes(sqlite3_errmsg(handle.get())));
      fail("read");
    }
    return status == SQLITE_ROW;
  }

  [[nodiscard]] long number_of(const char* sql) const {
    const Statement statement = prepare(sql);
    return step(statement.get()) ? static_cast<long>(sqlite3_column_int64(statement.get(), 0)) : 0;
  }

  [[nodiscard]] bool is_empty() const { return number_of("SELECT count(*) FROM sqlite_master") == 0; }

  void begin(const StoreFacts& of) const {
    run("PRAGMA journal_mode = WAL");
    run("BEGIN IMMEDIATE");
    run(schema);
    run(("PRAGMA application_id = " + std::to_string(application)).c_str());
    const Statement statement = prepare("INSERT INTO facts VALUES(?, ?, ?, ?)");
    for (std::size_t i = 0; i < of.size(); ++i) {
      const auto& [name, value] = of[i];
      const auto place = static_cast<std::int64_t>(i);
      sqlite3_bind_int64(statement.get(), 1, place);
      sqlite3_bind_text(statement.get(), 2, name.data(), static_cast<int>(name.size()), SQLITE_STATIC);
      sqlite3_bind_text(statement.get(), 3, value.data(), static_cast<int>(value.size()), SQLITE_STATIC);
      sqlite3_bind_int64(statement.get(), 4, checksum_of(place, name, value));
      if (sqlite3_step(statement.get()) != SQLITE_DONE) fail("write");
      sqlite3_reset(statement.get());
    }
    run("COMMIT");
  }

  void read_facts() {
    if (number_of("PRAGMA application_id") != application)
      throw StorageError(in_quotes(path) + " is no store of slapstick");
    const Statement statement = prepare("SELECT place, name, value, checksum FROM facts ORDER BY place");
    while (step(statement.get())) {
      facts.emplace_back(text_at(statement.get(), 1), text_at(statement.get(), 2));
      const auto place = sqlite3_column_int64(statement.get(), 0);
      if (sqlite3_column_int64(statement.get(), 3) != checksum_of(place, facts.back().first, facts.back().second))
        damaged("what it says of itself, " + in_quotes(facts.back().first));
    }
    one = prepare("SELECT number, numbers, failure, carried, checksum FROM cells WHERE number = ?");
    all = prepare("SELECT number, numbers, failure, carried, checksum FROM cells ORDER BY number");
  }

  /// Each page is where SQLite's tree says: a page that was written to the place of another has good cells, twice, and
  /// others are gone.
  void check_pages() const {
    const Statement statement = prepare("PRAGMA integrity_check(1)");
    if (step(statement.get()) && text_at(statement.get(), 0) != "ok") damaged(in_quotes(text_at(statement.get(), 0)));
  }

  void demand(const StoreFacts& wanted) const {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (i < facts.size() && facts[i] == wanted[i]) continue;
      const std::string there = i < facts.size() && facts[i].first == wanted[i].first ? facts[i].second : "";
      throw InputError("store: " + in_quotes(path) +
                       " is of another run: " + difference(wanted[i].first, there, wanted[i].second) +
                       "; give the store of this run, or another name");
    }
  }

  [[nodiscard]] StoredCell cell_at(sqlite3_stmt* row) const {
    StoredCell cell{sqlite3_column_int64(row, 0), numbers_at(row, 1), text_at(row, 2), numbers_at(row, 3)};
    if (checksum_of(cell) != sqlite3_column_int64(row, 4)) damaged("cell " + std::to_string(cell.number));
    return cell;
  }

  [[nodiscard]] std::optional<StoredCell> find(std::int64_t number) const {
    sqlite3_bind_int64(one.get(), 1, number);
    std::optional<StoredCell> cell;
    if (step(one.get())) cell = cell_at(one.get());
    sqlite3_reset(one.get());
    return cell;
  }

  void put(const StoredCell& cell) const {
    const auto bind = [&](int place, const std::vector<double>& numbers) {
      sqlite3_bind_blob(insert.get(), place, numbers.empty() ? "" : static_cast<const void*>(numbers.data()),
                        static_cast<int>(numbers.size() * sizeof(double)), SQLITE_STATIC);
    };
    sqlite3_bind_int64(insert.get(), 1, cell.number);
    bind(2, cell.numbers);
    sqlite3_bind_text(insert.get(), 3, cell.failure.data(), static_cast<int>(cell.failure.size()), SQLITE_STATIC);
    bind(4, cell.carried);
    sqlite3_bind_int64(insert.get(), 5, checksum_of(cell));
    const int status = sqlite3_step(insert.get());
    sqlite3_reset(insert.get());
    if (status == SQLITE_DONE) return;
    if (status != SQLITE_CONSTRAINT) fail("write");
    const std::optional<StoredCell> there = find(cell.number);
    if (!there || checksum_of(*there) != checksum_of(cell))
      throw StorageError("cannot write " + in_quotes(path) + ": cell " + std::to_string(cell.number) +
                         " is there already, with other numbers");
  }
};

Store::Store(std::unique_ptr<Database> database) : database_(std::move(database)) {}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

Store Store::to_write(const std::string& path, const StoreFacts& facts, bool resume) {
  std::error_code ignored;
  if (!resume && std::filesystem::exists(path, ignored))
    throw InputError("store: " + in_quotes(path) + " is there already; resume goes on with it");
  auto database = std::make_unique<Database>();
  database->path = path;
  database->lock = WriterLock(path);
  database->open(SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (database->is_empty())
    database->begin(facts);  // new, or of a run that died before it began
  else
    database->check_pages();
  database->run("PRAGMA journal_mode = WAL");
  database->run("PRAGMA synchronous = NORMAL");
  database->read_facts();
  database->demand(facts);
  database->insert = database->prepare("INSERT INTO cells VALUES(?, ?, ?, ?, ?)", "write");
  return Store(std::move(database));
}

Store Store::to_read(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw StorageError("no such store: " + in_quotes(path));
  auto database = std::make_unique<Database>();
  database->path = path;
  database->open(SQLITE_OPEN_READWRITE);  // a log of a run that died is taken in
  database->read_facts();
  database->check_pages();
  return Store(std::move(database));
}

const StoreFacts& Store::facts() const { return database_->facts; }

const std::string& Store::fact(const std::string& name) const {
  for (const auto& [of, value] : database_->facts)
    if (of == name) return value;
  throw StorageError("store " + in_quotes(database_->path) + " does not say its " + name);
}

long Store::count() const { return database_->number_of("SELECT count(*) FROM cells"); }

void Store::add(std::span<const StoredCell> cells) {
  database_->run("BEGIN IMMEDIATE");
  try {
    for (const StoredCell& cell : cells) database_->put(cell);
    database_->run("COMMIT");
  } catch (...) {
    sqlite3_exec(database_->handle.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

std::optional<StoredCell> Store::find(std::int64_t number) const { return database_->find(number); }

void Store::for_each(const std::function<void(const StoredCell&)>& use) const {
  struct Reset {
    void operator()(sqlite3_stmt* statement) const { sqlite3_reset(statement); }
  };
  const std::unique_ptr<sqlite3_stmt, Reset> all(database_->all.get());  // also where `use` throws
  while (database_->step(all.get())) use(database_->cell_at(all.get()));
}

void Store::check() const {
  for_each([](const StoredCell&) {});
}

std::string Store::hash() const {
  Checksum sum;
  for (const auto& [name, value] : database_->facts)
    if (name != "shard") sum.add(name).add(value);
  for_each([&](const StoredCell& cell) { sum.add(checksum_of(cell)); });
  return sum.text();
}

}  // namespace slapstick::store
