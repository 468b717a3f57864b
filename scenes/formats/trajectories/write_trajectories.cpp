// The database is made in memory and its image written at once: so SQLite makes no journal beside
// the file, and the file is there as a whole or not at all.
#include "scenes/formats/trajectories/write_trajectories.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <memory>
#include <set>
#include <span>

#include "runtime/core/atomic_file.hpp"

namespace luxodus {

namespace {

struct CloseWritten {
  void operator()(sqlite3* db) const { sqlite3_close(db); }
};
struct FinishInsert {
  void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
struct FreeImage {
  void operator()(unsigned char* image) const { sqlite3_free(image); }
};

constexpr const char* tables =
    "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT "
    "NULL, pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);"
    "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
    "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);";
/// Programs that show a file ask for one frame after another.
constexpr const char* index = "CREATE INDEX frame_id_idx ON trajectory_data(frame, id);";
/// Number of the only geometry.
constexpr int geometry_number = 1;

class Writer {
 public:
  explicit Writer(const WrittenTrajectories& trajectories) : trajectories_(trajectories) {}

  Result<std::vector<std::byte>> write() {
    sqlite3* db = nullptr;
    const int opened = sqlite3_open(":memory:", &db);
    db_.reset(db);
    if (opened != SQLITE_OK) return failed();
    const bool done = run(tables) && run("BEGIN") && metadata() && geometry() && places() &&
                      frames() && run(index) && run("COMMIT");
    if (!done) return failed();
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, FreeImage> image(
        sqlite3_serialize(db_.get(), "main", &size, 0));
    if (!image) return failed();
    const auto* bytes = reinterpret_cast<const std::byte*>(image.get());
    return std::vector<std::byte>(bytes, bytes + size);
  }

 private:
  Problem failed() const {
    return problem(
        fmt::format("trajectories cannot be made by SQLite: {}", sqlite3_errmsg(db_.get())),
        ProblemKind::system);
  }
  bool run(const char* sql) {
    return sqlite3_exec(db_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK;
  }

  /// Inserts one row for each of `rows`; `bind` sets its values.
  template <class Rows, class Bind>
  bool insert(const char* sql, const Rows& rows, Bind&& bind) {
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(db_.get(), sql, -1, &prepared, nullptr) != SQLITE_OK) return false;
    const std::unique_ptr<sqlite3_stmt, FinishInsert> statement(prepared);
    for (const auto& row : rows) {
      bind(prepared, row);
      if (sqlite3_step(prepared) != SQLITE_DONE || sqlite3_reset(prepared) != SQLITE_OK)
        return false;
    }
    return true;
  }

  bool metadata() {
    const WrittenTrajectories& t = trajectories_;
    std::vector<std::pair<std::string, std::string>> rows{{"version", "2"},
                                                          {"fps", fmt::format("{}", t.fps)},
                                                          {"xmin", fmt::format("{}", t.low.x)},
                                                          {"xmax", fmt::format("{}", t.high.x)},
                                                          {"ymin", fmt::format("{}", t.low.y)},
                                                          {"ymax", fmt::format("{}", t.high.y)}};
    rows.insert(rows.end(), t.metadata.begin(), t.metadata.end());
    return insert("INSERT INTO metadata VALUES(?1, ?2)", rows,
                  [](sqlite3_stmt* s, const auto& row) {
                    bind_text(s, 1, row.first);
                    bind_text(s, 2, row.second);
                  });
  }

  bool geometry() {
    const glm::dvec2 &a = trajectories_.low, &b = trajectories_.high;
    const std::vector<std::string> wkt{fmt::format("POLYGON (({} {}, {} {}, {} {}, {} {}, {} {}))",
                                                   a.x, a.y, b.x, a.y, b.x, b.y, a.x, b.y, a.x,
                                                   a.y)};
    return insert("INSERT INTO geometry VALUES(?1, ?2)", wkt,
                  [](sqlite3_stmt* s, const std::string& text) {
                    sqlite3_bind_int(s, 1, geometry_number);
                    bind_text(s, 2, text);
                  });
  }

  bool places() {
    return insert("INSERT INTO trajectory_data VALUES(?1, ?2, ?3, ?4, ?5, ?6)",
                  trajectories_.places, [](sqlite3_stmt* s, const WrittenPlace& row) {
                    sqlite3_bind_int64(s, 1, row.frame);
                    sqlite3_bind_int64(s, 2, row.id);
                    sqlite3_bind_double(s, 3, row.place.x);
                    sqlite3_bind_double(s, 4, row.place.y);
                    sqlite3_bind_double(s, 5, row.facing.x);
                    sqlite3_bind_double(s, 6, row.facing.y);
                  });
  }

  bool frames() {
    std::set<int64_t> frames;
    for (const WrittenPlace& row : trajectories_.places) frames.insert(row.frame);
    return insert("INSERT INTO frame_data VALUES(?1, ?2)", frames,
                  [](sqlite3_stmt* s, int64_t frame) {
                    sqlite3_bind_int64(s, 1, frame);
                    sqlite3_bind_int(s, 2, geometry_number);
                  });
  }

  static void bind_text(sqlite3_stmt* s, int at, const std::string& text) {
    sqlite3_bind_text(s, at, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }

  const WrittenTrajectories& trajectories_;
  std::unique_ptr<sqlite3, CloseWritten> db_;
};

}  // namespace

Result<std::vector<std::byte>> jupedsim_bytes(const WrittenTrajectories& trajectories) {
  if (trajectories.places.size() > limits::written_rows)
    return problem(fmt::format("{} rows of people are too many: at most {} are written",
                               trajectories.places.size(), limits::written_rows));
  return Writer(trajectories).write();
}

Result<void> write_trajectories(const std::filesystem::path& file,
                                const WrittenTrajectories& trajectories) {
  const auto bytes = jupedsim_bytes(trajectories);
  if (!bytes) return bytes.problem();
  return write_file_atomically(file, std::span(bytes.value()));
}

}  // namespace luxodus
