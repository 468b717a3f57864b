// An IES file is a label (lines up to TILT=), then numbers separated by blanks, commas and line
// ends: a tilt table, ten numbers that fix the rest, three more, the vertical angles, the
// horizontal angles, and the candela of each horizontal angle in turn. The reader walks tokens that
// know their line; it keeps the first fault and ignores the rest.
#include "scenes/formats/photometry/ies.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "runtime/core/printable.hpp"
#include "scenes/formats/photometry/photometric_table.hpp"
#include "scenes/formats/photometry/photometric_text.hpp"

namespace luxodus {

namespace ies_limits {
constexpr double vertical_angles = 1801;    // 0.1 degree steps; real files stop at 181 to 721
constexpr double horizontal_angles = 1441;  // 0.25 degree steps; real files stop at 73 to 361
constexpr double tilt_angles = 1000;
constexpr double dimension_m = 100;  // a larger one has the wrong unit
constexpr double lumens = 1e8;       // the largest floodlights give 3e5
constexpr double candela = 1e9;      // a searchlight reaches 1e8
constexpr double watts = 1e6;
constexpr double factor = 1e6;
constexpr double lamps = 1e4;
}  // namespace ies_limits

namespace {

constexpr double metres_per_foot = 0.3048;
constexpr double same_angle_deg = 0.01;

// The planes at 0 and 360 degrees are the same plane measured twice; a difference above this share
// of its peak is not noise.
constexpr double odd_ies_share = 0.01;

/// An absolute file whose candela integrate to this was normalised and not scaled back.
constexpr double normalised_lm = 1000, normalised_share = 0.005;
/// Most luminaires emit more than this share of their lamps' light.
constexpr double poor_ratio = 0.45;

enum class Edition { y1986, y1991, y1995, y2002, y2019 };

struct EditionName {
  std::string_view mark;  // first line, upper case
  Edition edition;
  const char* format;
};

constexpr std::array<EditionName, 7> edition_names{{
    {"IESNA91", Edition::y1991, "IES LM-63-1991"},
    {"IESNA:LM-63-1991", Edition::y1991, "IES LM-63-1991"},
    {"IESNA95", Edition::y1995, "IES LM-63-1995"},
    {"IESNA:LM-63-1995", Edition::y1995, "IES LM-63-1995"},
    {"IESNA:LM-63-2002", Edition::y2002, "IES LM-63-2002"},
    {"IES:LM-63-2019", Edition::y2019, "IES LM-63-2019"},
    {"IESNA:LM-63-2019", Edition::y2019, "IES LM-63-2019"},
}};

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

bool near(double a, double b) {
  return std::abs(a - b) < same_angle_deg;
}

/// Shapes of the luminous opening by the signs of width, length and height (LM-63-1995 Annex F,
/// LM-63-2002 table 1). The two editions use the same three numbers for different horizontal
/// bodies.
LuminousOpening opening_of(double width, double length, double height, Edition edition) {
  using Shape = LuminousOpening::Shape;
  const bool modern = edition == Edition::y2002 || edition == Edition::y2019;
  const bool round_w = width < 0;
  const bool round_l = length < 0;
  const bool round_h = height < 0;
  const double w = std::abs(width);
  const double l = std::abs(length);
  const double h = std::abs(height);
  const auto make = [](Shape shape, double x, double y, double z) {
    return LuminousOpening{shape, {x, y, z}};
  };
  if (w == 0 && l == 0 && h == 0) return {};
  if (!round_w && !round_l && !round_h) {
    return make(w > 0 && l > 0 && h > 0 ? Shape::box : Shape::rectangle, l, w, h);
  }
  if (!round_h) {
    // One diameter (-d 0 h), or an ellipse: either or both of width and length negative.
    const double x = l > 0 ? l : w;
    const double y = w > 0 ? w : l;
    return make(h > 0 ? Shape::cylinder : Shape::disc, x, y, h);
  }
  if (!round_w && !round_l) {
    // 1995: a horizontal cylinder of diameter h along the one length that is given.
    if (w == 0 && l > 0) return make(Shape::tube_along_x, l, h, h);
    if (l == 0 && w > 0) return make(Shape::tube_along_y, h, w, h);
    return make(Shape::sphere, l > 0 ? l : h, w > 0 ? w : h, h);
  }
  if (modern && round_w && !round_l && l > 0) return make(Shape::tube_along_x, l, w, h);
  if (modern && round_l && !round_w && w > 0) return make(Shape::tube_along_y, l, w, h);
  // 2002: a vertical disc that faces the photometric horizontal (+X), or across it.
  if (modern && round_w && l == 0) return make(Shape::disc, 0, w, h);
  if (modern && round_l && w == 0) return make(Shape::disc, l, 0, h);
  return make(Shape::sphere, l > 0 ? l : w, w > 0 ? w : l, h);
}

struct Token {
  std::string_view text;
  int line;
};

/// LM-63 allows commas between numbers.
enum class Commas { between_numbers, decimal };

std::vector<Token> tokens_of(const std::vector<std::string>& lines, size_t first, Commas commas) {
  std::vector<Token> tokens;
  for (size_t i = first; i < lines.size(); ++i) {
    const std::string_view line = lines[i];
    const auto gap = [&](char c) {
      return c == ' ' || c == '\t' || c == '\v' || c == '\f' ||
             (c == ',' && commas == Commas::between_numbers);
    };
    for (size_t at = 0; at < line.size();) {
      if (gap(line[at])) {
        ++at;
        continue;
      }
      const size_t start = at;
      while (at < line.size() && !gap(line[at])) ++at;
      tokens.push_back({line.substr(start, at - start), static_cast<int>(i) + 1});
    }
  }
  return tokens;
}

/// Numbers of a text in order, with messages that name the line.
class TokenReader {
 public:
  TokenReader(std::vector<Token> tokens, std::string file, int last_line,
              Commas commas = Commas::between_numbers)
      : tokens_(std::move(tokens)),
        commas_(commas),
        numbers_(std::move(file)),
        line_(last_line),
        last_line_(last_line) {}

