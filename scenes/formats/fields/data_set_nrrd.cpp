// Reads NRRD (teem.sourceforge.net/nrrd/format.html): lines of `field: value` and `key:=value`, an
// empty line, then samples, here or in a file of their own. As the format demands, unknown fields
// are errors; known fields that concern neither values nor places are ignored.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/fields/data_set_fields.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus::data_set {
namespace {

namespace fs = std::filesystem;

constexpr size_t max_fields = 8;
/// Samples converted at a time: about a megabyte.
constexpr uint64_t block_samples = 1 << 18;

struct Entry {
  std::string value;
  int line = 0;
};

struct Header {
  std::map<std::string, Entry> field;  // key: the name with blanks, "data file"
  std::map<std::string, Entry> key;
  uint64_t bytes = 0;  // including the empty line
};

constexpr std::string_view fields_read[] = {
    "dimension",       "type",   "encoding",         "endian",       "sizes",
    "spacings",        "space",  "space directions", "space origin", "space units",
    "space dimension", "units",  "data file",        "byte skip",    "line skip",
    "old min",         "old max"};
constexpr std::string_view fields_passed_over[] = {
    "content", "kinds",  "centers",     "centerings",   "min",        "max",
    "number",  "labels", "thicknesses", "sample units", "block size", "measurement frame"};
/// The format allows some names without their blank.
constexpr std::pair<std::string_view, std::string_view> other_spellings[] = {
    {"datafile", "data file"},  {"byteskip", "byte skip"}, {"lineskip", "line skip"},
    {"oldmin", "old min"},      {"oldmax", "old max"},     {"sampleunits", "sample units"},
    {"blocksize", "block size"}};

template <class List>
bool contains(const List& list, std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

class NrrdReader {
 public:
  NrrdReader(const std::string& path, const DataSetOptions& options)
      : path_(path), options_(options) {}

  Result<Grid> read() {
    if (auto ok = read_header(); !ok) return ok.problem();
    if (auto ok = understand_samples(); !ok) return ok.problem();
    if (auto ok = understand_place(); !ok) return ok.problem();
    if (auto ok = find_data(); !ok) return ok.problem();
    if (auto ok = read_samples(); !ok) return ok.problem();
    return std::move(grid_);
  }

 private:
  Problem bad(int line, std::string what) const { return problem_in(path_, line, std::move(what)); }
  Problem bad(std::string_view field, std::string_view rule) const {
    const Entry* entry = find(field);
    return bad(entry ? entry->line : 0,
               entry ? fmt::format("\"{}: {}\" is not understood: give {}", field,
                                   excerpt(entry->value), rule)
                     : fmt::format("\"{}\" is missing: give {}", field, rule));
  }

  const Entry* find(std::string_view field) const {
    const auto at = header_.field.find(std::string(field));
    return at == header_.field.end() ? nullptr : &at->second;
  }
  std::string_view value(std::string_view field) const {
    const Entry* entry = find(field);
    return entry ? std::string_view(entry->value) : std::string_view();
  }

  // ---- the header ------------------------------------------------------------------------------

  Result<void> read_header() {
    if (auto file = open_regular_file(path_); !file) return file.problem();
    std::ifstream in(path_, std::ios::binary);
    std::string text(limits::nrrd_header_bytes, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<size_t>(in.gcount()));
    if (text.compare(0, 7, "NRRD000") != 0 || text.size() < 9 || text[7] < '1' || text[7] > '5') {
      return bad(1, "not an NRRD file: the first line must be NRRD0001 to NRRD0005");
    }
    size_t at = 0;
    for (int line = 1;; ++line) {
      const size_t end = text.find('\n', at);
      if (end == std::string::npos) {
        // A detached header may end with its last line; a header with data needs the empty line.
        if (text.size() == limits::nrrd_header_bytes) {
          return bad(line, fmt::format("the header has no end within {} bytes", text.size()));
        }
        if (auto ok = read_line(std::string_view(text).substr(at), line); !ok) return ok.problem();
        header_.bytes = text.size();
        return {};
      }
      std::string_view content = std::string_view(text).substr(at, end - at);
      at = end + 1;
      if (!content.empty() && content.back() == '\r') content.remove_suffix(1);
      if (content.empty()) break;
      if (auto ok = read_line(content, line); !ok) return ok.problem();
    }
    header_.bytes = at;
    return {};
  }

  Result<void> read_line(std::string_view content, int line) {
    if (line == 1 || content.empty() || content.front() == '#') return {};
    const size_t colon = content.find(':');
    if (colon == std::string_view::npos) {
      return bad(line, "a line of the header must be \"field: value\" or \"key:=value\"");
    }
    const bool is_key = content.substr(colon, 2) == ":=";
    std::string name(trimmed(content.substr(0, colon)));
    const std::string text(trimmed(content.substr(colon + (is_key ? 2 : 1))));
    if (!is_key) {
      for (const auto& [spelling, meant] : other_spellings) {
        if (name == spelling) name = meant;
      }
      if (name.starts_with("axis min") || name.starts_with("axismin") ||
          name.starts_with("axis max") || name.starts_with("axismax")) {
        return bad(line, "axis mins and maxs are not read: give \"spacings\" and \"space origin\"");
      }
      if (!contains(fields_read, name) && !contains(fields_passed_over, name)) {
        return bad(line, fmt::format("NRRD knows no field \"{}\"", excerpt(name)));
      }
    }
    auto& list = is_key ? header_.key : header_.field;
    if (!list.try_emplace(name, Entry{text, line}).second) {
      return bad(line, fmt::format("\"{}\" is said twice", excerpt(name)));
    }
    return {};
  }

  // ---- what the samples are --------------------------------------------------------------------

  Result<void> understand_samples() {
    const auto dimension = number_in<int>(value("dimension"));
    if (!dimension || (*dimension != 3 && *dimension != 4)) {
      return bad("dimension", "3, or 4 with several fields along the first axis");
    }
    axes_ = static_cast<size_t>(*dimension);
    const auto sizes = numbers_in<uint64_t>(value("sizes"), axes_);
    if (!sizes) return bad("sizes", fmt::format("{} counts", axes_));
    grid_.nx = (*sizes)[axes_ - 3];
    grid_.ny = (*sizes)[axes_ - 2];
    grid_.nz = (*sizes)[axes_ - 1];
    if (auto ok = check_grid(grid_.nx, grid_.ny, grid_.nz); !ok)
      return bad(find("sizes")->line, ok.problem().what);

    const std::string_view type = value("type");
    if (type == "float") {
      type_ = SampleType::float32;
    } else if (type == "double") {
      type_ = SampleType::float64;
    } else if (type == "uchar" || type == "unsigned char" || type == "uint8" || type == "uint8_t") {
      type_ = SampleType::uint8;
    } else {
      return bad("type", "float, double or uint8");
    }
    if (value("encoding") != "raw") return bad("encoding", "raw: nothing else is read");
    if ((type_ != SampleType::uint8 || find("endian")) && value("endian") != "little") {
      return bad("endian", "little");
    }
    if (auto ok = name_fields((*sizes)[0]); !ok) return ok.problem();
    return understand_mapping();
  }

  Result<void> name_fields(uint64_t first_size) {
    const bool several = axes_ == 4;
    const auto said = header_.key.find(several ? "fields" : "field");
    const bool is_said = said != header_.key.end();
    const int line = is_said ? said->second.line : 0;
    std::vector<std::string_view> names;
    if (!several) {
      names = {is_said ? std::string_view(said->second.value) : std::string_view(options_.field)};
    } else if (is_said) {
      names = words_of(said->second.value);
    }
    if (several && (names.empty() || first_size > max_fields || names.size() != first_size)) {
      return bad(line, fmt::format("the first axis has {} fields: name each, at most {}, as in "
                                   "\"fields:=extinction albedo\"",
                                   first_size, max_fields));
    }
    for (const std::string_view name : names) {
      if (!is_known_field(name)) {
        return bad(line, fmt::format("unknown field \"{}\": extinction, soot_density, albedo and "
                                     "emission are read",
                                     excerpt(name)));
      }
      grid_.fields.push_back({std::string(name), {}});
    }
    return {};
  }

  /// Reads "old min" and "old max": the values of the ends of a quantised type.
  Result<void> understand_mapping() {
    if (!find("old min") && !find("old max")) return {};
    if (type_ != SampleType::uint8 || grid_.fields.size() != 1) {
      return bad("old min", "old min and old max with a single field of type uint8 only");
    }
    const auto low = number_in<double>(find("old min") ? value("old min") : "0");
    const auto high = number_in<double>(value("old max"));
    if (!low || !std::isfinite(*low)) return bad("old min", "a finite number");
    if (!high || !std::isfinite(*high)) return bad("old max", "a finite number");
    offset_ = *low;
    factor_ = (*high - *low) / 255.0;
    return {};
  }

  // ---- where the samples are -------------------------------------------------------------------

  /// `word` is "(a,b,c)".
  static std::optional<glm::dvec3> vector_in(std::string_view word) {
    if (word.size() < 2 || word.front() != '(' || word.back() != ')') return std::nullopt;
    std::string inside(word.substr(1, word.size() - 2));
    std::replace(inside.begin(), inside.end(), ',', ' ');
    const auto v = numbers_in<double>(inside, 3);
    if (!v) return std::nullopt;
    return glm::dvec3((*v)[0], (*v)[1], (*v)[2]);
  }

  Result<void> understand_place() {
    if (const Entry* space = find("space")) {
      constexpr std::string_view taken[] = {"right-anterior-superior", "RAS", "3D-right-handed"};
      if (!contains(taken, space->value)) {
        return bad("space", "3D-right-handed, or leave it out: axes of other spaces are mirrored");
      }
    }
    if (find("space dimension") && value("space dimension") != "3")
      return bad("space dimension", "3");
    if (auto ok = find("space directions") ? understand_directions() : understand_spacings(); !ok)
      return ok.problem();
    glm::dvec3 first_sample = 0.5 * grid_.spacing;
    if (find("space origin")) {
      const auto origin = vector_in(value("space origin"));
      if (!origin) return bad("space origin", "a vector as in (0,0,1.5)");
      first_sample = *origin;
    }
    // NRRD's origin is the middle of the first sample; ours is the corner of its cell.
    grid_.origin = first_sample - 0.5 * grid_.spacing;
    return understand_units();
  }

  Result<void> understand_directions() {
    auto words = words_of(value("space directions"));
    if (axes_ == 4) {
      if (words.empty() || words.front() != "none") {
        return bad("space directions", "\"none\" for the axis of fields, then three vectors");
      }
      words.erase(words.begin());
    }
    if (words.size() != 3) return bad("space directions", "three vectors");
    for (int axis = 0; axis < 3; ++axis) {
      const auto v = vector_in(words[static_cast<size_t>(axis)]);
      if (!v) return bad("space directions", "vectors as in (0.1,0,0)");
      for (int other = 0; other < 3; ++other) {
        if (other == axis ? (*v)[other] > 0 : (*v)[other] == 0) continue;
        return bad("space directions", "axes along +x, +y, +z; turn the medium in the scene");
      }
      grid_.spacing[axis] = (*v)[axis];
    }
    return {};
  }

  Result<void> understand_spacings() {
    auto words = words_of(value("spacings"));
    if (axes_ == 4 && words.size() == 4) words.erase(words.begin());  // the axis of fields has nan
    if (words.size() != 3) return bad("spacings", "the distance of samples along each axis");
    for (int axis = 0; axis < 3; ++axis) {
      const auto spacing = number_in<double>(words[static_cast<size_t>(axis)]);
      if (!spacing || !(*spacing > 0) || !std::isfinite(*spacing)) {
        return bad("spacings", "a length above 0 along each axis");
      }
      grid_.spacing[axis] = *spacing;
    }
    return {};
  }

  Result<void> understand_units() {
    const std::string_view field = find("space units") ? "space units" : "units";
    if (!find(field)) return {};
    auto words = words_of(value(field));
    if (axes_ == 4 && words.size() == 4) words.erase(words.begin());
    const bool alike = words.size() == 3 && words[0] == words[1] && words[1] == words[2];
    if (!alike || words[0].size() < 2 || words[0].front() != '"' || words[0].back() != '"') {
      return bad(field, "one unit for all axes, as in \"m\" \"m\" \"m\"");
    }
    const auto metres = metres_per_unit(words[0].substr(1, words[0].size() - 2));
    if (!metres) return bad(find(field)->line, metres.problem().what);
    grid_.origin *= metres.value();
    grid_.spacing *= metres.value();
    return {};
  }

  // ---- the data --------------------------------------------------------------------------------

  Result<void> find_data() {
    data_path_ = path_;
    uint64_t first = header_.bytes;
    grid_.files_read = {path_};
    if (const Entry* entry = find("data file")) {
      const std::string& name = entry->value;
      if (name.empty() || name.starts_with("LIST") || name.find('%') != std::string::npos) {
        return bad("data file", "the name of a single file");
      }
      data_path_ = (fs::path(path_).parent_path() / name).string();
      first = 0;
      grid_.files_read.push_back(data_path_);
    }
    const auto found = size_of_regular_file(data_path_);
    if (!found && found.problem().kind == ProblemKind::not_found)
      return bad("data file", "a file that exists");
    if (!found) return found.problem();
    const uint64_t size = found.value();
    data_.open(data_path_, std::ios::binary);
    if (auto ok = skip_lines(first); !ok) return ok.problem();
    // At most 2^31 cells of 8 fields of 8 bytes: no overflow.
    const uint64_t needed = grid_.nx * grid_.ny * grid_.nz * grid_.fields.size() * bytes_of(type_);
    const auto skip = number_in<int64_t>(find("byte skip") ? value("byte skip") : "0");
    if (!skip || *skip < -1) return bad("byte skip", "a count, or -1 for data at the end");
    if (*skip == -1) {
      first = size >= needed ? size - needed : size;
    } else {
      first =
          static_cast<uint64_t>(*skip) > size - first ? size : first + static_cast<uint64_t>(*skip);
    }
    if (size - first < needed) {
      return problem_in(data_path_, fmt::format("{} bytes of samples are claimed, {} are there",
                                                needed, size - first));
    }
    // A byte or two may end a last line; a whole sample more is another grid.
    if (*skip >= 0 && size - first - needed >= std::max<uint64_t>(bytes_of(type_), 4))
      return problem_in(data_path_,
                        fmt::format("{} bytes of samples are claimed, and {} are there: the sizes "
                                    "are not those of the data",
                                    needed, size - first));
    data_.seekg(static_cast<std::streamoff>(first));
    return {};
  }

  /// Moves `first` past the header lines within the data file.
  Result<void> skip_lines(uint64_t& first) {
    const auto lines = number_in<int>(find("line skip") ? value("line skip") : "0");
    if (!lines || *lines < 0 || *lines > 10'000) return bad("line skip", "a count up to 10000");
    data_.seekg(static_cast<std::streamoff>(first));
    for (int i = 0; i < *lines; ++i) {
      data_.ignore(static_cast<std::streamsize>(limits::nrrd_header_bytes), '\n');
    }
    const auto at = static_cast<std::streamoff>(data_.tellg());
    if (!data_ || at < 0) return bad("line skip", "no more lines than the data file has");
    first = static_cast<uint64_t>(at);
    return {};
  }

  Result<void> read_samples() {
    const uint64_t cells = grid_.nx * grid_.ny * grid_.nz;
    const size_t fields = grid_.fields.size();
    const size_t stride = fields * bytes_of(type_);
    if (auto ok = check_memory(cells, fields); !ok) return problem_in(path_, ok.problem());
    for (Field& field : grid_.fields) field.value.resize(cells);
    std::vector<char> block(std::min(cells, block_samples) * stride);
    for (uint64_t done = 0; done < cells;) {
      const uint64_t now = std::min(cells - done, block_samples);
      if (!data_.read(block.data(), static_cast<std::streamsize>(now * stride))) {
        return problem_in(data_path_, "the file ended while it was read");
      }
      for (size_t f = 0; f < fields; ++f) {
        const char* from = block.data() + f * bytes_of(type_);
        float* to = grid_.fields[f].value.data() + done;
        for (uint64_t i = 0; i < now; ++i) to[i] = sample_at(from + i * stride, type_);
      }
      done += now;
    }
    if (offset_ != 0 || factor_ != 1) {
      for (float& v : grid_.fields[0].value) {
        v = static_cast<float>(offset_ + factor_ * static_cast<double>(v));
      }
    }
    return {};
  }

  const std::string& path_;
  const DataSetOptions& options_;
  Header header_;
  Grid grid_;
  size_t axes_ = 3;
  SampleType type_ = SampleType::float32;
  double offset_ = 0, factor_ = 1;
  std::string data_path_;
  std::ifstream data_;
};

}  // namespace

Result<Grid> read_nrrd(const std::string& path, const DataSetOptions& options) {
  return NrrdReader(path, options).read();
}

}  // namespace luxodus::data_set
