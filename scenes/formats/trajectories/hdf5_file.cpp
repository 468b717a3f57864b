// HDF5: a table "/trajectory" with the columns frame, id, x, y and mostly z. Three kinds exist:
//
//   archive, older JuPedSim   attribute fps of the table; geometry in wkt_geometry of the root; z,
//                             where it is there, is the height of a head
//   JuPedSim, schema 2        attributes dt, every_nth_frame and schema_version of the root, but no
//                             fps; z is the floor's height; compressed by Zstandard, a filter that
//                             libhdf5 does not bring
//
// The library reads other files and loads code as a file tells it (external links and storage,
// virtual data sets, filters). So a process of its own holds the file in memory, loads no plugin,
// has Zstandard from this program, and refuses a table that is linked, stored elsewhere, virtual,
// or filtered by anything else. The geometry (wkt_geometry) is not read: it is a text of variable
// length, for which the library copies as many bytes as a damaged file says.
#include <fmt/format.h>
#include <hdf5.h>
#include <zstd.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/trajectories/trajectory_rows.hpp"

namespace luxodus {

namespace {

/// Registered for Zstandard at The HDF Group.
constexpr H5Z_filter_t zstandard_filter = 32015;
/// Largest chunk of a table [bytes]; JuPedSim writes 64 KiB.
constexpr size_t chunk_bytes = size_t{64} << 20;
/// Rows that are read at a time.
constexpr hsize_t rows_at_once = 1 << 16;
/// What reading a file may take: its bytes twice, the table and its copy; and the time of the
/// largest table, and of bytes at a rate that any machine reaches. Damaged files of a few kilobytes
/// make the library run for minutes, so the limits grow with the file.
IsolatedLimits job_limits(uint64_t bytes) {
  constexpr uint64_t table_bytes = uint64_t{2} << 30, bytes_per_s = uint64_t{20} << 20;
  constexpr uint32_t table_s = 10;
  return {table_bytes + 3 * bytes, table_s + static_cast<uint32_t>(bytes / bytes_per_s)};
}

/// An identifier of the library, closed at its end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: implicit on purpose, the library takes it
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The filter of Zstandard: from chunks to what they hold. Returns its bytes, 0 for an error.
size_t unpack(unsigned flags, size_t, const unsigned*, size_t bytes, size_t* held,
              void** buffer) noexcept {
  if ((flags & H5Z_FLAG_REVERSE) == 0) return 0;
  const unsigned long long size = ZSTD_getFrameContentSize(*buffer, bytes);
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size > chunk_bytes)
    return 0;
  void* out = H5allocate_memory(static_cast<size_t>(size) + 1, 0);
  if (out == nullptr) return 0;
  const size_t made = ZSTD_decompress(out, static_cast<size_t>(size), *buffer, bytes);
  if (ZSTD_isError(made) != 0 || made == 0) {
    H5free_memory(out);
    return 0;
  }
  H5free_memory(*buffer);
  *buffer = out;
  *held = static_cast<size_t>(size) + 1;
  return made;
}

constexpr H5Z_class2_t zstandard{H5Z_CLASS_T_VERS, zstandard_filter, 0,       1,
                                 "zstd",           nullptr,          nullptr, unpack};

/// A row as it is read, whatever types the file has.
struct Hdf5Row {
  int64_t frame, id;
  double x, y, z;
};
static_assert(sizeof(Hdf5Row) == 40);  // limits::trajectory_rows

/// What the job answers.
struct Hdf5Table {
  double fps = 0;
  int schema = 0;  // of JuPedSim; 0: none is stated
  std::vector<Hdf5Row> rows;
};

class Hdf5Reader {
 public:
  Hdf5Reader(std::string bytes, const std::string& file) : bytes_(std::move(bytes)), file_(file) {}

