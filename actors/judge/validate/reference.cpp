#include "actors/judge/validate/reference.hpp"

#include <sstream>

#include "actors/judge/validate/reference_files.hpp"
#include "runtime/core/check.hpp"

namespace luxodus::light {

namespace {

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      out.emplace_back();
    } else if (c != '\r') {
      out.back() += c;
    }
  }
  return out;
}

}  // namespace

const std::string& Row::text(const std::string& column) const {
  const auto at = cells_.find(column);
  LUX_CHECK(at != cells_.end(), ("a reference table has no column " + column).c_str());
  return at->second;
}

double Row::number(const std::string& column) const {
  return std::stod(text(column));
}

std::vector<double> Row::numbers(const std::string& column) const {
  std::vector<double> out;
  for (const std::string& word : split(text(column), ';')) out.push_back(std::stod(word));
  return out;
}

std::vector<Row> reference_table(const std::string& file) {
  const std::string text(reference_file(file));
  LUX_CHECK(!text.empty(), ("there is no reference table " + file).c_str());
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> columns = split(line, ',');
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    if (line.empty()) continue;
    const std::vector<std::string> words = split(line, ',');
    LUX_CHECK(words.size() <= columns.size(), ("a row of " + file + " is too long").c_str());
    std::map<std::string, std::string> cells;
    for (size_t i = 0; i < words.size(); ++i) cells[columns[i]] = words[i];
    rows.emplace_back(std::move(cells));
  }
  return rows;
}

std::vector<Row> rows_where(const std::string& file, const std::string& column,
                            const std::string& text) {
  std::vector<Row> rows = reference_table(file);
  std::erase_if(rows, [&](const Row& row) { return row.text(column) != text; });
  LUX_CHECK(!rows.empty(), (file + " has no row with " + column + " " + text).c_str());
  return rows;
}

double exact(const std::string& id, const std::string& parameters) {
  for (const Row& row : rows_where("misc_exact.csv", "id", id)) {
    if (row.text("parameters") == parameters) return row.number("value");
  }
  end_by_mistake(__FILE__, __LINE__, ("no exact value " + id + " " + parameters).c_str());
}

double parameter(const std::string& text, const std::string& key) {
  for (const std::string& word : split(text, ';')) {
    if (word.rfind(key + "=", 0) == 0) return std::stod(word.substr(key.size() + 1));
  }
  end_by_mistake(__FILE__, __LINE__, ("no " + key + " in " + text).c_str());
}

}  // namespace luxodus::light