  double number(const std::string& what, double low, double high) {
    if (numbers_.fault()) return 0;
    if (next_ >= tokens_.size()) {
      fail(last_line_, "the file ends where " + what + " should follow; it is cut off");
      return 0;
    }
    const Token token = tokens_[next_++];
    line_ = token.line;
    return numbers_.number(line_, token.text, commas_ == Commas::decimal, what, low, high);
  }

  /// The numbers ahead, `skipped` of them left out; fewer where the next ones are no numbers.
  std::vector<double> ahead(size_t skipped, size_t count) const {
    std::vector<double> out;
    for (size_t i = next_ + skipped; i < tokens_.size() && out.size() < count; ++i) {
      const auto value = decimal(tokens_[i].text, commas_ == Commas::decimal);
      if (!value) break;
      out.push_back(*value);
    }
    return out;
  }
  /// The line of the next number.
  int next_line() const { return next_ < tokens_.size() ? tokens_[next_].line : last_line_; }

  int whole(const std::string& what, double low, double high) {
    return numbers_.whole(line_, number(what, low, high), what);
  }

  std::vector<double> ascending(int count, const std::string& what, double low, double high) {
    std::vector<double> list;
    for (int i = 0; i < count && !numbers_.fault(); ++i) {
      const double value = number(what, low, high);
      if (!numbers_.fault() && i > 0 && !(value > list.back())) {
        fail(line_, what + " " + shown(value) + " does not ascend from " + shown(list.back()));
      }
      list.push_back(value);
    }
    return list;
  }

  void fail(int line, std::string what) { numbers_.fail(line, std::move(what)); }
  void fail(Problem problem) { numbers_.fail(std::move(problem)); }
  const std::optional<Problem>& fault() const { return numbers_.fault(); }
  int line() const { return line_; }
  /// The first token that was not consumed, if any.
  const Token* rest() const { return next_ < tokens_.size() ? &tokens_[next_] : nullptr; }

