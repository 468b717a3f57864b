// Files of trajectories: what each form gives, and what is refused.
#include "scenes/formats/trajectories/trajectories.hpp"

#include <catch2/catch.hpp>

#include "tests/kit/replaced.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/formats/trajectories/trajectory_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// The two people of every small file.
void has_both_people(const Result<Trajectories>& read, double floor_of_7) {
  INFO((read ? "" : read.problem().text()));
  REQUIRE(read.ok());
  REQUIRE(read->people.size() == 2);
  const Trajectory& a = read->people[0];
  const Trajectory& b = read->people[1];
  CHECK(a.id == 3);
  CHECK(a.times_s == std::vector<double>{0, 0.5});
  CHECK(a.places == std::vector<glm::dvec3>{{5, 2, 0}, {5.5, 2, 0}});
  CHECK(b.id == 7);
  CHECK(b.times_s == std::vector<double>{0, 0.5, 1});
  CHECK(b.places ==
        std::vector<glm::dvec3>{{1, 2, floor_of_7}, {1.5, 2, floor_of_7}, {2, 2, floor_of_7}});
}

Result<Trajectories> read_text(const std::string& text) {
  return trajectories_of(text, "people.txt");
}

void refuses(const Result<Trajectories>& read, const std::string& words) {
  INFO(words);
  REQUIRE_FALSE(read.ok());
  CHECK_THAT(read.problem().text(), Catch::Contains(words));
}

Result<Trajectories> read_database(const JupedsimDatabase& database) {
  const TemporaryFolder folder;
  make_database(folder / "a.sqlite", database.sql());
  return read_trajectories(folder / "a.sqlite");
}

Result<Trajectories> read_table(const TrajectoryTable& table) {
  const TemporaryFolder folder;
  table.write(folder / "a.h5");
  return read_trajectories(folder / "a.h5");
}

}  // namespace

TEST_CASE("a database of JuPedSim gives ways and orientations", "[trajectories][sqlite]") {
  const auto read = read_database({});
  has_both_people(read, 0);
  CHECK(read->form == "SQLite of JuPedSim, version 2");
  CHECK(read->fps == 2.0);
  CHECK_FALSE(read->has_heights);
  CHECK(read->people[0].facing == std::vector<glm::dvec2>{{1, 0}, {1, 0}});
  CHECK(read->people[1].facing[0] == glm::dvec2(0, 1));  // of length 2 in the file
}

TEST_CASE("version 3 of JuPedSim has no orientation, and a converted file keeps none",
          "[trajectories][sqlite]") {
  const auto fresh =
      read_database({.version = "3",
                     .looks = false,
                     .rows = "(0,3,5,2),(0,7,1,2),(1,3,5.5,2),(1,7,1.5,2),(2,7,2,2)"});
  has_both_people(fresh, 0);
  CHECK(fresh->people[0].facing.empty());
  const auto converted = read_database({.version = "3"});
  has_both_people(converted, 0);
  CHECK(converted->people[0].facing.empty());
}

TEST_CASE("databases that are not JuPedSim's are refused with one sentence",
          "[trajectories][sqlite]") {
  refuses(read_database({.version = "1"}), "its version is 1: versions 2 and 3 are read");
  refuses(read_database({.version = "new"}), "\"version\" in its metadata is no number");
  refuses(read_database({.fps = "0"}), "0 frames per second are stated");
  refuses(read_database({.fps = "nan"}), "\"fps\" in its metadata is no number");
  refuses(read_database({.more = "DELETE FROM metadata WHERE key = 'fps';"}),
          "its metadata state no \"fps\"");
  refuses(read_database({.more = "DROP TABLE geometry;"}), "no table \"geometry\"");
  refuses(read_database({.more = "DELETE FROM trajectory_data;"}), "there is nobody");
  refuses(read_database({.more = "INSERT INTO trajectory_data VALUES(2,7,0,0,1,0);"}),
          "person 7 is twice in the file at 1 s");
  refuses(read_database({.more = "INSERT INTO trajectory_data VALUES(3,7,9e999,0,1,0);"}),
          "x = inf m at 1.5 s is no coordinate");
  refuses(read_database({.more = "INSERT INTO trajectory_data VALUES(3,7,'east',0,1,0);"}),
          "\"pos_x\" in a row of trajectory_data is no number");
  refuses(read_database({.more = "INSERT INTO trajectory_data VALUES(3.5,7,1,0,1,0);"}),
          "\"frame\" in a row of trajectory_data is no whole number");
  refuses(read_database({.version = "2", .looks = false, .rows = "(0,3,5,2)"}),
          "no such column: ori_x");
}

TEST_CASE("a view in the place of a table is refused before it runs", "[trajectories][sqlite]") {
  refuses(read_database({.more = "DROP TABLE trajectory_data; CREATE VIEW trajectory_data AS WITH "
                                 "RECURSIVE n(frame) AS (VALUES(0) UNION ALL SELECT frame + 1 FROM "
                                 "n) SELECT frame, 1 AS id, 0 AS pos_x, 0 AS pos_y, 1 AS ori_x, 0 "
                                 "AS ori_y FROM n;"}),
          "no table \"trajectory_data\"");
}

