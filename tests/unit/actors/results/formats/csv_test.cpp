#include "actors/results/formats/csv.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "actors/results/formats/json_out.hpp"
#include "runtime/core/output_text.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

using Row = std::vector<std::string>;

/// Parses by RFC 4180, for the round trip.
std::vector<Row> parse_csv(const std::string& text) {
  std::vector<Row> rows;
  Row row;
  std::string cell;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '"' && i + 1 < text.size() && text[i + 1] == '"')
        cell += text[++i];
      else if (c == '"')
        quoted = false;
      else
        cell += c;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',' || c == '\n') {
      row.push_back(std::move(cell));
      cell.clear();
      if (c == '\n') {
        rows.push_back(std::move(row));
        row.clear();
      }
    } else {
      cell += c;
    }
  }
  REQUIRE_FALSE(quoted);
  REQUIRE(row.empty());
  return rows;
}

}  // namespace

TEST_CASE("only cells that need quotes have them", "[format][csv]") {
  CHECK(csv_cell("plain text") == "plain text");
  CHECK(csv_cell("") == "\"\"");
  CHECK(csv_cell("a,b") == "\"a,b\"");
  CHECK(csv_cell("say \"x\"") == "\"say \"\"x\"\"\"");
  CHECK(csv_cell("two\nlines") == "\"two\nlines\"");
  CHECK(csv_cell("cr\r") == "\"cr\r\"");
  CHECK(csv_cell(" space") == "\" space\"");
  CHECK(csv_cell("space ") == "\"space \"");
}

TEST_CASE("a text that a spreadsheet would compute is told to be a text", "[format][csv]") {
  CHECK(csv_cell("=1+1") == "'=1+1");
  CHECK(csv_cell("@SUM(1+1)") == "'@SUM(1+1)");
  CHECK(csv_cell("+1-1") == "'+1-1");
  CHECK(csv_cell("-2+3 <i>") == "'-2+3 <i>");
  CHECK(csv_cell("=HYPERLINK(\"a\",1)") == "\"'=HYPERLINK(\"\"a\"\",1)\"");
  CHECK(csv_cell("\t=1") == "'\t=1");
  CHECK(csv_cell(" =1") == "' =1");
  CHECK(csv_cell("\r=1") == "\"'\r=1\"");
  CHECK(csv_cell("\uff1d1+1") == "'\uff1d1+1");
  for (const char* plain : {"a=1", "-", "+", "-1", "+2.5", "-3.000 1.200 2.970; -1.5e3 0 2", "1+1"})
    CHECK(csv_cell(plain) == plain);
}

TEST_CASE("texts of any kind are read back from a table", "[format][csv]") {
  const std::vector<std::string> texts = {"a,b;c", "\"", "\"\"", ",",  "\n\n", "\r\n",
                                          "ä€😀",   " ",  "",     "-1", "x\ty"};
  CsvTable table({"text", "n"});
  for (const std::string& text : texts) table.cell(text).cell(1).end_row();
  const std::vector<Row> rows = parse_csv(table.text());
  REQUIRE(rows.size() == texts.size() + 1);
  CHECK(rows[0] == Row{"text", "n"});
  for (size_t i = 0; i < texts.size(); ++i) CHECK(rows[i + 1] == Row{texts[i], "1"});
}

TEST_CASE("numbers are read back to the same bits from their shortest form", "[format][csv]") {
  CHECK(shortest_number(0.1) == "0.1");
  CHECK(shortest_number(1.0) == "1");
  CHECK(shortest_number(-0.0) == "-0");
  CHECK(shortest_number(1e300) == "1e+300");
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    char* end = nullptr;
    const std::string text = shortest_number(value);
    REQUIRE(std::bit_cast<uint64_t>(std::strtod(text.c_str(), &end)) ==
            std::bit_cast<uint64_t>(value));
    REQUIRE(*end == '\0');
  }
}

