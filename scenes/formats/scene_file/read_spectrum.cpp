#include "scenes/formats/scene_file/read_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "runtime/core/printable.hpp"
#include "scenes/formats/images/image_file.hpp"

namespace luxodus {

namespace {

constexpr double absolute_cold_k = 500;  // below, the visible share underflows
constexpr double absolute_hot_k = 100'000;
constexpr double led_cold_k = 2700, led_hot_k = 6500;  // the range of white_led_shape
constexpr std::array<std::pair<std::string_view, LedColour>, 4> coloured_leds{
    {{"led red", LedColour::red},
     {"led yellow", LedColour::yellow},
     {"led green", LedColour::green},
     {"led blue", LedColour::blue}}};
/// Colour temperatures of lamps other than flames; a value beyond them has a wrong digit.
constexpr double reddest_lamp_k = 1200, bluest_lamp_k = 20000;

std::string in_quotes(std::string_view key) {
  return "'" + std::string(key) + "'";
}

/// Rows [[nm, value], ...] of a spectrum, wavelengths ascending.
std::optional<std::vector<glm::dvec2>> rows_of(KeyReader& keys, std::string_view key,
                                               const toml::List& list) {
  std::vector<glm::dvec2> rows;
  const std::string form =
      in_quotes(key) + " as a spectrum is a list of at least two rows [wavelength in nm, value]";
  if (list.size() < 2 || list.size() > limits::toml_values) {
    keys.problem(key, form);
    return std::nullopt;
  }
  for (const toml::Value& entry : list) {
    const toml::List* row = entry.as_list();
    const auto nm = row && row->size() == 2 ? (*row)[0].as_number() : std::nullopt;
    if (!nm) {
      keys.problem(key, form);
      return std::nullopt;
    }
    if (!(*nm >= 100 && *nm <= 20'000)) {
      keys.problem(key, in_quotes(key) + " has a wavelength outside [100, 20000] nm");
      return std::nullopt;
    }
    const auto value = keys.checked(key, (*row)[1]);
    if (!value) return std::nullopt;
    if (!rows.empty() && !(*nm > rows.back().x)) {
      keys.problem(key, in_quotes(key) + " must have ascending wavelengths");
      return std::nullopt;
    }
    rows.emplace_back(*nm, *value);
  }
  return rows;
}

/// Linear sRGB of { srgb = [r, g, b] } or { linear_rgb = [r, g, b] }, values in [0, 1].
std::optional<std::array<double, 3>> colour_of(KeyReader& keys, std::string_view key,
                                               const toml::Table& table) {
  const toml::Value* srgb = table.find("srgb");
  const toml::Value* linear = table.find("linear_rgb");
  const toml::Value* given = srgb ? srgb : linear;
  const toml::List* list = given ? given->as_list() : nullptr;
  if (table.entries().size() != 1 || !list || list->size() != 3) {
    keys.problem(
        key, in_quotes(key) + " as a colour is { srgb = [r, g, b] } or { linear_rgb = [r, g, b] }");
    return std::nullopt;
  }
  std::array<double, 3> rgb{};
  for (size_t i = 0; i < 3; ++i) {
    const auto v = (*list)[i].as_number();
    if (!v || !(*v >= 0 && *v <= 1)) {
      keys.problem(key, in_quotes(key) + " must have colour values in [0, 1]");
      return std::nullopt;
    }
    rgb[i] = srgb ? linear_from_srgb(*v) : *v;
  }
  return rgb;
}

/// "2700 K" -> 2700.
std::optional<double> kelvin_of(std::string_view text) {
  const std::string s(text);
  char* end = nullptr;
  const double v = std::strtod(s.c_str(), &end);
  if (end == s.c_str()) return std::nullopt;
  return std::string_view(end) == " K" || std::string_view(end) == "K" ? std::optional(v)
                                                                       : std::nullopt;
}

std::optional<Spectrum> named_shape(KeyReader& keys, std::string_view key, std::string_view text) {
  if (text == "A") return illuminant_a_shape();
  if (text == "D65") return illuminant_d65_shape();
  if (text == "E") return equal_energy_shape();
  if (text == "photoluminescent") return afterglow_shape();
  for (const auto& [name, colour] : coloured_leds)
    if (text == name) return coloured_led_shape(colour);
  const bool led = text.substr(0, 4) == "led ";
  const auto kelvin = kelvin_of(led ? text.substr(4) : text);
  if (!kelvin) {
    keys.problem(
        key, in_quotes(key) + " is \"" + excerpt(text) +
                 "\" but must be \"A\", \"D65\", \"E\", \"2700 K\", \"led 4000 K\", \"led red\" "
                 "(yellow, green, blue), \"photoluminescent\", a colour table, or rows "
                 "[nm, value]");
    return std::nullopt;
  }
  const double low = led ? led_cold_k : absolute_cold_k, high = led ? led_hot_k : absolute_hot_k;
  if (!(*kelvin >= low && *kelvin <= high)) {
    keys.problem(key, in_quotes(key) + (led ? " of an LED" : " of a black body") +
                          " needs a temperature in [" + std::to_string(static_cast<int>(low)) +
                          ", " + std::to_string(static_cast<int>(high)) + "] K");
    return std::nullopt;
  }
  if (!led && (*kelvin > bluest_lamp_k || *kelvin < reddest_lamp_k))
    keys.reading().warning(keys.place(key),
                           in_quotes(key) + " is a black body of " + std::string(text) +
                               ": lamps have 1800 to 8000 K (65000 K for D65 is 6500 K)");
  return led ? white_led_shape(*kelvin) : blackbody_shape(*kelvin);
}

std::optional<Spectrum> spectrum_shape(KeyReader& keys, std::string_view key,
                                       const toml::Value& value) {
  if (const auto* text = value.as_text()) return named_shape(keys, key, *text);
  if (const auto* table = value.as_table()) {
    const auto rgb = colour_of(keys, key, *table);
    if (!rgb) return std::nullopt;
    if ((*rgb)[0] + (*rgb)[1] + (*rgb)[2] <= 0) {
      keys.problem(key, in_quotes(key) + " must not be black: it has no colour to shine in");
      return std::nullopt;
    }
    return emission_shape_from_linear_srgb((*rgb)[0], (*rgb)[1], (*rgb)[2]);
  }
  const auto* list = value.as_list();
  if (!list) {
    keys.problem(key, in_quotes(key) +
                          " must be the name of a spectrum, a colour, or rows [nm, value], not " +
                          std::string(value.kind()));
    return std::nullopt;
  }
  const auto rows = rows_of(keys, key, *list);
  if (!rows) return std::nullopt;
  Spectrum s = emission_through(*rows);
  const double total = s.integral();
  if (!(total > 0)) {
    keys.problem(key, in_quotes(key) + " emits nothing between 380 and 780 nm");
    return std::nullopt;
  }
  return s * (1 / total);
}

}  // namespace

Spectrum spectrum_through(const std::vector<glm::dvec2>& rows) {
  Spectrum s;
  for (int i = 0; i < spectrum_samples; ++i) {
    const double nm = Spectrum::wavelength_nm(i);
    const auto after = std::upper_bound(rows.begin(), rows.end(), nm,
                                        [](double x, const glm::dvec2& r) { return x < r.x; });
    double v = 0;
    if (after == rows.begin()) {
      v = rows.front().y;
    } else if (after == rows.end()) {
      v = rows.back().y;
    } else {
      const glm::dvec2 a = *(after - 1), b = *after;
      v = a.y + (b.y - a.y) * (nm - a.x) / (b.x - a.x);
    }
    s.value[static_cast<size_t>(i)] = v;
  }
  return s;
}

Spectrum emission_through(const std::vector<glm::dvec2>& rows) {
  Spectrum s;
  for (int i = 0; i < spectrum_samples; ++i) {
    const double low = Spectrum::wavelength_nm(i) - spectrum_step_nm / 2;
    const double high = low + spectrum_step_nm;
    double area = 0;
    for (size_t k = 0; k + 1 < rows.size(); ++k) {
      const glm::dvec2 a = rows[k], b = rows[k + 1];
      const double x0 = std::max(a.x, low), x1 = std::min(b.x, high);
      if (!(x1 > x0)) continue;
      const double slope = (b.y - a.y) / (b.x - a.x);
      area += (x1 - x0) * (a.y + slope * (0.5 * (x0 + x1) - a.x));
    }
    s.value[static_cast<size_t>(i)] = area / spectrum_step_nm;
  }
  return s;
}

std::optional<Spectrum> maybe_property(KeyReader& keys, std::string_view key) {
  const toml::Value* value = keys.value(key);
  if (!value)
    return keys.default_number(key) ? std::optional(Spectrum::constant(*keys.default_number(key)))
                                    : std::nullopt;
  if (const auto* text = value->as_text()) {
    const auto grey = named_grey(*text);
    if (grey) return Spectrum::constant(*grey);
    keys.problem(key, in_quotes(key) + " is \"" + excerpt(*text) +
                          "\"; a text here names a grey, such as \"grey50\" or \"white80\"");
    return std::nullopt;
  }
  if (const auto* table = value->as_table()) {
    const auto rgb = colour_of(keys, key, *table);
    if (!rgb) return std::nullopt;
    return reflectance_from_linear_srgb((*rgb)[0], (*rgb)[1], (*rgb)[2]);
  }
  if (const auto* list = value->as_list()) {
    const auto rows = rows_of(keys, key, *list);
    return rows ? std::optional(spectrum_through(*rows)) : std::nullopt;
  }
  const auto v = keys.checked(key, *value);
  return v ? std::optional(Spectrum::constant(*v)) : std::nullopt;
}

Spectrum property(KeyReader& keys, std::string_view key) {
  return maybe_property(keys, key).value_or(Spectrum::constant(0));
}

Spectrum emission_shape(KeyReader& keys, std::string_view key) {
  const toml::Value* value = keys.value(key);
  if (value) return spectrum_shape(keys, key, *value).value_or(equal_energy_shape());
  const auto literal = keys.default_text(key);
  if (!literal) return equal_energy_shape();
  return named_shape(keys, key, *literal).value_or(equal_energy_shape());
}

}  // namespace luxodus
