// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <array>

#include "core/error.hpp"
#include "core/observables/result.hpp"

namespace tunica::sweep {

namespace {

/// Tells tables of sweeps from other databases (PRAGMA application_id): "TunS".
constexpr int application = 0x54756e53;
constexpr std::array fixed_columns{"point", "status", "reason", "tier", "seconds[s]"};

/// Between double quotes, those inside doubled, as both SQL and CSV want it.
std::string quoted(const std::string& name) {
  std::string text(1, '"');
  for (const char letter : name) text.append(letter == '"' ? 2 : 1, letter);
  text += '"';
  return text;
}

std::string key_head(const Varied& key) {
  return key.unit.empty() ? key.key : key.key + '[' + key.unit + ']';
}

/// A cell of CSV text (RFC 4180).
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  return quoted(text);
}

}  // namespace

/// A connection, and the statement that inserts.
struct Table::Database {
  Database(const std::filesystem::path& file, bool may_create) : path(file) {
    const int code = sqlite3_open_v2(
        file.c_str(), &handle,
        SQLITE_OPEN_READWRITE | SQLITE_OPEN_FULLMUTEX | (may_create ? SQLITE_OPEN_CREATE : 0), nullptr);
    if (code != SQLITE_OK) fail(code);
    // A reader that copies the table holds it for a moment.
    constexpr int patience = 10'000;  // ms
    check(sqlite3_busy_timeout(handle, patience));
  }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database() {
    sqlite3_finalize(insertion);
    sqlite3_close_v2(handle);
  }

  [[noreturn]] void fail(int code) const {
    const std::string why = handle ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
    switch (code & 0xff) {
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        throw InvalidInput(
            fmt::format("{}: another program keeps the table locked; wait for it, or take another "
                        "folder with --out",
                        path.string()));
      case SQLITE_NOTADB:
      case SQLITE_CORRUPT:
        throw InvalidInput(fmt::format(
            "{}: not the table of a sweep, or damaged ({}); begin anew with --replace", path.string(), why));
      default:
        throw OutputFailure(
            fmt::format("{}: {}; rows before are kept: make room or mend the folder, and go on with --resume",
                        path.string(), why));
    }
  }
  void check(int code) const {
    if (code != SQLITE_OK) fail(code);
  }
  void run(const std::string& sql) const {
    check(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr));
  }

  std::filesystem::path path;
  sqlite3* handle = nullptr;
  sqlite3_stmt* insertion = nullptr;
};

namespace {

/// A statement that is stepped through.
class Query {
 public:
  Query(sqlite3* database, const std::string& sql, const std::function<void(int)>& fail) : fail_(fail) {
    if (const int code = sqlite3_prepare_v2(database, sql.c_str(), -1, &statement_, nullptr);
        code != SQLITE_OK)
      fail_(code);
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;
  ~Query() { sqlite3_finalize(statement_); }

  bool next() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) fail_(code);
    return code == SQLITE_ROW;
  }
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  bool is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
  double number(int column) const {
    return is_null(column) ? observables::none : sqlite3_column_double(statement_, column);
  }
  std::string text(int column) const {
    const unsigned char* found = sqlite3_column_text(statement_, column);
    return found ? std::string(reinterpret_cast<const char*>(found),
                               static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)))
                 : std::string();
  }

 private:
  const std::function<void(int)> fail_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace

Table::Table(const std::filesystem::path& file, Mode mode, std::vector<Varied> keys,
             std::vector<NumberColumn> numbers)
    : keys_(std::move(keys)), numbers_(std::move(numbers)) {
  constexpr std::size_t most_columns = 2000;  // SQLite's, as it comes
  if (fixed_columns.size() + keys_.size() + numbers_.size() > most_columns)
    throw InvalidInput(fmt::format(
        "a table of {} columns; at most {} are possible: ask for fewer quantities with --quantity",
        fixed_columns.size() + keys_.size() + numbers_.size(), most_columns));
  database_ = std::make_unique<Database>(file, mode != Mode::read);
  const auto fail = [this](int code) { database_->fail(code); };
  if (mode != Mode::create) {
    Query content(database_->handle, "SELECT count(*) FROM sqlite_master", fail);
    const bool is_empty = content.next() && content.integer(0) == 0;
    Query id(database_->handle, "PRAGMA application_id", fail);
    if (is_empty && mode == Mode::open)
      mode = Mode::create;
    else if (!id.next() || id.integer(0) != application)
      throw InvalidInput(fmt::format("{}: not the table of a sweep", file.string()));
  }
  // Rows reach the system when they are inserted, which a killed process has no part in any more; the disk
  // is waited for when the log is folded in, so that a crash of the machine costs the latest rows only.
  database_->run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;");
  std::vector<std::string> columns{"point INTEGER PRIMARY KEY", "status TEXT NOT NULL",
                                   "reason TEXT NOT NULL", "tier TEXT NOT NULL",
                                   "\"seconds[s]\" REAL NOT NULL"};
  std::vector<std::string> marks(fixed_columns.size() + keys_.size() + numbers_.size(), "?");
  for (const Varied& key : keys_)
    columns.push_back(quoted(key_head(key)) + (key.unit.empty() ? " TEXT NOT NULL" : " REAL"));
  for (const NumberColumn& column : numbers_) columns.push_back(quoted(column.head()) + " REAL");
  if (mode == Mode::create)
    database_->run(fmt::format("BEGIN; PRAGMA application_id = {}; CREATE TABLE sweep ({}); COMMIT;",
                               application, fmt::join(columns, ", ")));
  const std::string insertion = fmt::format("INSERT INTO sweep VALUES ({})", fmt::join(marks, ", "));
  if (sqlite3_prepare_v2(database_->handle, insertion.c_str(), -1, &database_->insertion, nullptr) !=
      SQLITE_OK)
    throw InvalidInput(fmt::format("{}: has other columns than this sweep ({})", file.string(),
                                   sqlite3_errmsg(database_->handle)));
}