TEST_CASE("a database whose newest rows are in another file is refused", "[trajectories][sqlite]") {
  refuses(read_database({.more = "PRAGMA journal_mode = WAL;"}), "it is in WAL mode");
}

TEST_CASE("reading a database leaves no file beside it", "[trajectories][sqlite]") {
  const TemporaryFolder folder;
  make_database(folder / "a.sqlite", JupedsimDatabase{}.sql());
  REQUIRE(read_trajectories(folder / "a.sqlite").ok());
  CHECK(folder.entries() == 1);
}

TEST_CASE("a table of HDF5 with fps gives ways, and its z is no floor", "[trajectories][hdf5]") {
  for (const int filter : {0, int{H5Z_FILTER_DEFLATE}, 32015}) {
    INFO(filter);
    const auto read = read_table({.filter = filter});
    has_both_people(read, 0);
    CHECK_FALSE(read->has_heights);
    CHECK(read->fps == 2.0);
  }
  has_both_people(read_table({.geometry = false, .z = false}), 0);
}

TEST_CASE("schema 2 of JuPedSim states a time step, and its z is the floor",
          "[trajectories][hdf5]") {
  const auto read = read_table({.fps = false, .schema = true, .geometry = false, .filter = 32015});
  has_both_people(read, 3);
  CHECK(read->has_heights);
  CHECK(read->form == "HDF5 of JuPedSim, schema 2");
  CHECK(read->fps == 2.0);
}

TEST_CASE("tables of HDF5 that cannot be read, or reach elsewhere, are refused",
          "[trajectories][hdf5]") {
  refuses(read_table({.fps = false}), "no rate of frames is stated");
  refuses(read_table({.rate = -1}), "-1 frames per second are stated");
  refuses(read_table({.rows = {}}), "there is nobody");
  refuses(read_table({.rows = {{0, 1, NAN, 0, 0}}}), "x = nan m at 0 s is no coordinate");
  refuses(read_table({.rows = {{0, 1, 0, 0, 0}, {0, 1, 1, 0, 0}}}), "is twice in the file at 0 s");
  refuses(read_table({.linked_from = "/etc/passwd"}), "a link to elsewhere");
  const TemporaryFolder folder;
  refuses(trajectories_of("\x89HDF\r\n\x1a\n", folder.write("a.h5", "\x89HDF\r\n\x1a\n")),
          "the file is damaged");
}

TEST_CASE("tables of HDF5 that hold fewer rows than they declare are refused",
          "[trajectories][hdf5]") {
  refuses(read_table({.filter = H5Z_FILTER_DEFLATE, .declared = 1000}),
          "\"/trajectory\" declares 1000 rows and holds 6: the file is incomplete");
  refuses(read_table({.rows_in = RowsIn::nothing}), "declares 5 rows and holds 0");
  refuses(read_table({.filter = H5Z_FILTER_DEFLATE, .declared = 10'000'001}),
          "has 10000001 rows; at most 10000000 are read");
}

TEST_CASE("tables of HDF5 that are stored elsewhere, or in chunks that do not fit, are refused",
          "[trajectories][hdf5]") {
  refuses(read_table({.rows_in = RowsIn::another_file}), "is stored outside of the file");
  refuses(read_table({.rows_in = RowsIn::another_table}), "is stored outside of the file");
  refuses(read_table({.filter = H5Z_FILTER_NBIT}), "is compressed by filter 5; deflate and");
  const hsize_t too_many = (hsize_t{64} << 20) / sizeof(TableRow) + 1;
  refuses(read_table({.filter = H5Z_FILTER_DEFLATE, .chunk = too_many, .rows_in = RowsIn::nothing}),
          "the chunks of \"/trajectory\" are larger than 64 MiB");
}

TEST_CASE("text of PeTrack gives ways in the unit of its header", "[trajectories][text]") {
  const auto read = read_text(petrack_text);
  has_both_people(read, 0);
  CHECK_FALSE(read->has_heights);
  CHECK(read->people[0].facing.empty());
  const auto in_metres = read_text(
      "#framerate: 2.00\n#X,Y,Z: the agents coordinates (in metres)\n\n#ID\tFR\tX\tY\tZ\tA\n"
      "3\t0\t5\t2\t0\t0.1\n7\t0\t1\t2\t0\t0\n3\t1\t5.5\t2\t0\t0\n7\t1\t1.5\t2\t0\t0\n"
      "7\t2\t2\t2\t0\t0\n");
  has_both_people(in_metres, 0);
}

TEST_CASE("columns viewDirX and viewDirY of PeTrack are where people look",
          "[trajectories][text]") {
  const auto read = read_text(
      "# framerate: 2\n# id frame x/m y/m z/m viewDirX viewDirY markerID\n1 0 5 2 1.7 0 -3 12\n");
  REQUIRE(read.ok());
  CHECK(read->people[0].facing == std::vector<glm::dvec2>{{0, -1}});
}

