#include "scenes/formats/fds_input/group_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "runtime/core/printable.hpp"

namespace luxodus::fds_input {

namespace {

/// A text as FDS reads it: a doubled quote is one quote, trailing blanks do not count.
std::string plain(const Value& value) {
  std::string out;
  for (size_t i = 0; i < value.text.size(); ++i) {
    const char c = value.text[i];
    out += c;
    const bool doubled = value.quoted && (c == '\'' || c == '"') && i + 1 < value.text.size() &&
                         value.text[i + 1] == c;
    if (doubled) ++i;
  }
  while (!out.empty() && (out.back() == ' ' || out.back() == '\t')) out.pop_back();
  return out;
}

bool is_null(const Value& value) {
  return value.text.empty() && !value.quoted;
}

/// Reads "1.", ".5", "+2", "1.5D3".
std::optional<double> fortran_number(std::string_view text) {
  std::string plain_text(text.substr(0, 64));
  if (text.size() > plain_text.size()) return std::nullopt;
  if (!plain_text.empty() && plain_text.front() == '+') plain_text.erase(0, 1);
  for (char& c : plain_text)
    if (c == 'd' || c == 'D') c = 'e';
  double value = 0;
  const char* const last = plain_text.data() + plain_text.size();
  const auto [end, error] = std::from_chars(plain_text.data(), last, value);
  if (error != std::errc() || end != last) return std::nullopt;
  return value;
}

}  // namespace

const Parameter* GroupKeys::last(std::string_view key) const {
  const auto& all = group_.parameters;
  const auto at =
      std::find_if(all.rbegin(), all.rend(), [&](const Parameter& p) { return p.name == key; });
  return at == all.rend() ? nullptr : &*at;
}

bool GroupKeys::has(std::string_view key) const {
  return last(key) != nullptr;
}

int GroupKeys::line_of(std::string_view key) const {
  const Parameter* parameter = last(key);
  return parameter != nullptr ? parameter->line : group_.line;
}

void GroupKeys::fail(std::string_view key, const std::string& what) {
  if (!problem_) problem_ = problem_in(file_, line_of(key), what);
}

void GroupKeys::refuse(std::string_view key, const std::string& what_to_do) {
  if (has(key)) fail(key, fmt::format("{} of &{} is not imported: {}", key, name(), what_to_do));
}

std::string GroupKeys::text(std::string_view key, const std::string& otherwise) {
  const Parameter* parameter = last(key);
  if (parameter == nullptr) return otherwise;
  if (!parameter->values.empty() && is_null(parameter->values.front())) return otherwise;
  if (parameter->values.empty() || !parameter->values.front().quoted) {
    fail(key, fmt::format("{} of &{} is no text in quotes", key, name()));
    return otherwise;
  }
  return plain(parameter->values.front());
}

std::vector<std::string> GroupKeys::texts(std::string_view key) {
  std::vector<std::string> out;
  constexpr size_t most = 1000;
  for (const Parameter& parameter : group_.parameters) {
    if (parameter.name != key) continue;
    for (size_t i = 0; i < parameter.values.size(); ++i) {
      const auto place = static_cast<size_t>(std::max(parameter.first, 1)) - 1 + i;
      if (is_null(parameter.values[i])) continue;
      if (!parameter.values[i].quoted || place >= most) {
        fail(key,
             fmt::format("{} of &{} is no list of at most {} texts in quotes", key, name(), most));
        return {};
      }
      if (place >= out.size()) out.resize(place + 1);
      out[place] = plain(parameter.values[i]);
    }
  }
  return out;
}

bool GroupKeys::flag(std::string_view key, bool otherwise) {
  const Parameter* parameter = last(key);
  if (parameter == nullptr) return otherwise;
  if (!parameter->values.empty() && is_null(parameter->values.front())) return otherwise;
  std::string_view word =
      parameter->values.empty() ? std::string_view() : parameter->values.front().text;
  if (!word.empty() && word.front() == '.') word.remove_prefix(1);
  const char c = word.empty() ? ' ' : word.front();
  if (c == 'T' || c == 't') return true;
  if (c == 'F' || c == 'f') return false;
  fail(key, fmt::format("{} of &{} is neither T nor F", key, name()));
  return otherwise;
}

std::optional<double> GroupKeys::number_of(std::string_view key, const Value& value) {
  const auto number = value.quoted ? std::nullopt : fortran_number(value.text);
  if (number && std::isfinite(*number)) return number;
  if (!problem_)
    problem_ =
        problem_in(file_, value.line > 0 ? value.line : line_of(key),
                   fmt::format("{} of &{} is no number: \"{}\"", key, name(), excerpt(value.text)));
  return std::nullopt;
}

double GroupKeys::number(std::string_view key, double otherwise) {
  return array(key, {otherwise}).front();
}

int GroupKeys::integer(std::string_view key, int otherwise) {
  const double value = number(key, otherwise);
  constexpr double most = 1e9;
  if (std::abs(value) <= most && value == std::round(value)) return static_cast<int>(value);
  fail(key, fmt::format("{} of &{} is no whole number", key, name()));
  return otherwise;
}

std::vector<double> GroupKeys::numbers(std::string_view key) {
  const Parameter* parameter = last(key);
  std::vector<double> out;
  if (parameter == nullptr) return out;
  out.reserve(parameter->values.size());
  for (size_t i = 0; i < parameter->values.size(); ++i) {
    const Value& value = parameter->values[i];
    // A comma behind the last number.
    if (is_null(value) && i + 1 == parameter->values.size()) break;
    const auto number = number_of(key, value);
    if (!number) return {};
    out.push_back(*number);
  }
  return out;
}

std::vector<double> GroupKeys::array(std::string_view key, std::vector<double> otherwise) {
  std::vector<double> out = otherwise;
  for (const Parameter& parameter : group_.parameters) {
    if (parameter.name != key) continue;
    for (size_t i = 0; i < parameter.values.size(); ++i) {
      if (is_null(parameter.values[i])) continue;
      const int64_t place = int64_t{parameter.first} - 1 + static_cast<int64_t>(i);
      if (place < 0 || place >= static_cast<int64_t>(out.size())) {
        fail(key, fmt::format("{} of &{} has more than {} numbers", key, name(), out.size()));
        return otherwise;
      }
      const auto number = number_of(key, parameter.values[i]);
      if (!number) return otherwise;
      out[static_cast<size_t>(place)] = *number;
    }
  }
  return out;
}

std::optional<Box> GroupKeys::box(std::string_view key) {
  if (!has(key)) return std::nullopt;
  const double none = 2 * limits::farthest_m;
  const std::vector<double> xb = array(key, std::vector<double>(6, none));
  Box out;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = 2 * static_cast<size_t>(axis);
    if (!(std::abs(xb[i]) <= limits::farthest_m && std::abs(xb[i + 1]) <= limits::farthest_m)) {
      fail(key, fmt::format("{} of &{} is not six coordinates within {:g} m", key, name(),
                            limits::farthest_m));
      return std::nullopt;
    }
    out.low[axis] = std::min(xb[i], xb[i + 1]);
    out.high[axis] = std::max(xb[i], xb[i + 1]);
  }
  return out;
}

std::optional<glm::dvec3> GroupKeys::rgb(std::string_view key) {
  if (!has(key)) return std::nullopt;
  const std::vector<double> values = array(key, {-1, -1, -1});
  const glm::dvec3 out(values[0], values[1], values[2]);
  // FDS takes a colour with unset components as no colour.
  if (glm::any(glm::lessThan(out, glm::dvec3(0)))) return std::nullopt;
  return glm::min(out, 255.0) / 255.0;
}

}  // namespace luxodus::fds_input