 private:
  std::vector<Token> tokens_;
  Commas commas_;
  PhotometricNumbers numbers_;
  size_t next_ = 0;
  int line_;
  int last_line_;
};

LampTilt read_tilt_table(TokenReader& in) {
  LampTilt tilt;
  tilt.geometry = in.whole("the lamp-to-luminaire geometry", 1, 3);
  const int count = in.whole("the number of tilt angles", 1, ies_limits::tilt_angles);
  tilt.angle_deg = in.ascending(count, "the tilt angle", -180, 180);
  for (int i = 0; i < count && !in.fault(); ++i) {
    tilt.factor.push_back(in.number("the tilt factor", 0, ies_limits::factor));
  }
  return tilt;
}

/// Lamp output of the level luminaire; the table's nearest end where it omits 0 degrees.
double level_factor(const LampTilt& tilt) {
  const auto& angles = tilt.angle_deg;
  if (angles.front() >= 0) return tilt.factor.front();
  if (angles.back() <= 0) return tilt.factor.back();
  const auto after =
      static_cast<size_t>(std::upper_bound(angles.begin(), angles.end(), 0.0) - angles.begin());
  const double s = -angles[after - 1] / (angles[after] - angles[after - 1]);
  return (1 - s) * tilt.factor[after - 1] + s * tilt.factor[after];
}

class IesReader {
 public:
  IesReader(const std::vector<std::string>& lines, size_t tilt_line, const std::string& file,
            const std::filesystem::path& folder, Commas commas)
      : lines_(lines),
        tilt_line_(tilt_line),
        folder_(folder),
        file_(file),
        in_(tokens_of(lines, tilt_line + 1, commas), file, static_cast<int>(lines.size()), commas) {
    out_.file = file;
  }

  Result<PhotometricFile> read() {
    read_edition();
    read_label();
    read_tilt();
    read_main();
    if (!in_.fault()) read_candela();
    if (!in_.fault()) finish();
    if (in_.fault()) return *in_.fault();
    return std::move(out_);
  }
  /// Whether numbers follow the last one.
  bool numbers_are_left() const { return in_.rest() != nullptr; }

 private:
  void warn(int line, std::string what) {
    out_.warnings.push_back(problem_in(file_, line, std::move(what)));
  }

  void read_edition() {
    size_t first = 0;
    while (first < tilt_line_ && bare(lines_[first]).empty()) ++first;
    const std::string mark = upper(bare(lines_[first]));
    out_.format = "IES LM-63-1986";
    if (!mark.starts_with("IES")) return;
    label_start_ = first + 1;
    for (const EditionName& name : edition_names) {
      if (mark != name.mark) continue;
      edition_ = name.edition;
      out_.format = name.format;
      return;
    }
    edition_ = Edition::y2002;
    out_.format = "IES LM-63-2002";
    warn(static_cast<int>(first) + 1,
         "unknown edition \"" + excerpt(mark) + "\"; it is read as LM-63-2002");
  }

  /// Keywords in brackets; [MORE] continues the previous one. Files of 1986 hold plain lines.
  void read_label() {
    std::map<std::string, std::string> words;
    std::string* open = nullptr;
    std::string plain;
    for (size_t i = label_start_; i < tilt_line_; ++i) {
      const std::string_view line = bare(lines_[i]);
      const size_t close = line.find(']');
      if (!line.starts_with('[') || close == std::string_view::npos) {
        if (plain.empty()) plain = line;
        continue;
      }
      const std::string key = upper(bare(line.substr(1, close - 1)));
      const std::string_view value = bare(line.substr(close + 1));
      if (key != "MORE") open = &words[key];
      if (open == nullptr) continue;
      if (!open->empty() && !value.empty()) *open += ' ';
      *open += value;
    }
    out_.manufacturer = words["MANUFAC"];
    out_.article = words["LUMCAT"];
    for (const char* key : {"LUMINAIRE", "LUMCAT", "TEST"}) {
      if (out_.luminaire.empty()) out_.luminaire = words[key];
    }
    if (out_.luminaire.empty()) out_.luminaire = plain;
    lamp_.type = words["LAMP"].empty() ? words["LAMPCAT"] : words["LAMP"];
    for (const char* key : {"COLORTEMP", "_COLORTEMP", "CCT", "_CCT"}) {
      if (lamp_.colour.empty()) lamp_.colour = words[key];
    }
    for (const char* key : {"CRI", "_CRI", "COLORRENDERING"}) {
      if (lamp_.rendering.empty()) lamp_.rendering = words[key];
    }
    // Free text holds many numbers: only one marked as kelvin is a colour temperature.
    for (const char* key : {"LAMP", "LAMPCAT", "LUMINAIRE"}) {
      if (lamp_.colour.empty()) lamp_.colour = kelvin_in(words[key]);
    }
    out_.cct_k = colour_temperature_k(lamp_.colour);
    out_.cri = colour_rendering(lamp_.rendering);
  }