  Result<Hdf5Table> read() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0);
    H5Zregister(&zstandard);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, 1 << 16, false);
    H5Pset_file_image(access, bytes_.data(), bytes_.size());
    const Handle file(H5Fopen("trajectories", H5F_ACC_RDONLY, access), H5Fclose);
    if (!file.ok()) return bad("the file is damaged");
    H5L_info_t link{};
    if (H5Lget_info(file, "trajectory", &link, H5P_DEFAULT) < 0)
      return bad("there is no table \"/trajectory\" in it");
    if (link.type != H5L_TYPE_HARD)
      return bad("\"/trajectory\" is a link to elsewhere, which is not followed");
    const Handle table(H5Dopen2(file, "trajectory", H5P_DEFAULT), H5Dclose);
    if (!table.ok()) return bad("\"/trajectory\" is no table");
    if (auto ok = check_storage(table); !ok) return ok.problem();
    Hdf5Table out;
    if (auto ok = read_rate(file, table, out); !ok) return ok.problem();
    if (auto ok = read_rows(table, out); !ok) return ok.problem();
    return out;
  }

 private:
  Problem bad(std::string what) const { return problem_in(file_, "HDF5: " + std::move(what)); }

  Result<void> check_storage(hid_t table) const {
    const Handle made(H5Dget_create_plist(table), H5Pclose);
    const H5D_layout_t layout = H5Pget_layout(made);
    if (!made.ok() || H5Pget_external_count(made) != 0 ||
        (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED))
      return bad("\"/trajectory\" is stored outside of the file, which is not read");
    if (layout != H5D_CHUNKED) return {};
    hsize_t chunk = 0;
    const Handle type(H5Dget_type(table), H5Tclose);
    if (H5Pget_chunk(made, 1, &chunk) != 1 || chunk == 0 ||
        chunk > chunk_bytes / std::max<size_t>(H5Tget_size(type), 1))
      return bad(
          fmt::format("the chunks of \"/trajectory\" are larger than {} MiB", chunk_bytes >> 20));
    for (int i = 0; i < H5Pget_nfilters(made); ++i) {
      unsigned flags = 0, config = 0;
      size_t values = 0;
      const H5Z_filter_t filter = H5Pget_filter2(made, static_cast<unsigned>(i), &flags, &values,
                                                 nullptr, 0, nullptr, &config);
      constexpr std::array<H5Z_filter_t, 4> known{H5Z_FILTER_DEFLATE, H5Z_FILTER_SHUFFLE,
                                                  H5Z_FILTER_FLETCHER32, zstandard_filter};
      if (std::find(known.begin(), known.end(), filter) == known.end())
        return bad(
            fmt::format("\"/trajectory\" is compressed by filter {}; deflate and Zstandard "
                        "are read: run \"h5repack -f GZIP=5\" on it",
                        filter));
    }
    return {};
  }

  /// A number that an attribute states; none where there is no such attribute. Errors: it is no
  /// single number.
  Result<std::optional<double>> number_at(hid_t object, const char* name) const {
    if (H5Aexists(object, name) <= 0) return std::optional<double>();
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
    const H5T_class_t kind = H5Tget_class(type);
    double value = 0;
    if (!attribute.ok() || (kind != H5T_INTEGER && kind != H5T_FLOAT) ||
        H5Sget_simple_extent_npoints(space) != 1 ||
        H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
      return bad(fmt::format("the attribute \"{}\" is no number", name));
    return std::optional<double>(value);
  }

  Result<void> read_rate(hid_t file, hid_t table, Hdf5Table& out) const {
    std::array<std::optional<double>, 4> stated;
    const std::array<std::pair<hid_t, const char*>, 4> names{
        {{table, "fps"}, {file, "dt"}, {file, "every_nth_frame"}, {file, "schema_version"}}};
    for (size_t i = 0; i < names.size(); ++i) {
      const auto number = number_at(names[i].first, names[i].second);
      if (!number) return number.problem();
      stated[i] = number.value();
    }
    const auto& [fps, dt, every, schema] = stated;
    if (schema && *schema != 2)
      return bad(
          fmt::format("its schema_version is {:g}: of JuPedSim's schemas 2 is read", *schema));
    out.schema = schema ? 2 : 0;
    if (fps)
      out.fps = *fps;
    else if (dt && every)
      out.fps = 1 / (*dt * *every);
    else
      return bad(
          "no rate of frames is stated: neither the attribute \"fps\" of \"/trajectory\", "
          "nor \"dt\" and \"every_nth_frame\" of the file");
    return {};
  }

  /// The columns of a row that the table has, and are of the kind that they have to be.
  Result<void> check_columns(hid_t type, bool& has_z) const {
    if (H5Tget_class(type) != H5T_COMPOUND)
      return bad("\"/trajectory\" has no columns: frame, id, x and y are needed");
    has_z = H5Tget_member_index(type, "z") >= 0;
    for (const char* name : {"frame", "id", "x", "y", "z"}) {
      if (std::strcmp(name, "z") == 0 && !has_z) continue;
      const int at = H5Tget_member_index(type, name);
      if (at < 0) return bad(fmt::format("\"/trajectory\" has no column \"{}\"", name));
      const H5T_class_t kind = H5Tget_member_class(type, static_cast<unsigned>(at));
      const bool whole = std::strlen(name) > 1;
      if (kind != H5T_INTEGER && (whole || kind != H5T_FLOAT))
        return bad(fmt::format("the column \"{}\" of \"/trajectory\" holds no {}", name,
                               whole ? "whole numbers" : "numbers"));
    }
    return {};
  }

  /// Rows that a file declares and does not hold would be read as zeros, for minutes.
  Result<void> check_held(hid_t table, hid_t type, hid_t space, hsize_t count) const {
    const Handle made(H5Dget_create_plist(table), H5Pclose);
    hsize_t held = H5Dget_storage_size(table) / std::max<size_t>(H5Tget_size(type), 1);
    if (hsize_t chunk = 0, chunks = 0; H5Pget_layout(made) == H5D_CHUNKED) {
      if (H5Pget_chunk(made, 1, &chunk) != 1 || H5Dget_num_chunks(table, space, &chunks) < 0)
        return bad("the chunks of \"/trajectory\" cannot be counted: the file is damaged");
      held = chunk > 0 && chunks > limits::trajectory_rows / chunk ? limits::trajectory_rows
                                                                   : chunk * chunks;
    }
    if (count <= held) return {};
    return bad(fmt::format("\"/trajectory\" declares {} rows and holds {}: the file is incomplete",
                           count, held));
  }

  Result<void> read_rows(hid_t table, Hdf5Table& out) const {
    const Handle type(H5Dget_type(table), H5Tclose), space(H5Dget_space(table), H5Sclose);
    bool has_z = false;
    if (auto ok = check_columns(type, has_z); !ok) return ok;
    hsize_t count = 0;
    if (H5Sget_simple_extent_ndims(space) != 1 ||
        H5Sget_simple_extent_dims(space, &count, nullptr) != 1)
      return bad("\"/trajectory\" is no list of rows");
    if (count > limits::trajectory_rows)
      return bad(fmt::format("\"/trajectory\" has {} rows; at most {} are read", count,
                             limits::trajectory_rows));
    if (auto ok = check_held(table, type, space, count); !ok) return ok;
    const Handle memory(H5Tcreate(H5T_COMPOUND, sizeof(Hdf5Row)), H5Tclose);
    H5Tinsert(memory, "frame", offsetof(Hdf5Row, frame), H5T_NATIVE_INT64);
    H5Tinsert(memory, "id", offsetof(Hdf5Row, id), H5T_NATIVE_INT64);
    H5Tinsert(memory, "x", offsetof(Hdf5Row, x), H5T_NATIVE_DOUBLE);
    H5Tinsert(memory, "y", offsetof(Hdf5Row, y), H5T_NATIVE_DOUBLE);
    if (has_z) H5Tinsert(memory, "z", offsetof(Hdf5Row, z), H5T_NATIVE_DOUBLE);
    for (hsize_t from = 0; from < count; from += rows_at_once) {
      const hsize_t now = std::min(rows_at_once, count - from);
      std::vector<Hdf5Row> block(now);
      const Handle part(H5Screate_simple(1, &now, nullptr), H5Sclose);
      if (H5Sselect_hyperslab(space, H5S_SELECT_SET, &from, nullptr, &now, nullptr) < 0 ||
          H5Dread(table, memory, part, space, H5P_DEFAULT, block.data()) < 0)
        return bad("the rows of \"/trajectory\" cannot be read: the file is damaged");
      out.rows.insert(out.rows.end(), block.begin(), block.end());
    }
    return {};
  }

  std::string bytes_;
  const std::string& file_;
};

