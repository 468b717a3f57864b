// Written trajectories are read back as they were, by the reader and by SQLite.
#include "scenes/formats/trajectories/write_trajectories.hpp"

#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "scenes/formats/trajectories/trajectories.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

WrittenTrajectories two_people() {
  WrittenTrajectories out;
  out.fps = 10;
  out.low = {-1, 0.5};
  out.high = {9, 4};
  out.metadata = {{"seed", "7"}, {"scene", "hall's \"floor\".toml"}};
  out.places = {{-1, 1, {1.0 / 3, 2}, {0.6, 0.8}},
                {0, 1, {0.4, 2.1}, {0.6, 0.8}},
                {0, 2, {5, 3}, {0, 0}},
                {1, 2, {5.1, 3}, {1, 0}}};
  return out;
}

/// The answer to a question that has one.
std::string asked(const std::filesystem::path& file, const char* sql) {
  sqlite3* db = nullptr;
  REQUIRE(sqlite3_open_v2(file.c_str(), &db, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK);
  sqlite3_stmt* s = nullptr;
  REQUIRE(sqlite3_prepare_v2(db, sql, -1, &s, nullptr) == SQLITE_OK);
  REQUIRE(sqlite3_step(s) == SQLITE_ROW);
  const std::string out = reinterpret_cast<const char*>(sqlite3_column_text(s, 0));
  sqlite3_finalize(s);
  sqlite3_close(db);
  return out;
}

}  // namespace

TEST_CASE("written trajectories are read back bit for bit", "[trajectories]") {
  const TemporaryFolder folder;
  REQUIRE(write_trajectories(folder / "people.sqlite", two_people()).ok());
  const auto read = read_trajectories(folder / "people.sqlite");
  if (!read) FAIL(read.problem().text());
  CHECK(read->form == "SQLite of JuPedSim, version 2");
  CHECK(read->fps == 10.0);
  CHECK_FALSE(read->has_heights);
  REQUIRE(read->people.size() == 2);
  CHECK(read->people[0].id == 1);
  CHECK(read->people[0].times_s == std::vector<double>{-0.1, 0});
  CHECK(read->people[0].places[0] == glm::dvec3(1.0 / 3, 2, 0));
  CHECK(read->people[0].facing[1].x == Approx(0.6));
  CHECK(read->people[1].times_s == std::vector<double>{0, 0.1});
  CHECK(read->people[1].places[1] == glm::dvec3(5.1, 3, 0));
}

TEST_CASE("a written file has the tables and keys that JuPedSim expects", "[trajectories]") {
  const TemporaryFolder folder;
  const auto file = folder / "people.sqlite";
  REQUIRE(write_trajectories(file, two_people()).ok());
  const auto value = [&](const std::string& key) {
    return asked(file, ("SELECT value FROM metadata WHERE key = '" + key + "'").c_str());
  };
  CHECK(value("version") == "2");
  CHECK(std::stod(value("fps")) == 10);
  CHECK(std::stod(value("xmin")) == -1);
  CHECK(std::stod(value("xmax")) == 9);
  CHECK(std::stod(value("ymin")) == 0.5);
  CHECK(std::stod(value("ymax")) == 4);
  CHECK(value("scene") == "hall's \"floor\".toml");
  CHECK(asked(file, "SELECT wkt FROM geometry") == "POLYGON ((-1 0.5, 9 0.5, 9 4, -1 4, -1 0.5))");
  CHECK(asked(file,
              "SELECT group_concat(frame) FROM frame_data JOIN geometry ON hash = "
              "geometry_hash") == "-1,0,1");
  CHECK(asked(file, "PRAGMA integrity_check") == "ok");
}

TEST_CASE("trajectories are written as a whole or not at all", "[trajectories]") {
  const TemporaryFolder folder;
  WrittenTrajectories twice = two_people();
  twice.metadata.emplace_back("seed", "8");
  const auto failed = write_trajectories(folder / "people.sqlite", twice);
  REQUIRE_FALSE(failed.ok());
  CHECK_THAT(failed.problem().text(), Catch::Contains("UNIQUE constraint failed: metadata.key"));
  CHECK(std::filesystem::is_empty(folder / "."));
  CHECK_FALSE(write_trajectories(folder / "missing" / "people.sqlite", two_people()).ok());
}
