#include "runtime/toml/text_scan.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

std::string repeated(const std::string& part, size_t times) {
  std::string out;
  for (size_t i = 0; i < times; ++i) out += part;
  return out;
}

/// The line that is rejected, 0 if none is.
int refused_line(const std::string& text) {
  const auto ok = toml::check_nesting(text, "deep.toml");
  return ok ? 0 : ok.problem().where.line;
}

/// A key with this many dots.
std::string key(size_t dots) {
  return repeated("a.", dots) + "a";
}

std::string list(size_t brackets) {
  return "x = " + repeated("[", brackets) + repeated("]", brackets) + "\n";
}

}  // namespace

TEST_CASE("keys and brackets nest up to the limit and no deeper, and the line is reported",
          "[runtime][toml]") {
  const size_t most = limits::toml_nesting;
  CHECK(refused_line(key(most) + " = 1\n" + list(most)) == 0);
  CHECK(refused_line("x = 1\n\n" + key(most + 1) + " = 1\n") == 3);
  CHECK(refused_line("x = 1\r\n[" + key(most + 1) + "]\n") == 2);
  CHECK(refused_line("[[" + key(most + 1) + "]]\n") == 1);
  CHECK(refused_line("x = { y = 1, " + key(most + 1) + " = 1 }\n") == 1);
  CHECK(refused_line(repeated("'a' . \"b\" . ", most) + "a = 1\n") == 1);
  CHECK(refused_line(list(most + 1)) == 1);
  CHECK(refused_line("x = " + repeated("{a=", most + 1)) == 1);
}

TEST_CASE("long lists of fractions and many keys do not count as depth", "[runtime][toml]") {
  CHECK(refused_line("x = [" + repeated("1.5, ", 1000) + "]\n") == 0);
  CHECK(refused_line("x = [" + repeated("[1.5, 2.5], ", 1000) + "]\n") == 0);
  CHECK(refused_line(repeated("[[t]]\na.b = 1.5\n", 1000)) == 0);
}

TEST_CASE("strings and comments do not count, and what follows them does", "[runtime][toml]") {
  const std::string noise = repeated(".", 99) + repeated("[", 99);
  for (const std::string& quiet : {
           "# " + noise + " \" ' \"\"\"\n",
           "x = \"\\\"" + noise + "\\\\\"\n",
           "x = '" + noise + "\\'\n",
           "x = \"\"\"" + noise + "\\\"\"\" \"\"\"\"\"\n",
           "x = '''" + noise + "\n''" + noise + "'''''\n",
           std::string("x = \"\"\ny = ''\nz = \"\"\"\"\"\"\n"),
           "x = 'not closed " + noise + "\n",
       }) {
    INFO(quiet);
    CHECK(refused_line(quiet) == 0);
    CHECK(refused_line(quiet + key(limits::toml_nesting + 1) + " = 1\n") > 0);
  }
  CHECK(refused_line("x = \"\"\" never closed " + noise) == 0);
  CHECK(refused_line("\"\\") == 0);
}

TEST_CASE("a text rewritten with the oldest names equals the text that used them",
          "[runtime][toml]") {
  const toml::Schema schema{{{"t",
                              "`[t]`",
                              {{"max_bands", "integer", "", "8", "", "m", "bands_most"},
                               {"width_m", "number", "m", "1", "", "m", "w"},
                               {"name", "text", "", "", "", "m"}}}}};
  const auto old = [&](std::string_view text) { return toml::with_earlier_names(text, schema); };
  CHECK(old("max_bands = 3 # max_bands\n") == "bands_most = 3 # max_bands\n");
  CHECK(old("t.max_bands=3\r\n[t]\n") == "t.bands_most=3\r\n[t]\n");
  CHECK(old("x = [{ name = \"max_bands\", width_m = 1 }, {width_m=2}]") ==
        "x = [{ name = \"max_bands\", w = 1 }, {w=2}]");
  CHECK(old("max_bands_2 = 1\nnot-max_bands = 1\n") == "max_bands_2 = 1\nnot-max_bands = 1\n");
  CHECK(old("x = '''max_bands\n''' \xc3\xa9 width_m") == "x = '''max_bands\n''' \xc3\xa9 w");
  CHECK(old("").empty());
}
