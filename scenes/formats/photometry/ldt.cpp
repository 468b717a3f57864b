// An EULUMDAT file is a list of lines with one value each; the line's number gives its meaning: 26
// of the luminaire, 6 per lamp set, 10 direct ratios, then the C angles, the gamma angles, and one
// intensity per line, plane after plane, for the planes that the symmetry does not omit. The reader
// walks them once; it keeps the first fault and ignores the rest.
#include "scenes/formats/photometry/ldt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/core/printable.hpp"
#include "scenes/formats/photometry/photometric_table.hpp"
#include "scenes/formats/photometry/photometric_text.hpp"

namespace luxodus {

namespace ldt_limits {
constexpr double c_planes = 1440;       // 0.25 degree steps; real files stop at 72 to 361
constexpr double gammas = 1801;         // 0.1 degree steps; real files stop at 181 to 721
constexpr double lamp_sets = 20;        // the format's own limit
constexpr double dimension_mm = 100e3;  // a luminaire of 100 m has the wrong unit
constexpr double flux_lm = 1e8;         // the largest floodlights give 3e5
constexpr double candela = 1e9;         // a searchlight reaches 1e8
constexpr double watts = 1e6;
constexpr double factor = 1e4;
constexpr double lamps = 1e4;
}  // namespace ldt_limits

namespace {

// Header and integral of a sound file agree to 0.1 %; beyond 2 % one of them describes something
// else.
constexpr double odd_ldt_share = 0.02;
/// No lamp of a luminaire with several lamps has a lower efficacy.
constexpr double few_lm_per_w = 30;

class LdtReader {
 public:
  LdtReader(std::vector<std::string> lines, const std::string& file, std::optional<int> lamp_set)
      : lines_(std::move(lines)), file_(file), numbers_(file), lamp_set_(lamp_set) {
    out_.file = file;
    out_.format = "EULUMDAT";
  }

  Result<PhotometricFile> read() {
    read_head();
    read_dimensions();
    read_lamps();
    read_angles();
    if (!numbers_.fault()) pick_planes();
    read_intensities();
    if (!numbers_.fault()) finish();
    if (numbers_.fault()) return *numbers_.fault();
    return std::move(out_);
  }

 private:
  enum class Blank { is_fault, is_zero };

  void warn(int line, std::string what) {
    out_.warnings.push_back(problem_in(file_, line, std::move(what)));
  }

  /// The next line; its number is line_.
  std::string_view text(const std::string& what) {
    if (static_cast<size_t>(line_) >= lines_.size()) {
      numbers_.fail(std::max(1, line_), "the file ends where " + what +
                                            " should follow; it is cut off, or lines are missing");
      return {};
    }
    return bare(lines_[static_cast<size_t>(line_++)]);
  }

  double number(const std::string& what, double low, double high, Blank blank = Blank::is_fault) {
    const std::string_view field = text(what);
    if (numbers_.fault()) return 0;
    if (field.empty() && blank == Blank::is_zero) return 0;
    return numbers_.number(line_, field, true, what, low, high);
  }

  int whole(const std::string& what, double low, double high) {
    return numbers_.whole(line_, number(what, low, high), what);
  }

  /// A number on which the light does not depend: where it is odd, it is told and not used.
  double advisory(const std::string& what, double low, double high) {
    const std::string_view field = text(what);
    if (numbers_.fault() || field.empty()) return 0;
    const std::optional<double> value = decimal(field, true);
    if (value && *value >= low && *value <= high) return *value;
    warn(line_, what + " should lie between " + shown(low) + " and " + shown(high) + ", and is \"" +
                    excerpt(field) + "\"; it is not used");
    return 0;
  }

