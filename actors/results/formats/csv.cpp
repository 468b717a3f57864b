#include "actors/results/formats/csv.hpp"

#include <cmath>
#include <stdexcept>

#include "runtime/core/output_text.hpp"

namespace luxodus {

std::string csv_cell(std::string_view text) {
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
                             const std::optional<CsvTable>& table) {
  if (table) return write_csv(path, *table);
  std::error_code failed;
  std::filesystem::remove(path, failed);
  if (failed)
    return system_problem(path, "cannot remove what an earlier run has left", failed.value());
  return {};
}

}  // namespace luxodus