  /// "3000K" or "3000 K" in a text; empty where there is none.
  static std::string kelvin_in(std::string_view text) {
    for (size_t at = 0; at < text.size(); ++at) {
      if (text[at] != 'K' && text[at] != 'k') continue;
      if (at + 1 < text.size() && std::isalnum(static_cast<unsigned char>(text[at + 1]))) continue;
      size_t end = at;
      if (end > 0 && text[end - 1] == ' ') --end;
      size_t start = end;
      while (start > 0 && std::isdigit(static_cast<unsigned char>(text[start - 1]))) --start;
      if (end - start == 4 || end - start == 5)
        return std::string(text.substr(start, end - start)) + " K";
    }
    return {};
  }

  void read_tilt() {
    const int line = static_cast<int>(tilt_line_) + 1;
    const std::string_view stated = bare(lines_[tilt_line_]);
    const std::string_view name = bare(stated.substr(std::string_view("TILT=").size()));
    const std::string word = upper(name);
    if (word == "NONE") return;
    if (word == "INCLUDE") {
      out_.lamp_tilt = read_tilt_table(in_);
    } else {
      out_.lamp_tilt = read_tilt_file(std::string(name), line);
    }
    if (in_.fault()) return;
    tilt_factor_ = level_factor(*out_.lamp_tilt);
    warn(line,
         "the lamp's flux depends on how the luminaire is tilted; the web is that of the level "
         "luminaire (factor " +
             shown(tilt_factor_) + ")");
  }

  LampTilt read_tilt_file(const std::string& name, int line) {
    // The file stands beside the IES file; a path would give a data file access to any file.
    if (name.empty() || name.find_first_of("/\\:") != std::string::npos || name == "..") {
      in_.fail(line, "TILT= must be NONE, INCLUDE or the name of a file beside this one, not \"" +
                         excerpt(name) + "\"");
      return {};
    }
    const std::filesystem::path path = folder_ / name;
    const Result<std::string> bytes = read_photometric_bytes(path);
    if (!bytes) {
      in_.fail(line,
               "the tilt file \"" + excerpt(name) + "\" cannot be read: " + bytes.problem().what);
      return {};
    }
    const auto tilt_lines = photometric_lines(bytes.value(), path.string());
    if (!tilt_lines) {
      in_.fail(tilt_lines.problem());
      return {};
    }
    out_.files_read.push_back(path);
    TokenReader tokens(tokens_of(tilt_lines.value(), 0, Commas::between_numbers), path.string(),
                       std::max(1, static_cast<int>(tilt_lines.value().size())));
    LampTilt tilt = read_tilt_table(tokens);
    if (tokens.fault()) in_.fail(*tokens.fault());
    return tilt;
  }