  void read_head() {
    out_.manufacturer = text("the manufacturer");
    read_type();
    symmetry_ = whole("the symmetry indicator (Isym)", 0, 4);
    c_count_ = whole("the number of C planes (Mc)", 1, ldt_limits::c_planes);
    mc_line_ = line_;
    c_step_ = number("the distance between C planes (Dc)", 0, 360, Blank::is_zero);
    gamma_count_ = whole("the number of intensities in a plane (Ng)", 2, ldt_limits::gammas);
    gamma_step_ = number("the distance between intensities (Dg)", 0, 180, Blank::is_zero);
    text("the report number");
    out_.luminaire = text("the luminaire's name");
    out_.article = text("the luminaire's number");
    text("the file name");
    text("the date");
  }

  /// The file's unit is the millimetre, and a luminaire is no smaller than its luminous opening.
  void check_opening(int line) {
    const glm::dvec3 lit = out_.opening.size_m, housing = out_.housing_m;
    const double longest = std::max(housing.x, housing.y);
    if (longest > 0 && std::max(lit.x, lit.y) > longest * (1 + odd_ldt_share))
      warn(line, "the luminous area of " + shown(1000 * std::max(lit.x, lit.y)) +
                     " mm is longer than the luminaire of " + shown(1000 * longest) +
                     " mm; are they in different units?");
  }

  /// With several lamps the file states their total flux; the flux of one lamp only would be half
  /// or less.
  void check_lamps(const LampSet& set) {
    if (set.lamps >= 2 && !is_absolute_set_.back() && set.watts > 0 && set.flux_lm > 0 &&
        set.flux_lm / set.watts < few_lm_per_w)
      warn(line_, shown(set.lamps) + " lamps give " + shown(set.flux_lm) + " lm with " +
                      shown(set.watts) +
                      " W; EULUMDAT states the flux of all lamps of a set together: is it that of "
                      "one?");
    const auto colour = decimal(set.colour, true);
    if (colour && *colour > 0 && !colour_temperature_k(set.colour))
      warn(line_, "the colour of the lamps, \"" + excerpt(set.colour) +
                      "\", is no colour temperature in kelvin; it is not used");
  }

  /// Ityp says point, line or other, on which the light does not depend; a value outside 0 to 3
  /// suggests that lines were lost.
  void read_type() {
    const std::string_view type = text("the type indicator");
    const std::optional<double> value = decimal(type, true);
    if (numbers_.fault() || (value && (*value == 0 || *value == 1 || *value == 2 || *value == 3)))
      return;
    warn(line_, "the type indicator (Ityp) should be 0, 1, 2 or 3, not \"" + excerpt(type) +
                    "\"; it is not used");
  }

  void read_dimensions() {
    const auto metres = [this](const char* what) {
      return number(what, 0, ldt_limits::dimension_mm, Blank::is_zero) / 1000;
    };
    const double length = metres("the length of the luminaire");
    const double width = metres("the width of the luminaire");
    const double height = metres("the height of the luminaire");
    // Width 0 marks a round luminaire whose diameter is its length.
    out_.housing_m = {width > 0 ? width : length, length, height};
    out_.housing_round = width == 0 && length > 0;
    const double lit_length = metres("the length of the luminous area");
    const double lit_width = metres("the width of the luminous area");
    double lit_height = metres("the height of the luminous area at C0");
    lit_height = std::max(lit_height, metres("the height of the luminous area at C90"));
    lit_height = std::max(lit_height, metres("the height of the luminous area at C180"));
    lit_height = std::max(lit_height, metres("the height of the luminous area at C270"));
    using Shape = LuminousOpening::Shape;
    const bool round = lit_width == 0;
    if (lit_length > 0 || lit_width > 0) {
      out_.opening.size_m = {round ? lit_length : lit_width, lit_length, lit_height};
      out_.opening.shape = round ? (lit_height > 0 ? Shape::cylinder : Shape::disc)
                                 : (lit_height > 0 ? Shape::box : Shape::rectangle);
    }
    if (!numbers_.fault()) check_opening(line_);
    down_percent_ = advisory("the downward flux fraction (DFF)", 0, 100.5);
    down_line_ = line_;
    output_percent_ = number("the light output ratio (LORL)", 0, 1000, Blank::is_zero);
    output_line_ = line_;
    factor_ = number("the conversion factor", 0, ldt_limits::factor, Blank::is_zero);
    if (!numbers_.fault() && factor_ == 0) {
      warn(line_, "the conversion factor is 0 or missing; 1 is used");
      factor_ = 1;
    }
    out_.measured_tilt_deg = number("the tilt during measurement", -360, 360, Blank::is_zero);
    if (out_.measured_tilt_deg != 0) {
      warn(line_, "the luminaire was tilted by " + shown(out_.measured_tilt_deg) +
                      " degrees when measured; its C and gamma angles are taken as written");
    }
  }

