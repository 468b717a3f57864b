#include "actors/results/formats/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// Whether a text is numbers, separated by spaces or semicolons, such as coordinates.
bool is_numbers(std::string_view text) {
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of(" ;"), text.size());
    std::string_view word = text.substr(0, end);
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0;
    const auto [behind, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (!word.empty() && (failed != std::errc() || behind != word.data() + word.size()))
      return false;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return true;
}

/// Whether a spreadsheet that opens the file would compute this text: one that begins, after white
/// space, with a sign of a formula. The signs of full width do so in Japanese versions.
bool would_be_computed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const std::string_view begin = text.substr(first);
  if (begin.size() > 1 && std::string_view("=+-@").find(begin.front()) != std::string_view::npos)
    return !is_numbers(begin);
  for (const std::string_view wide : {"\uff1d", "\uff0b", "\uff0d", "\uff20"})
    if (begin.starts_with(wide)) return true;
  return false;
}

}  // namespace

std::string csv_cell(std::string_view text) {
  if (would_be_computed(text)) return csv_cell("'" + std::string(text));
  const bool plain = !text.empty() && text.find_first_of(",\"\r\n") == std::string_view::npos &&
                     text.front() != ' ' && text.back() != ' ';
  if (plain) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

CsvTable::CsvTable(const std::vector<std::string>& columns) : columns_(columns.size()) {
  if (columns.empty()) throw std::logic_error("a CSV table needs at least one column");
  for (const std::string& column : columns) cell(std::string_view(column));
  end_row();
}

void CsvTable::separate() {
  if (cells_ == columns_) throw std::logic_error("more CSV cells in a row than columns");
  if (cells_++ > 0) text_ += ',';
}

CsvTable& CsvTable::cell(std::string_view text) {
  separate();
  text_ += csv_cell(text);
  return *this;
}

CsvTable& CsvTable::cell(double value) {
  separate();
  if (std::isfinite(value)) text_ += shortest_number(value);
  return *this;
}

CsvTable& CsvTable::cell(int64_t value) {
  separate();
  text_ += std::to_string(value);
  return *this;
}

CsvTable& CsvTable::empty_cell() {
  separate();
  return *this;
}

void CsvTable::end_row() {
  if (cells_ != columns_) throw std::logic_error("fewer CSV cells in a row than columns");
  text_ += '\n';
  cells_ = 0;
}

const std::string& CsvTable::text() const {
  if (cells_ != 0) throw std::logic_error("a CSV row was begun and not ended");
  return text_;
}

Result<void> write_csv(const std::filesystem::path& path, const CsvTable& table) {
  return write_file_atomically(path, std::string_view(table.text()));
}

Result<void> write_or_remove(const std::filesystem::path& path,
                             const std::optional<std::string>& bytes) {
  if (bytes) return write_file_atomically(path, std::string_view(*bytes));
  std::error_code failed;
  std::filesystem::remove(path, failed);
  if (failed)
    return system_problem(path, "cannot remove what an earlier run has left", failed.value());
  return {};
}

Result<void> write_or_remove(const std::filesystem::path& path,
                             const std::optional<CsvTable>& table) {
  return write_or_remove(path, table ? std::optional(table->text()) : std::nullopt);
}

}  // namespace luxodus