TEST_CASE("NaN and infinity are an empty cell", "[format][csv]") {
  CsvTable table({"a", "b", "c", "d", "e"});
  table.cell(std::nan("")).cell(INFINITY).empty_cell().cell(true).cell(int64_t{1} << 62).end_row();
  CHECK(table.text() == "a,b,c,d,e\n,,,yes,4611686018427387904\n");
}

TEST_CASE("a row with too few or too many cells is a programmer's mistake", "[format][csv]") {
  CHECK_THROWS_AS(CsvTable({}), std::logic_error);
  CsvTable table({"a", "b"});
  table.cell(1);
  CHECK_THROWS_AS(table.end_row(), std::logic_error);
  CHECK_THROWS_AS(table.text(), std::logic_error);
  table.cell(2);
  CHECK_THROWS_AS(table.cell(3), std::logic_error);
  table.end_row();
  const test::TemporaryFolder folder;
  CHECK(write_csv(folder / "t.csv", table).ok());
  CHECK_FALSE(write_csv(folder / "none" / "t.csv", table).ok());
}

TEST_CASE("numbers for people have the requested digits and no more", "[format][text]") {
  CHECK(readable_number(0) == "0");
  CHECK(readable_number(1234.5) == "1230");
  CHECK(readable_number(0.04213) == "0.0421");
  CHECK(readable_number(0.5) == "0.5");
  CHECK(readable_number(9.999) == "10");
  CHECK(readable_number(99999) == "1·10⁵");
  CHECK(readable_number(1.234e6) == "1.23·10⁶");
  CHECK(readable_number(-2.5e-7) == "−2.5·10⁻⁷");
  CHECK(readable_number(std::nan("")) == "no value");
  CHECK(readable_number(12345, 5) == "12345");
}

TEST_CASE("bytes that are not UTF-8 are replaced, and the rest is kept", "[format][text]") {
  const std::string r = "\xEF\xBF\xBD";
  CHECK(clean_utf8("grün € 😀\n\t") == "grün € 😀\n\t");
  CHECK(clean_utf8("a\xff"
                   "b") == "a" + r + "b");
  CHECK(clean_utf8("\xC0\x80") == r + r);                  // overlong
  CHECK(clean_utf8("\xED\xA0\x80") == r + r + r);          // a surrogate
  CHECK(clean_utf8("\xF4\x90\x80\x80") == r + r + r + r);  // above U+10FFFF
  CHECK(clean_utf8("\xE2\x82") == r + r);                  // cut off
  CHECK(clean_utf8("\x01\x7F") == r + r);
  CHECK(xml_escape("<a b=\"c\" & 'd'>") == "&lt;a b=&quot;c&quot; &amp; &apos;d&apos;&gt;");
}

TEST_CASE("JSON keeps the order of keys and never holds NaN or infinity", "[format][json]") {
  Json document = Json::object();
  document["z"] = measured_json(1.5, 0.25, "lx");
  document["a"] = exact_json(INFINITY, "m");
  document["m"] = measured_json(std::nan(""), -INFINITY, "cd/m2");
  document["raw"] = std::nan("");
  document["name"] = "bad \xff byte";
  const std::string text = json_text(document);
  CHECK(text.find("\"z\"") < text.find("\"a\""));
  CHECK(text.find("\"a\"") < text.find("\"m\""));
  CHECK(text.back() == '\n');
  const Json back = Json::parse(text);
  CHECK(back["z"]["value"] == 1.5);
  CHECK(back["z"]["standard_error"] == 0.25);
  CHECK(back["z"]["unit"] == "lx");
  CHECK(back["a"]["value"].is_null());
  CHECK(back["m"]["value"].is_null());
  CHECK(back["m"]["standard_error"].is_null());
  CHECK(back["raw"].is_null());
  CHECK(back["name"] == "bad \xEF\xBF\xBD byte");

  const test::TemporaryFolder folder;
  CHECK(write_json(folder / "a.json", document).ok());
  CHECK_FALSE(write_json(folder / "none" / "a.json", document).ok());
}