TEST_CASE("text without a rate or a unit, or with bad rows, is refused with its line",
          "[trajectories][text]") {
  refuses(read_text("1 0 5 2 0\n"), ":1: the header states no rate of frames");
  refuses(read_text("# framerate: 25\n# id frame x y z\n1 0 5 2 0\n"),
          ":3: the header states no unit of length");
  refuses(read_text("# framerate: fast\n"), ":1: \"# framerate: fast\" states no rate");
  refuses(read_text(replaced(petrack_text, "x/cm y/cm", "x/cm y/m in m")), "both m and cm");
  refuses(read_text(replaced(petrack_text, "2 fps", "2 fps\n# framerate: 5")),
          ":3: a second rate of frames differs");
  refuses(read_text(replaced(petrack_text, "7 2 200", "7 x 200")), ":9: ");
  refuses(read_text(replaced(petrack_text, "7 2 200", "7 2 nan")), "is no row of numbers");
  refuses(read_text(replaced(petrack_text, "7 2 200", "7 2 1e10")), "is no coordinate");
  refuses(read_text(replaced(petrack_text, "7 2 200", "7 1 200")), "person 7 is twice");
  refuses(read_text(replaced(petrack_text, "7 0 100", "7 9 100")),
          ":8: person 7: the time goes back from 4.5 s to 0.5 s");
  refuses(read_text("# framerate: 2\n# id frame x/m y/m z/m\n"), "there is nobody");
}

TEST_CASE("CSV of Pathfinder gives ways with heights, of who is active", "[trajectories][csv]") {
  const auto read = read_text(pathfinder_csv);
  has_both_people(read, 3);
  CHECK(read->has_heights);
  CHECK_FALSE(read->fps);
  const auto in_feet = read_text("t,id,x,y,z\ns,,ft,ft,ft\n0,1,10,0,0\n");
  REQUIRE(in_feet.ok());
  CHECK(in_feet->people[0].places[0].x == Approx(3.048));
}

TEST_CASE("CSV without its columns or units is refused with its line", "[trajectories][csv]") {
  refuses(read_text(replaced(pathfinder_csv, "id,name", "number,name")), ":1: there is no column");
  refuses(read_text(replaced(pathfinder_csv, "m,m,m,m/s", "mm,mm,mm,m/s")), "is no line of units");
  refuses(read_text("t,id,x,y,z\n0,1,10,0,0\n"), ":2: ");
  refuses(read_text(replaced(pathfinder_csv, "1.0,7,00002,1,2.0", "1.0,7,00002,1,inf")),
          ":8: \"1.0,7,00002,1,inf,2.0,3.0,1,0,Room\" is no row");
  refuses(read_text(replaced(pathfinder_csv, "1.0,7,00002,1,2.0", "0.2,7,00002,1,2.0")),
          "the time goes back");
}

TEST_CASE("JSON of Pathfinder gives ways with heights, whatever the order of its keys",
          "[trajectories][json]") {
  const auto read = read_text(pathfinder_json);
  has_both_people(read, 3);
  CHECK(read->has_heights);
}

TEST_CASE("JSON that is not Pathfinder's is refused with one sentence", "[trajectories][json]") {
  refuses(read_text("{"), "this is no JSON: byte 2 is wrong");
  refuses(read_text("{}"), "there is nobody");
  refuses(read_text(R"({"a":{}})"), "\"a\" is no number of an occupant");
  refuses(read_text(R"({"1":{"now":{}}})"), "\"now\" is no time");
  refuses(read_text(R"({"1":7})"), "a number stands where an object");
  refuses(read_text(R"({"1":{"0":{"isActive":true}}})"), "occupant 1 at 0 s has no \"position\"");
  refuses(read_text(R"({"1":{"0":{"position":{"x":"a","y":1,"z":0}}}})"),
          "a text stands where a coordinate");
  refuses(read_text(R"({"1":{"0":{"position":[1,2,3]}}})"), "has no \"position\"");
  refuses(read_text(R"({"1":{"0":{"position":{"x":[1],"y":2,"z":3}}}})"),
          "a list stands where a coordinate has to be");
  refuses(read_text(R"({"1":[{"position":{"x":1,"y":2,"z":3}}]})"),
          "a list stands where an object of occupants and times has to be");
  refuses(read_text(R"({"1":{"0":{"position":{"x":{"x":{}}}}}})"), "nested more deeply");
  refuses(read_text(replaced(pathfinder_json, "\"1.0\":{\"position\":{\"x\":2.0",
                             "\"0.50\":{\"position\":{\"x\":2.0")),
          "person 7 is twice in the file at 0.5 s");
}

TEST_CASE("a file of no known form is refused with how it begins", "[trajectories]") {
  refuses(read_text("PK\x03\x04"), "it begins with \"PK\\x03\\x04\"");
  refuses(read_text(""), "this is no file of trajectories that is known");
  CHECK(read_trajectories("/nowhere/people.sqlite").problem().kind == ProblemKind::not_found);
}