Table::~Table() = default;

void Table::insert(const Row& row) {
  sqlite3_stmt* statement = database_->insertion;
  int column = 0;
  const auto bind_text = [&](const std::string& text) {
    database_->check(
        sqlite3_bind_text(statement, ++column, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  };
  database_->check(sqlite3_bind_int64(statement, ++column, static_cast<std::int64_t>(row.point)));
  bind_text(row.status);
  bind_text(row.reason);
  bind_text(row.tier);
  database_->check(sqlite3_bind_double(statement, ++column, row.seconds));
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    if (keys_[k].unit.empty())
      bind_text(row.keys[k]);
    else if (row.keys[k].empty())
      database_->check(sqlite3_bind_null(statement, ++column));
    else
      database_->check(sqlite3_bind_double(statement, ++column, std::stod(row.keys[k])));
  }
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    // SQLite has no NaN: it is NULL there, as it is an empty cell in CSV.
    const double value = k < row.numbers.size() ? row.numbers[k] : observables::none;
    database_->check(sqlite3_bind_double(statement, ++column, value));
  }
  const int code = sqlite3_step(statement);
  const int reset = sqlite3_reset(statement);
  if (code != SQLITE_DONE) database_->fail(code);
  database_->check(reset);
}

std::vector<std::uint64_t> Table::points() const {
  Query query(database_->handle, "SELECT point FROM sweep ORDER BY point",
              [this](int code) { database_->fail(code); });
  std::vector<std::uint64_t> all;
  while (query.next()) all.push_back(static_cast<std::uint64_t>(query.integer(0)));
  return all;
}

std::uint64_t Table::count(const std::string& status) const {
  // The three statuses are the program's own words.
  Query query(database_->handle, fmt::format("SELECT count(*) FROM sweep WHERE status = '{}'", status),
              [this](int code) { database_->fail(code); });
  query.next();
  return static_cast<std::uint64_t>(query.integer(0));
}

double Table::seconds() const {
  Query query(database_->handle, "SELECT total(\"seconds[s]\") FROM sweep",
              [this](int code) { database_->fail(code); });
  query.next();
  return query.number(0);
}

void Table::each(const std::function<void(const Row&)>& use, std::size_t numbers) const {
  // The row is read as far as its last column that is asked for.
  std::string columns;
  for (const char* column : fixed_columns) columns += quoted(column) + ',';
  for (const Varied& key : keys_) columns += quoted(key_head(key)) + ',';
  for (std::size_t k = 0; k < numbers; ++k) columns += quoted(numbers_[k].head()) + ',';
  columns.pop_back();
  Query query(database_->handle, fmt::format("SELECT {} FROM sweep ORDER BY point", columns),
              [this](int code) { database_->fail(code); });
  Row row;
  while (query.next()) {
    int column = 0;
    row.point = static_cast<std::uint64_t>(query.integer(column++));
    row.status = query.text(column++);
    row.reason = query.text(column++);
    row.tier = query.text(column++);
    row.seconds = query.number(column++);
    row.keys.clear();
    for (const Varied& key : keys_) {
      const bool is_text = key.unit.empty() || query.is_null(column);
      row.keys.push_back(is_text ? query.text(column) : value_text(query.number(column)));
      ++column;
    }
    row.numbers.clear();
    for (std::size_t k = 0; k < numbers; ++k) row.numbers.push_back(query.number(column++));
    use(row);
  }
}

void Table::take(const Table& other) {
  database_->run("BEGIN");
  other.each([this](const Row& row) { insert(row); });
  database_->run("COMMIT");
}

void write_csv(const Table& table, const std::filesystem::path& file, bool timings) {
  write_whole(file, [&](const Sink& sink) {
    std::string line;
    line = fmt::format("{}", fmt::join(fixed_columns, ","));
    for (const Varied& key : table.keys()) line += ',' + cell(key_head(key));
    for (const NumberColumn& column : table.numbers()) line += ',' + cell(column.head());
    sink(line + '\n');
    table.each([&](const Row& row) {
      line = fmt::format("{},{},{},{},{}", row.point, row.status, cell(row.reason), row.tier,
                         timings ? value_text(row.seconds) : "");
      for (const std::string& key : row.keys) line += ',' + cell(key);
      for (const double number : row.numbers)
        line += observables::is_none(number) ? "," : ',' + value_text(number);
      sink(line + '\n');
    });
  });
}

}  // namespace tunica::sweep