  void read_lamps() {
    const int sets = whole("the number of lamp sets", 1, ldt_limits::lamp_sets);
    const int sets_line = line_;
    for (int i = 0; i < sets && !numbers_.fault(); ++i) {
      LampSet set;
      const int count = whole("the number of lamps", -ldt_limits::lamps, ldt_limits::lamps);
      // A negative count marks absolute photometry; the flux is then the luminaire's own.
      is_absolute_set_.push_back(count < 0);
      set.lamps = std::abs(count);
      set.type = text("the type of the lamps");
      set.flux_lm = number("the flux of the lamps", 0, ldt_limits::flux_lm);
      set.colour = text("the colour of the lamps");
      set.rendering = text("the colour rendering of the lamps");
      set.watts = advisory("the wattage of the lamps", 0, ldt_limits::watts);
      if (!numbers_.fault()) check_lamps(set);
      out_.lamp_sets.push_back(std::move(set));
    }
    if (!numbers_.fault()) choose_lamps(sets_line);
    for (int i = 0; i < 10; ++i) number("a direct ratio", -1000, 1000, Blank::is_zero);
  }

  /// Lamp sets are alternatives: of several, one burns.
  void choose_lamps(int sets_line) {
    const size_t sets = out_.lamp_sets.size();
    if (!lamp_set_ && sets > 1)
      return numbers_.fail(sets_line, std::to_string(sets) +
                                          " lamp sets are alternatives: say which burns, lamp_set "
                                          "= 1 to " +
                                          std::to_string(sets) + ": " + lamp_choices());
    const auto chosen = static_cast<size_t>(std::max(0, lamp_set_.value_or(1) - 1));
    if (chosen >= sets)
      return numbers_.fail(sets_line, "there is no lamp set " + std::to_string(chosen + 1) +
                                          " in the file; there are: " + lamp_choices());
    const LampSet& set = out_.lamp_sets[chosen];
    out_.absolute = is_absolute_set_[chosen];
    out_.lamp_flux_lm = set.flux_lm;
    out_.input_watts = set.watts;
    out_.cct_k = colour_temperature_k(set.colour);
    out_.cri = colour_rendering(set.rendering);
    if (set.flux_lm <= 0)
      numbers_.fail(line_,
                    "the lamp set has no flux; without it intensities per 1000 lm mean "
                    "nothing");
  }

  /// "1: LED 350 mA, 1000 lm; 2: ..."
  std::string lamp_choices() const {
    std::string out;
    for (size_t i = 0; i < out_.lamp_sets.size(); ++i)
      out += (i == 0 ? "" : "; ") + std::to_string(i + 1) + ": " +
             excerpt(out_.lamp_sets[i].type, 60) + ", " + shown(out_.lamp_sets[i].flux_lm) + " lm";
    return out;
  }