  void read_main() {
    lamp_.lamps = in_.number("the number of lamps", 0, ies_limits::lamps);
    const double lumens =
        in_.number("the lumens per lamp", -ies_limits::lumens, ies_limits::lumens);
    const int lumens_line = in_.line();
    const double multiplier = in_.number("the candela multiplier", 0, ies_limits::factor);
    vertical_count_ = in_.whole("the number of vertical angles", 2, ies_limits::vertical_angles);
    horizontal_count_ =
        in_.whole("the number of horizontal angles", 1, ies_limits::horizontal_angles);
    type_ = in_.whole("the photometric type", 1, 3);
    if (!in_.fault() && type_ == 3) {
      in_.fail(in_.line(),
               "photometric type A (3) is for vehicle lights and is not read; convert the "
               "file to type C");
    }
    const int units = in_.whole("the unit type (1 feet, 2 metres)", 1, 2);
    const double metres = units == 1 ? metres_per_foot : 1.0;
    const double most = ies_limits::dimension_m / metres;
    const double width = in_.number("the width of the opening", -most, most);
    const double length = in_.number("the length of the opening", -most, most);
    const double height = in_.number("the height of the opening", -most, most);
    out_.opening = opening_of(width * metres, length * metres, height * metres, edition_);
    check_factors_are_there();
    const double ballast = in_.number("the ballast factor", 0, ies_limits::factor);
    const double lamp_factor = read_lamp_factor();
    out_.input_watts = lamp_.watts = in_.number("the input watts", 0, ies_limits::watts);
    if (in_.fault()) return;
    out_.absolute = lumens < 0;
    if (out_.absolute && lumens != -1) {
      warn(lumens_line,
           "lumens per lamp of " + shown(lumens) + " are taken for -1, absolute photometry");
    }
    if (lumens == 0) warn(lumens_line, "the lumens per lamp are 0; only the candela count");
    out_.lamp_flux_lm = out_.absolute ? 0 : lamp_.lamps * lumens;
    lamp_.flux_lm = out_.lamp_flux_lm;
    scale_ = multiplier * ballast * lamp_factor * tilt_factor_;
    if (scale_ == 0) in_.fail(lumens_line, "the multiplier or the ballast factor is 0: no light");
  }

  /// Where the line of ballast factor, photometric factor and watts is missing, the vertical angles
  /// stand in its place: they ascend from an angle that files begin with, and what stands in theirs
  /// does not.
  void check_factors_are_there() {
    if (in_.fault()) return;
    const auto count = static_cast<size_t>(vertical_count_);
    const auto are_angles = [&](const std::vector<double>& list) {
      const bool whole = list.size() == count && list.back() <= 180;
      const bool begins =
          whole && (near(list.front(), 0) || near(list.front(), 90) || near(list.front(), -90));
      return begins &&
             std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
    };
    if (!are_angles(in_.ahead(0, count)) || are_angles(in_.ahead(3, count))) return;
    in_.fail(in_.next_line(),
             "the line of ballast factor, photometric factor and input watts is missing: here the "
             "vertical angles begin");
  }

  /// The number after the ballast factor: the ballast-lamp photometric factor up to 1991, unused
  /// in 1995 and 2002, a code of the file's origin in 2019.
  double read_lamp_factor() {
    const double value = in_.number("the ballast-lamp photometric factor", 0, ies_limits::factor);
    if (in_.fault() || value == 1) return 1;
    if (edition_ < Edition::y1995) {
      warn(in_.line(), "the intensities are multiplied by the ballast-lamp photometric factor of " +
                           shown(value) + ", as " + out_.format +
                           " has it; later editions have none");
      return value;
    }
    if (edition_ < Edition::y2019)
      warn(in_.line(), "the field after the ballast factor is " + shown(value) + "; " +
                           out_.format + " gives it no meaning and it is not used");
    return 1;
  }

  void read_candela() {
    const bool type_b = type_ == 2;
    const double low = type_b ? -180 : 0;
    verticals_ = in_.ascending(vertical_count_, "the vertical angle", low, 180);
    vertical_line_ = in_.line();
    horizontals_ = in_.ascending(horizontal_count_, "the horizontal angle", type_b ? -90 : 0,
                                 type_b ? 90 : 360);
    horizontal_line_ = in_.line();
    for (int a = 0; a < horizontal_count_ && !in_.fault(); ++a) {
      std::vector<double> column;
      const std::string what = "the candela at horizontal angle " + shown(horizontals_[size_t(a)]);
      for (int p = 0; p < vertical_count_ && !in_.fault(); ++p) {
        column.push_back(in_.number(what, 0, ies_limits::candela) * scale_);
      }
      candela_.push_back(std::move(column));
    }
    if (!in_.fault() && in_.rest() != nullptr) {
      warn(in_.rest()->line, "numbers after the last candela value are not used");
    }
  }

