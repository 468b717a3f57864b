// Small files of trajectories, made by the libraries that made their forms: a database of JuPedSim,
// tables of HDF5. Each has two people at 2 frames per second who walk east at 1 m/s. Any thread;
// HDF5 one at a time.
#pragma once

#include <hdf5.h>
#include <sqlite3.h>
#include <zstd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace luxodus::test {

/// Runs SQL on a new database file.
inline void make_database(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* db = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &db) == SQLITE_OK);
  char* told = nullptr;
  const int done = sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &told);
  INFO((told == nullptr ? "" : told));
  REQUIRE(done == SQLITE_OK);
  sqlite3_close(db);
}

/// What JuPedSim writes, with the properties that tests vary. Its rows are in the order of frames.
struct JupedsimDatabase {
  std::string version = "2", fps = "2.0";
  bool looks = true;
  std::string rows =
      "(0,7,1.0,2.0,0,2),(0,3,5.0,2.0,1,0),(1,7,1.5,2.0,0,2),(1,3,5.5,2.0,1,0),"
      "(2,7,2.0,2.0,0,2)";
  std::string more = "";

  std::string sql() const {
    return "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, "
           "pos_x REAL NOT NULL, pos_y REAL NOT NULL" +
           std::string(looks ? ", ori_x REAL NOT NULL, ori_y REAL NOT NULL" : "") +
           ");"
           "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
           "INSERT INTO metadata VALUES('version','" +
           version + "'),('fps','" + fps +
           "'),('xmin','0.0');"
           "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
           "INSERT INTO geometry VALUES(1,'POLYGON ((0 0, 9 0, 9 4, 0 4, 0 0))');"
           "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
           "CREATE INDEX frame_id_idx ON trajectory_data(frame, id);"
           "INSERT INTO trajectory_data VALUES " +
           rows + ";" + more;
  }
};

struct TableRow {
  uint64_t frame, id;
  float x, y, z;
};

/// Where the rows of a table are.
enum class RowsIn { this_file, another_file, another_table, nothing };

/// A table of HDF5, with the properties that tests vary.
struct TrajectoryTable {
  std::vector<TableRow> rows{
      {0, 7, 1, 2, 3}, {0, 3, 5, 2, 0}, {1, 7, 1.5, 2, 3}, {1, 3, 5.5, 2, 0}, {2, 7, 2, 2, 3}};
  bool fps = true, schema = false, geometry = true, z = true;
  double rate = 2;
  int filter = 0;        // of a chunked table; 0: in one piece
  hsize_t chunk = 2;     // its rows
  hsize_t declared = 0;  // rows that a chunked table declares, if more than it holds
  RowsIn rows_in = RowsIn::this_file;
  const char* linked_from = nullptr;  // another file, to which "/trajectory" is a link

  void write(const std::filesystem::path& file) const;

 private:
  void store(hid_t how, hid_t space, const std::filesystem::path& file) const;
};

inline void put_number(hid_t object, const char* name, double value) {
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
  H5Aclose(attribute);
  H5Sclose(space);
}

inline void put_text(hid_t object, const char* name, const char* text) {
  const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, &text);
  H5Aclose(attribute);
  H5Tclose(type);
  H5Sclose(space);
}

constexpr int zstandard_number = 32015;

/// Packs chunks as the filter of Zstandard does.
inline size_t pack_chunk(unsigned flags, size_t, const unsigned*, size_t bytes, size_t* held,
                         void** buffer) noexcept {
  if ((flags & H5Z_FLAG_REVERSE) != 0) return 0;
  const size_t most = ZSTD_compressBound(bytes);
  void* out = H5allocate_memory(most, 0);
  const size_t made = ZSTD_compress(out, most, *buffer, bytes, 3);
  H5free_memory(*buffer);
  *buffer = out;
  *held = most;
  return made;
}

/// States in the properties of a table how its rows are stored.
inline void TrajectoryTable::store(hid_t how, hid_t space,
                                   const std::filesystem::path& file) const {
  if (rows_in == RowsIn::another_file)
    H5Pset_external(how, (file.string() + ".rows").c_str(), 0, H5F_UNLIMITED);
  if (rows_in == RowsIn::another_table) H5Pset_virtual(how, space, "other.h5", "/rows", space);
  if (filter != 0) H5Pset_chunk(how, 1, &chunk);
  if (filter == H5Z_FILTER_DEFLATE) H5Pset_deflate(how, 5);
  if (filter == H5Z_FILTER_NBIT) H5Pset_nbit(how);
  if (filter == zstandard_number) {
    H5Pset_shuffle(how);
    H5Pset_filter(how, zstandard_number, H5Z_FLAG_MANDATORY, 0, nullptr);
  }
}