void hdf5_answer(PlainReader& question, PlainWriter& out) {
  std::string file;
  if (!question.get(file)) throw std::runtime_error("no question");
  auto bytes = read_regular_file(file, limits::trajectory_file_bytes);
  const auto table = bytes ? Hdf5Reader(std::move(bytes).value(), file).read() : bytes.problem();
  out.put(static_cast<uint8_t>(table.ok()));
  if (!table) return out.put(table.problem());
  out.put(table->fps);
  out.put(static_cast<int32_t>(table->schema));
  out.put(table->rows);
}

const IsolatedJob hdf5_job("hdf5", hdf5_answer);

}  // namespace

Result<Trajectories> hdf5_trajectories(const std::string& file) {
  const auto unread = [&] {
    return problem_in(file, "HDF5: what was read of it is incomplete", ProblemKind::bug);
  };
  const auto bytes = size_of_regular_file(file);
  if (!bytes) return bytes.problem();
  auto answer =
      hdf5_job.run([&](PlainWriter& question) { question.put(file); }, job_limits(bytes.value()));
  if (!answer) return problem_in(file, answer.problem());
  uint8_t ok = 0;
  if (!answer->get(ok)) return unread();
  if (ok == 0) {
    Problem told;
    if (!answer->get(told)) return unread();
    return told;
  }
  Hdf5Table table;
  int32_t schema = 0;
  if (!answer->get(table.fps) || !answer->get(schema) || !answer->get(table.rows) ||
      table.rows.size() > limits::trajectory_rows)
    return unread();
  const auto fps = checked_fps(table.fps, file);
  if (!fps) return fps.problem();
  const bool has_heights = schema == 2;
  TrajectoryRows rows(file, TrajectoryRows::Order::any);
  for (const Hdf5Row& row : table.rows)
    if (auto added = rows.add({.id = row.id,
                               .time_s = static_cast<double>(row.frame) / fps.value(),
                               .place = {row.x, row.y, has_heights ? row.z : 0},
                               .facing = glm::dvec2(0)},
                              0);
        !added)
      return added.problem();
  return rows.people_of({.form = has_heights ? "HDF5 of JuPedSim, schema 2" : "HDF5 with fps",
                         .has_heights = has_heights,
                         .fps = fps.value(),
                         .people = {}});
}

}  // namespace luxodus
