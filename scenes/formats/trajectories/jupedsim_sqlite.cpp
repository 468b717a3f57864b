// SQLite of JuPedSim. Version 2 has the tables trajectory_data(frame, id, pos_x, pos_y, ori_x,
// ori_y), metadata(key, value), geometry(hash, wkt) and frame_data(frame, geometry_hash). Version 3
// has no orientations; a file that was converted from version 2 keeps the columns, which count for
// nothing. The unit is the metre, t = frame / fps, and metadata are texts.
//
// The database is untrusted (sqlite.org/security.html): it is opened from memory, read-only, so
// that no journal or other file beside it is touched; schemas may not call functions that act;
// views and triggers do not run; what is read has to be a stored table; sizes and steps are
// limited; and its pages are checked before they are read.
#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <memory>

#include "runtime/core/printable.hpp"
#include "scenes/formats/trajectories/trajectory_rows.hpp"

namespace luxodus {

namespace {

struct CloseDatabase {
  void operator()(sqlite3* db) const { sqlite3_close(db); }
};
struct FinishStatement {
  void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

/// Steps of SQLite's machine between two questions whether it goes on, and how often it may ask. A
/// row takes some 10 steps, and the check of its pages as many.
constexpr int steps_between = 1'000'000, most_questions = 1000;
/// A database in WAL mode has this in its header at bytes 18 and 19.
constexpr char wal_version = 2;
constexpr size_t wal_byte = 18, header_bytes = 100;

int went_on_too_long(void* questions) noexcept {
  return ++*static_cast<int*>(questions) > most_questions ? 1 : 0;
}

/// Largest values of what SQLite limits at run time.
void limit(sqlite3* db) {
  constexpr std::array<std::pair<int, int>, 11> values{
      {{SQLITE_LIMIT_LENGTH, static_cast<int>(limits::trajectory_text_bytes)},
       {SQLITE_LIMIT_SQL_LENGTH, 100'000},
       {SQLITE_LIMIT_COLUMN, 100},
       {SQLITE_LIMIT_EXPR_DEPTH, 10},
       {SQLITE_LIMIT_COMPOUND_SELECT, 3},
       {SQLITE_LIMIT_VDBE_OP, 25'000},
       {SQLITE_LIMIT_FUNCTION_ARG, 8},
       {SQLITE_LIMIT_ATTACHED, 0},
       {SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 50},
       {SQLITE_LIMIT_VARIABLE_NUMBER, 10},
       {SQLITE_LIMIT_TRIGGER_DEPTH, 1}}};
  for (const auto& [what, most] : values) sqlite3_limit(db, what, most);
}

void distrust(sqlite3* db) {
  constexpr std::array<std::pair<int, int>, 6> settings{
      {{SQLITE_DBCONFIG_DEFENSIVE, 1},
       {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
       {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
       {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
       {SQLITE_DBCONFIG_ENABLE_FKEY, 0},
       {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0}}};
  for (const auto& [what, on] : settings) sqlite3_db_config(db, what, on, nullptr);
  sqlite3_exec(db, "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA query_only = ON",
               nullptr, nullptr, nullptr);
}

class SqliteReader {
 public:
  SqliteReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  Result<Trajectories> read() {
    if (auto ok = open(); !ok) return ok.problem();
    if (auto ok = check(); !ok) return ok.problem();
    Trajectories out;
    const auto version = number_of("version");
    if (!version) return version.problem();
    if (version.value() != 2 && version.value() != 3)
      return bad(
          fmt::format("its version is {:g}: versions 2 and 3 are read. JuPedSim converts "
                      "older files (update_database_to_latest_version)",
                      version.value()));
    const auto fps = number_of("fps");
    if (!fps) return fps.problem();
    const auto checked = checked_fps(fps.value(), file_);
    if (!checked) return checked.problem();
    out.fps = checked.value();
    out.form = fmt::format("SQLite of JuPedSim, version {:g}", version.value());
    return rows(std::move(out), version.value() == 2);
  }

 private:
  Problem bad(std::string what) const {
    return problem_in(file_, "SQLite of JuPedSim: " + std::move(what));
  }
  Problem failed(std::string_view what) const {
    return bad(fmt::format("{}: {}", what, excerpt(sqlite3_errmsg(db_.get()), 200)));
  }

  Result<void> open() {
    if (bytes_.size() >= header_bytes &&
        (bytes_[wal_byte] == wal_version || bytes_[wal_byte + 1] == wal_version))
      return bad(
          "it is in WAL mode, whose newest rows are in another file: run \"PRAGMA "
          "journal_mode = DELETE\" on it");
    sqlite3* db = nullptr;
    const int opened = sqlite3_open_v2(
        ":memory:", &db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_MEMORY | SQLITE_OPEN_PRIVATECACHE,
        nullptr);
    db_.reset(db);
    if (opened != SQLITE_OK) return bad("SQLite cannot be opened");
    distrust(db);
    limit(db);
    // SQLite only reads what it is given as read-only.
    auto* image = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes_.data()));
    const auto size = static_cast<sqlite3_int64>(bytes_.size());
    if (sqlite3_deserialize(db, "main", image, size, size, SQLITE_DESERIALIZE_READONLY) !=
        SQLITE_OK)
      return failed("the database cannot be opened");
    sqlite3_progress_handler(db, steps_between, went_on_too_long, &questions_);
    return {};
  }

  Result<Statement> prepare(const char* sql) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v3(db_.get(), sql, -1, SQLITE_PREPARE_NO_VTAB, &statement, nullptr) !=
        SQLITE_OK)
      return failed("the database is no file of JuPedSim, or is damaged");
    return Statement(statement);
  }

  /// Text in the first row of an answer; "" where there is none.
  static std::string text_at(sqlite3_stmt* statement, int column) {
    const auto* text = sqlite3_column_text(statement, column);
    const int size = sqlite3_column_bytes(statement, column);
    return text == nullptr
               ? ""
               : std::string(reinterpret_cast<const char*>(text), static_cast<size_t>(size));
  }

  /// Its pages are sound, and the tables of the form are there.
  Result<void> check() {
    const auto pages = prepare("PRAGMA quick_check(1)");
    if (!pages) return pages.problem();
    if (sqlite3_step(pages->get()) != SQLITE_ROW || text_at(pages->get(), 0) != "ok")
      return bad("the database is damaged");
    for (const char* table : {"metadata", "trajectory_data", "geometry"}) {
      const auto asked = prepare(
          "SELECT count(*) FROM sqlite_schema WHERE name = ?1 AND type = 'table' AND rootpage > 0");
      if (!asked) return asked.problem();
      sqlite3_bind_text(asked->get(), 1, table, -1, SQLITE_STATIC);
      if (sqlite3_step(asked->get()) != SQLITE_ROW) return failed("its tables cannot be listed");
      if (sqlite3_column_int(asked->get(), 0) != 1)
        return bad(fmt::format("there is no table \"{}\" in it", table));
    }
    return {};
  }

  Result<double> number_of(const char* key) {
    const auto asked = prepare("SELECT value FROM metadata WHERE key = ?1");
    if (!asked) return asked.problem();
    sqlite3_bind_text(asked->get(), 1, key, -1, SQLITE_STATIC);
    const int step = sqlite3_step(asked->get());
    if (step == SQLITE_DONE) return bad(fmt::format("its metadata state no \"{}\"", key));
    if (step != SQLITE_ROW) return failed("its metadata cannot be read");
    const std::string text = text_at(asked->get(), 0);
    const auto value = decimal_of(text);
    if (!value)
      return bad(fmt::format("\"{}\" in its metadata is no number: {}", key, excerpt(text)));
    return *value;
  }

  Result<Trajectories> rows(Trajectories out, bool looks) {
    const auto asked = prepare(looks ? "SELECT frame, id, pos_x, pos_y, ori_x, ori_y FROM "
                                       "trajectory_data"
                                     : "SELECT frame, id, pos_x, pos_y FROM trajectory_data");
    if (!asked) return asked.problem();
    sqlite3_stmt* s = asked->get();
    TrajectoryRows rows(file_, TrajectoryRows::Order::any);
    int step = SQLITE_ROW;
    while ((step = sqlite3_step(s)) == SQLITE_ROW) {
      for (int column = 0; column < sqlite3_column_count(s); ++column) {
        const int type = sqlite3_column_type(s, column);
        if (type != SQLITE_INTEGER && (column < 2 || type != SQLITE_FLOAT))
          return bad(fmt::format("\"{}\" in a row of trajectory_data is no {}",
                                 sqlite3_column_name(s, column),
                                 column < 2 ? "whole number" : "number"));
      }
      TrajectoryRow row{.id = sqlite3_column_int64(s, 1),
                        .time_s = static_cast<double>(sqlite3_column_int64(s, 0)) / *out.fps,
                        .place = {sqlite3_column_double(s, 2), sqlite3_column_double(s, 3), 0},
                        .facing = glm::dvec2(0)};
      if (looks) row.facing = {sqlite3_column_double(s, 4), sqlite3_column_double(s, 5)};
      if (auto ok = rows.add(row, 0); !ok) return ok.problem();
    }
    if (step != SQLITE_DONE) return failed("its trajectory_data cannot be read");
    return rows.people_of(std::move(out));
  }

  std::string_view bytes_;
  const std::string& file_;
  int questions_ = 0;
  Database db_;
};

}  // namespace

Result<Trajectories> sqlite_trajectories(std::string_view bytes, const std::string& file) {
  return SqliteReader(bytes, file).read();
}

}  // namespace luxodus