inline void TrajectoryTable::write(const std::filesystem::path& file) const {
  const H5Z_class2_t packing{H5Z_CLASS_T_VERS, zstandard_number, 1,       0,
                             "zstd",           nullptr,          nullptr, pack_chunk};
  const hid_t made = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  REQUIRE(made >= 0);
  if (linked_from != nullptr) {
    H5Lcreate_external(linked_from, "/trajectory", made, "trajectory", H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(made);
    return;
  }
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(TableRow));
  H5Tinsert(type, "frame", offsetof(TableRow, frame), H5T_STD_U64LE);
  H5Tinsert(type, "id", offsetof(TableRow, id), H5T_STD_U64LE);
  H5Tinsert(type, "x", offsetof(TableRow, x), H5T_IEEE_F32LE);
  H5Tinsert(type, "y", offsetof(TableRow, y), H5T_IEEE_F32LE);
  if (z) H5Tinsert(type, "z", offsetof(TableRow, z), H5T_IEEE_F32LE);
  const hsize_t count = rows.size(), most = filter != 0 ? H5S_UNLIMITED : count;
  const hid_t space = H5Screate_simple(1, &count, &most);
  const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
  if (filter == zstandard_number) H5Zregister(&packing);
  store(how, space, file);
  const hid_t table = H5Dcreate2(made, "trajectory", type, space, H5P_DEFAULT, how, H5P_DEFAULT);
  REQUIRE(table >= 0);
  if (rows_in == RowsIn::this_file || rows_in == RowsIn::another_file)
    REQUIRE(H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()) >= 0);
  if (declared > 0) REQUIRE(H5Dset_extent(table, &declared) >= 0);
  if (fps) put_number(table, "fps", rate);
  if (schema) {
    put_number(made, "schema_version", 2);
    put_number(made, "dt", 0.125);
    put_number(made, "every_nth_frame", 4);
  }
  if (geometry) put_text(made, "wkt_geometry", "POLYGON ((0 0, 9 0, 9 4, 0 4, 0 0))");
  H5Dclose(table);
  H5Pclose(how);
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(made);
  if (filter == zstandard_number) H5Zunregister(zstandard_number);
}

inline const std::string petrack_text =
    "# PeTrack project: hall.pet\n# framerate: 2 fps\n"
    "# z: can be 3d position or height of person (alternating or not)\n"
    "# id frame x/cm y/cm z/cm\n"
    "3 0 500 200 176\n3 1 550 200 175\n7 0 100 200 180\n7 1 150 200 180\n7 2 200 200 180\n";

inline const std::string pathfinder_csv =
    "\xEF\xBB\xBFt,id,name,active,x,y,z,v,distance,location\r\n"
    "s,,,,m,m,m,m/s,m,\r\n"
    "0.0,3,\"00001, Floor\",1,5.0,2.0,0.0,1,0,Room\r\n0.0,7,00002,1,1.0,2.0,3.0,1,0,Room\r\n"
    "0.5,3,00001,1,5.5,2.0,0.0,1,0,Room\r\n0.5,7,00002,1,1.5,2.0,3.0,1,0,Room\r\n"
    "1.0,3,00001,0,9.0,2.0,0.0,0,0,\r\n1.0,7,00002,1,2.0,2.0,3.0,1,0,Room\r\n";

inline const std::string pathfinder_json =
    R"({"3":{"0.0":{"position":{"x":5.0,"y":2.0,"z":0.0},"velocity":{"x":1,"y":0,"z":0},)"
    R"("isActive":true},"0.5":{"position":{"x":5.5,"y":2,"z":0},"isActive":true,)"
    R"("tagsApplied":["lastGoalStarted",{"position":{"x":7}},[false]]},)"
    R"("1.0":{"position":{"x":9,"y":2,"z":0},"isActive":false}},)"
    R"("7":{"1.0":{"position":{"x":2.0,"y":2.0,"z":3.0},"isActive":true},)"
    R"("0.0":{"isActive":true,"position":{"x":1.0,"y":2.0,"z":3.0}},)"
    R"("0.5":{"position":{"x":1.5,"y":2.0,"z":3.0},"isActive":true}}})";

}  // namespace luxodus::test