  std::vector<double> angles(int count, const std::string& what, double high, double step) {
    std::vector<double> list;
    bool off_step = false;
    for (int i = 0; i < count && !numbers_.fault(); ++i) {
      list.push_back(number(what, 0, high));
      if (numbers_.fault() || i == 0) continue;
      const size_t k = list.size() - 1;
      if (!(list[k] > list[k - 1])) {
        numbers_.fail(line_,
                      what + " " + shown(list[k]) + " does not ascend from " + shown(list[k - 1]));
      }
      off_step = off_step || (step > 0 && std::abs(list[k] - list[k - 1] - step) > 0.01);
    }
    if (off_step && !numbers_.fault()) {
      warn(line_, what + "s do not keep the stated step of " + shown(step) +
                      " degrees; the listed angles are used");
    }
    return list;
  }

  void read_angles() {
    if (symmetry_ == 1) {
      // One plane represents all; the C angles in the file are not used.
      for (int i = 0; i < c_count_ && !numbers_.fault(); ++i)
        number("the C angle", -360, 720, Blank::is_zero);
    } else {
      c_angles_ = angles(c_count_, "the C angle", 360, c_step_);
    }
    c_line_ = line_;
    table_.polar_deg = angles(gamma_count_, "the gamma angle", 180, gamma_step_);
    if (numbers_.fault()) return;
    const double first = table_.polar_deg.front();
    const double last = table_.polar_deg.back();
    if ((first != 0 && first != 90) || (last != 90 && last != 180)) {
      warn(line_, "gamma runs from " + shown(first) + " to " + shown(last) +
                      "; outside it the luminaire is taken as dark");
    }
  }

  /// The planes whose intensities the file lists: all, one, or those of a half or a quarter circle.
  void pick_planes() {
    const auto near = [](double a, double b) { return std::abs(a - b) < 0.01; };
    if (symmetry_ == 1) {
      table_.azimuth_deg = {0};
      return;
    }
    if (symmetry_ == 0) {
      table_.azimuth_deg = c_angles_;
      if (const auto gap = missing_deg(c_angles_))
        numbers_.fail(c_line_, "C planes are missing: between C" + shown(c_angles_.back()) +
                                   " and C" + shown(c_angles_.front()) + " a gap of " +
                                   shown(*gap) + " degrees is wider than any step");
      return;
    }
    const int parts = symmetry_ == 4 ? 4 : 2;
    if (c_count_ % (symmetry_ == 2 ? 2 : 4) != 0) {
      numbers_.fail(mc_line_, "with symmetry " + std::to_string(symmetry_) +
                                  " the number of C planes must " + "be a multiple of " +
                                  (symmetry_ == 2 ? "2" : "4") + ", not " +
                                  std::to_string(c_count_));
      return;
    }
    // Symmetry 3 lists C270 over C0 to C90.
    const int first = symmetry_ == 3 ? c_count_ / 4 * 3 : 0;
    for (int i = 0; i <= c_count_ / parts; ++i) {
      const auto index = static_cast<size_t>((first + i) % c_count_);
      table_.azimuth_deg.push_back(c_angles_[index] + (first + i >= c_count_ ? 360 : 0));
    }
    const double from = symmetry_ == 3 ? 270 : 0;
    const double to = from + 360.0 / parts;
    if (!near(table_.azimuth_deg.front(), from) || !near(table_.azimuth_deg.back(), to)) {
      numbers_.fail(c_line_, "with symmetry " + std::to_string(symmetry_) +
                                 " the listed planes must run from C" + shown(from) + " to C" +
                                 shown(std::fmod(to, 360)) + ", but they run from C" +
                                 shown(table_.azimuth_deg.front()) + " to C" +
                                 shown(std::fmod(table_.azimuth_deg.back(), 360)));
    }
    table_.azimuth_deg.front() = from;
    table_.azimuth_deg.back() = to;
  }