  /// The symmetry that the range of horizontal angles of a type C file implies.
  WebSymmetry type_c_symmetry() {
    const double first = horizontals_.front();
    const double last = horizontals_.back();
    if (horizontals_.size() == 1) return WebSymmetry::rotational;
    if (near(first, 0) && near(last, 90)) return WebSymmetry::about_both;
    if (near(first, 0) && near(last, 180)) return WebSymmetry::about_0_180;
    if (near(first, 90) && near(last, 270)) return WebSymmetry::about_90_270;
    if (near(first, 0) && near(last, 360)) {
      check_closed();
      return WebSymmetry::none;
    }
    if (near(first, 0) && last > 180) {
      if (const auto gap = missing_deg(horizontals_)) {
        in_.fail(horizontal_line_, "planes are missing: the horizontal angles stop at " +
                                       shown(last) + ", and the gap of " + shown(*gap) +
                                       " degrees to 360 is wider than any step");
        return WebSymmetry::none;
      }
      warn(horizontal_line_, "the horizontal angles stop at " + shown(last) +
                                 " instead of 360; the first plane closes the circle");
      return WebSymmetry::none;
    }
    in_.fail(horizontal_line_,
             "horizontal angles of type C must be 0 alone or run 0-90, 0-180, 90-270 "
             "or 0-360, not " +
                 shown(first) + "-" + shown(last));
    return WebSymmetry::none;
  }

  void check_closed() {
    double peak = 0;
    double gap = 0;
    for (size_t p = 0; p < verticals_.size(); ++p) {
      peak = std::max(peak, candela_.front()[p]);
      gap = std::max(gap, std::abs(candela_.front()[p] - candela_.back()[p]));
    }
    if (gap > odd_ies_share * peak) {
      warn(horizontal_line_, "the planes at 0 and 360 degrees differ; the one at 0 is used");
    }
  }

  void check_verticals(double from, double to) {
    const double first = verticals_.front();
    const double last = verticals_.back();
    const bool usual = (near(first, from) || near(first, (from + to) / 2)) &&
                       (near(last, to) || near(last, (from + to) / 2));
    if (usual) return;
    warn(vertical_line_, "the vertical angles run from " + shown(first) + " to " + shown(last) +
                             "; outside them the luminaire is taken as dark");
  }

  PhotometricTable type_c_table() {
    check_verticals(0, 180);
    const PhotometricTable listed{horizontals_, verticals_, candela_};
    if (auto odd = odd_pole(listed)) warn(horizontal_line_, std::move(*odd));
    if (auto odd = odd_step(horizontals_)) warn(horizontal_line_, std::move(*odd));
    const WebSymmetry symmetry = type_c_symmetry();
    if (in_.fault()) return listed;
    return pole_to_pole(around(listed, symmetry));
  }

  /// Horizontal angles become polar angles (90 + H), vertical angles become azimuths.
  PhotometricTable type_b_table() {
    const double first = horizontals_.front();
    if (horizontals_.size() < 2 || !near(horizontals_.back(), 90) ||
        !(near(first, 0) || near(first, -90))) {
      in_.fail(horizontal_line_, "horizontal angles of type B must run 0-90 or -90-90");
      return {};
    }
    PhotometricTable table;
    std::vector<size_t> order;  // of horizontal angles, from H = -90 to 90
    if (near(first, 0)) {
      for (size_t a = horizontals_.size(); a-- > 1;) {
        order.push_back(a);
        table.polar_deg.push_back(90 - horizontals_[a]);
      }
    }
    for (size_t a = 0; a < horizontals_.size(); ++a) {
      order.push_back(a);
      table.polar_deg.push_back(90 + horizontals_[a]);
    }
    double widest = 0;
    for (size_t p = 0; p < verticals_.size(); ++p) {
      if (p > 0) widest = std::max(widest, verticals_[p] - verticals_[p - 1]);
      std::vector<double> column;
      for (size_t a : order) column.push_back(candela_[a][p]);
      table.azimuth_deg.push_back(verticals_[p]);
      table.columns.push_back(std::move(column));
    }
    const bool half = near(verticals_.front(), 0);
    if (half) {
      warn(vertical_line_,
           "the vertical angles of type B start at 0; the other side is its mirror image");
    } else {
      check_verticals(-90, 90);
    }
    const WebSymmetry symmetry = half ? WebSymmetry::about_0_180 : WebSymmetry::none;
    return pole_to_pole(around(table, symmetry, widest + same_angle_deg));
  }