  void read_intensities() {
    for (size_t a = 0; a < table_.azimuth_deg.size() && !numbers_.fault(); ++a) {
      std::vector<double> column;
      const std::string what =
          "the intensity in plane C" + shown(std::fmod(table_.azimuth_deg[a], 360));
      for (int p = 0; p < gamma_count_ && !numbers_.fault(); ++p) {
        column.push_back(number(what, 0, ldt_limits::candela) * factor_ * out_.lamp_flux_lm / 1000);
      }
      table_.columns.push_back(std::move(column));
    }
    if (numbers_.fault()) return;
    // Real files are padded with empty lines and zeros; anything else was meant to be read.
    for (auto i = static_cast<size_t>(line_); i < lines_.size(); ++i) {
      const std::string_view rest = bare(lines_[i]);
      if (rest.empty() || decimal(rest, true) == 0.0) continue;
      warn(static_cast<int>(i) + 1, "lines after the last intensity are not used");
      break;
    }
  }

  WebSymmetry web_symmetry() const {
    switch (symmetry_) {
      case 1:
        return WebSymmetry::rotational;
      case 2:
        return WebSymmetry::about_0_180;
      case 3:
        return WebSymmetry::about_90_270;
      case 4:
        return WebSymmetry::about_both;
      default:
        return WebSymmetry::none;
    }
  }

  void finish() {
    if (auto odd = odd_pole(table_)) warn(c_line_, std::move(*odd));
    if (auto odd = odd_step(table_.azimuth_deg)) warn(c_line_, std::move(*odd));
    auto web = web_of(pole_to_pole(around(table_, web_symmetry())), type_c_axes(), {file_, line_});
    if (!web) {
      numbers_.fail(web.problem());
      return;
    }
    out_.web = web.value();
    out_.flux_lm = out_.web->flux_lm();
    out_.down_share = down_share_of(*out_.web);
    if (const auto odd = odd_efficacy(out_)) warn(line_, *odd);
    const double ratio = out_.flux_lm / out_.lamp_flux_lm;
    out_.light_output_ratio = ratio;
    if (output_percent_ > 0) {
      out_.light_output_ratio = output_percent_ / 100;
      out_.header_flux_lm = out_.lamp_flux_lm * out_.light_output_ratio;
      if (std::abs(ratio / out_.light_output_ratio - 1) > odd_ldt_share) {
        warn(output_line_, "the light output ratio says " + shown(output_percent_) +
                               " %, the intensities add up to " + shown(100 * ratio) + " %");
      }
    } else {
      warn(output_line_, "the light output ratio is 0 or missing; the intensities add up to " +
                             shown(100 * ratio) + " %");
    }
    if (down_percent_ > 0) {
      out_.header_down_share = down_percent_ / 100;
      if (std::abs(out_.down_share - down_percent_ / 100) > odd_ldt_share) {
        warn(down_line_, "the downward flux fraction says " + shown(down_percent_) +
                             " %, the intensities give " + shown(100 * out_.down_share) + " %");
      }
    }
  }

  std::vector<std::string> lines_;
  std::string file_;
  PhotometricNumbers numbers_;
  std::optional<int> lamp_set_;
  std::vector<bool> is_absolute_set_;  // by lamp set
  int line_ = 0;                       // lines read so far, which is the number of the last one
  PhotometricFile out_;

  int symmetry_ = 0;
  int c_count_ = 0;
  int gamma_count_ = 0;
  int mc_line_ = 0;
  int c_line_ = 0;
  int down_line_ = 0;
  int output_line_ = 0;
  double c_step_ = 0;
  double gamma_step_ = 0;
  double down_percent_ = 0;
  double output_percent_ = 0;
  double factor_ = 1;
  std::vector<double> c_angles_;
  PhotometricTable table_;
};

}  // namespace

Result<PhotometricFile> read_ldt(std::string_view bytes, const std::string& file,
                                 std::optional<int> lamp_set) {
  Result<std::vector<std::string>> lines = photometric_lines(bytes, file);
  if (!lines) return lines.problem();
  return LdtReader(std::move(lines).value(), file, lamp_set).read();
}

}  // namespace luxodus