  void finish() {
    const bool type_b = type_ == 2;
    const PhotometricTable table = type_b ? type_b_table() : type_c_table();
    if (in_.fault()) return;
    auto web = web_of(table, type_b ? type_b_axes() : type_c_axes(), {file_, in_.line()});
    if (!web) {
      in_.fail(web.problem());
      return;
    }
    out_.web = web.value();
    out_.flux_lm = out_.web->flux_lm();
    out_.down_share = down_share_of(*out_.web);
    if (out_.lamp_flux_lm > 0) out_.light_output_ratio = out_.flux_lm / out_.lamp_flux_lm;
    out_.lamp_sets.push_back(lamp_);
    if (const auto odd = odd_efficacy(out_)) warn(in_.line(), *odd);
    if (out_.absolute && std::abs(out_.flux_lm / normalised_lm - 1) < normalised_share)
      warn(in_.line(), "the file is absolute (-1 lumens per lamp), and its candela add up to " +
                           shown(out_.flux_lm) +
                           " lm: are they candela per 1000 lm, with the flux left out?");
    if (lamp_.lamps >= 2 && out_.lamp_flux_lm > 0 && out_.light_output_ratio < poor_ratio &&
        out_.light_output_ratio * lamp_.lamps > poor_ratio)
      warn(in_.line(), "the candela add up to " + shown(100 * out_.light_output_ratio) + " % of " +
                           shown(lamp_.lamps) + " times " + shown(out_.lamp_flux_lm / lamp_.lamps) +
                           " lm; LM-63 states the lumens of one lamp: are they those of all?");
    // A luminaire cannot emit more than its lamps; 2 % allows for the measurement.
    if (out_.lamp_flux_lm > 0 && out_.light_output_ratio > 1.02) {
      warn(in_.line(), "the candela add up to " + shown(out_.flux_lm) +
                           " lm, more than the lamps' " + shown(out_.lamp_flux_lm) + " lm");
    }
  }

  const std::vector<std::string>& lines_;
  size_t tilt_line_;
  std::filesystem::path folder_;
  std::string file_;
  TokenReader in_;
  PhotometricFile out_;

  Edition edition_ = Edition::y1986;
  size_t label_start_ = 0;
  LampSet lamp_;
  int vertical_count_ = 0;
  int horizontal_count_ = 0;
  int vertical_line_ = 0;
  int horizontal_line_ = 0;
  int type_ = 1;
  double scale_ = 1;
  double tilt_factor_ = 1;
  std::vector<double> verticals_;
  std::vector<double> horizontals_;
  std::vector<std::vector<double>> candela_;
};

/// The first line with a comma between two digits.
std::optional<int> line_of_comma_in_number(const std::vector<std::string>& lines, size_t first) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (size_t i = first; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    for (size_t at = line.find(','); at != std::string::npos; at = line.find(',', at + 1))
      if (at > 0 && at + 1 < line.size() && digit(line[at - 1]) && digit(line[at + 1]))
        return static_cast<int>(i) + 1;
  }
  return std::nullopt;
}

}  // namespace

Result<PhotometricFile> read_ies(std::string_view bytes, const std::string& file,
                                 const std::filesystem::path& folder) {
  const Result<std::vector<std::string>> lines = photometric_lines(bytes, file);
  if (!lines) return lines.problem();
  for (size_t i = 0; i < lines.value().size(); ++i) {
    if (!upper(bare(lines.value()[i])).starts_with("TILT=")) continue;
    IesReader reader(lines.value(), i, file, folder, Commas::between_numbers);
    auto read = reader.read();
    if (read && !reader.numbers_are_left()) return read;
    // Decimal commas make two numbers of one, so that some are left, or one is out of place. With
    // commas as decimal points such a file has just the numbers that its head promises.
    const auto comma = line_of_comma_in_number(lines.value(), i + 1);
    if (!comma) return read;
    IesReader with_decimals(lines.value(), i, file, folder, Commas::decimal);
    if (with_decimals.read() && !with_decimals.numbers_are_left())
      return problem_in(file, *comma,
                        "the numbers have decimal commas, and in LM-63 a comma parts two numbers: "
                        "write points");
    return read;
  }
  return problem_in(file, std::max(1, static_cast<int>(lines.value().size())),
                    "no line starts with TILT=; this is no IES LM-63 file, or it is cut off");
}

}  // namespace luxodus
