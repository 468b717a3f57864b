// The table reader with a schema of its own: values, defaults, and one message for each mistake.
#include "runtime/toml/table_reader.hpp"

#include "tests/unit/runtime/toml/toml_kit.hpp"

namespace luxodus::toml {
namespace {

using Sentences = std::vector<std::string>;

struct Slip {
  std::string text;
  void (*read)(TableReader&);
  std::string sentence;
};

/// Each text must give exactly the message beside it.
void check(const std::vector<Slip>& slips) {
  for (const Slip& slip : slips) {
    INFO(slip.text);
    CHECK(problems_of(slip.text, slip.read) == Sentences{"dir/lamp.toml:" + slip.sentence});
  }
}

}  // namespace

TEST_CASE("an empty table has the defaults of its schema", "[runtime][toml]") {
  const Document document = parsed("");
  Findings findings;
  TableReader keys(document.top, lamp_schema(), {"lamp", "lamp.long"}, findings);
  CHECK(keys.text("title").empty());
  CHECK(keys.number("height_m") == 2.5);
  CHECK(keys.integer("max_tubes") == 2);
  CHECK(keys.size("cache") == 1024);
  CHECK(keys.flag("lit"));
  CHECK(keys.choice("colour") == "warm");
  CHECK(keys.components<3>("at", "point") == std::array{1.0, 2.0, 3.0});
  CHECK(keys.rows<2>("curve", "pairs", 1).empty());
  CHECK(keys.numbers("levels").empty());
  CHECK(keys.path("plan").empty());
  CHECK(keys.table("mount") == nullptr);
  CHECK(keys.tables("part").empty());
  CHECK(keys.inner("mount", {"mount"}).integer("hooks") == 4);
  CHECK(keys.number("length_m") == 1);
  CHECK_FALSE(findings.any_problem());
  CHECK(keys.clean());
}

TEST_CASE("values are read with the types of the schema", "[runtime][toml]") {
  const Document document = parsed(
      "title = 't'\nheight_m = 3\nmax_tubes = 8\ncache = '2 KB'\nlit = false\ncolour = 'cold'\n"
      "at = [0, 1.5, -2]\ncurve = [[-5, 0.5]]\nlevels = [1, 2.5]\ntags = ['a', 'b']\n"
      "dims = { b = 0, a = 1 }\nsays = { x = 'y' }\nto = ['n']\nlinks = [['n', 'm']]\n"
      "plan = '../plans/a.dxf'\nname = 'l'\n[mount]\nhooks = 1\n[[part]]\n[[part]]\n");
  Findings findings;
  TableReader keys(document.top, lamp_schema(), {"lamp"}, findings);
  CHECK(keys.text("title") == "t");
  CHECK(keys.number("height_m") == 3);
  CHECK(keys.integer("max_tubes") == 8);
  CHECK(keys.size("cache") == 2000);
  CHECK_FALSE(keys.flag("lit"));
  CHECK(keys.choice("colour") == "cold");
  CHECK(keys.components<3>("at", "point") == std::array{0.0, 1.5, -2.0});
  CHECK(keys.rows<2>("curve", "pairs", 1) == std::vector{std::array{-5.0, 0.5}});
  CHECK(keys.numbers("levels") == std::vector{1.0, 2.5});
  CHECK(keys.texts("tags") == Sentences{"a", "b"});
  REQUIRE(keys.factors("dims").size() == 2);
  CHECK(keys.factors("dims")[0].name == "a");
  CHECK(keys.factors("dims")[0].place.line == 11);
  CHECK(keys.words("says").at(0).text == "y");
  CHECK(keys.names("to").at(0).text == "n");
  CHECK(keys.name_pairs("links").at(0).second == "m");
  CHECK(keys.path("plan") == "plans/a.dxf");
  CHECK(keys.inner("mount", {"mount"}).integer("hooks") == 1);
  CHECK(keys.tables("part").size() == 2);
  CHECK(keys.place("lit").line == 5);
  CHECK_FALSE(findings.any_problem());
}

TEST_CASE("a mistake in a key or a single value gives one message that says what is right",
          "[runtime][toml]") {
  check({
      {"heigth_m = 1", [](TableReader& keys) { keys.number("height_m"); },
       "1: unknown key 'heigth_m'; did you mean 'height_m'?"},
      {"max_tube = 1", [](TableReader& keys) { keys.integer("max_tubes"); },
       "1: unknown key 'max_tube'; did you mean 'max_tubes'?"},
      {"\nheight_m = 99", [](TableReader& keys) { CHECK(keys.number("height_m") == 2.5); },
       "2: 'height_m' is 99 but must lie in (0, 10] m; metres? 99 mm is 0.099"},
      {"height_m = inf", [](TableReader& keys) { keys.number("height_m"); },
       "1: 'height_m' must be a finite number, not inf"},
      {"height_m = '1'", [](TableReader& keys) { keys.number("height_m"); },
       "1: 'height_m' must be a number, not a text"},
      {"max_tubes = 1.5", [](TableReader& keys) { CHECK(keys.integer("max_tubes") == 2); },
       "1: 'max_tubes' must be a whole number, not a number"},
      {"cache = 1", [](TableReader& keys) { CHECK(keys.size("cache") == 1024); },
       "1: 'cache' is 1 but must lie in [16, 1e6] B"},
      {"cache = '1 kb'", [](TableReader& keys) { keys.size("cache"); },
       "1: 'cache' must be a number of bytes, or a text such as \"512 MiB\" (KiB, MiB, GiB, TiB, "
       "KB, MB, GB, TB)"},
      {"lit = 1", [](TableReader& keys) { CHECK(keys.flag("lit")); },
       "1: 'lit' must be true or false, not an integer"},
      {"colour = 'wram'", [](TableReader& keys) { CHECK(keys.choice("colour") == "warm"); },
       "1: 'colour' is \"wram\" but must be one of \"warm\", \"cold\"; did you mean \"warm\"?"},
      {"name = 'a/b'", [](TableReader& keys) { CHECK_FALSE(keys.maybe_text("name")); },
       "1: 'name' must be a word without slashes"},
      {"title = 1979-05-27", [](TableReader& keys) { keys.text("title"); },
       "1: 'title' must be a text, not a date or time"},
      {"", [](TableReader& keys) { keys.text("name"); },
       "1: the key 'name' is missing: of the lamp"},
      {"plan = ''", [](TableReader& keys) { keys.path("plan"); },
       "1: 'plan' must name a file or folder"},
      {"plan = 'none.dxf'", [](TableReader& keys) { keys.file("plan"); },
       "1: there is no file 'none.dxf' (looked for dir/none.dxf)"},
      {"lit = true\ntags = []",
       [](TableReader& keys) {
         keys.exactly_one({"lit", "tags"}, true);
       },
       "2: 'tags' and 'lit' say the same thing; keep one of them"},
      {"",
       [](TableReader& keys) {
         keys.exactly_one({"lit", "tags"}, true);
       },
       "1: one of the keys 'lit', 'tags' is needed"},
  });
}

TEST_CASE("a mistake in a list or a table gives one message that says what is right",
          "[runtime][toml]") {
  check({
      {"at = [1, 2]", [](TableReader& keys) { keys.components<3>("at", "point"); },
       "1: 'at' must be a list of 3 numbers, not of 2"},
      {"curve = [\n[1, 2]]", [](TableReader& keys) { keys.rows<2>("curve", "pairs", 1); },
       "2: 'curve' is 2 but must lie in [0, 1]"},
      {"curve = [['x', 1]]", [](TableReader& keys) { keys.rows<2>("curve", "pairs", 1); },
       "1: 'curve' must hold finite numbers, not a text"},
      {"corners = [[1]]", [](TableReader& keys) { keys.rows<2>("corners", "corners", 0); },
       "1: 'corners' must be a list of rows of two numbers"},
      {"tags = ['']", [](TableReader& keys) { CHECK(keys.texts("tags").empty()); },
       "1: 'tags' must be a list of texts that are not empty, not a text"},
      {"dims = { a = 2 }", [](TableReader& keys) { keys.factors("dims"); },
       "1: 'dims' of 'a' is 2 but must lie in [0, 1]"},
      {"links = [['n']]", [](TableReader& keys) { keys.name_pairs("links"); },
       "1: 'links' must be a list of pairs of names"},
      {"part = {}", [](TableReader& keys) { keys.tables("part"); },
       "1: 'part' must be a list of tables, each opened by [[part]] or written { ... }, not a "
       "table"},
      {"part = [{}, {}]", [](TableReader& keys) { CHECK(keys.tables("part", 1).empty()); },
       "1: there are 2 tables 'part'; at most 1 are allowed"},
      {"mount = 3", [](TableReader& keys) { keys.inner("mount", {"mount"}); },
       "1: 'mount' must be a table, not an integer"},
  });
}

TEST_CASE("an unknown key unlike any in the schema is reported with the known ones",
          "[runtime][toml]") {
  const auto found = problems_of("zzzzzzzzz = 1", [](TableReader&) {});
  REQUIRE(found.size() == 1);
  CHECK(found[0].starts_with(
      "dir/lamp.toml:1: unknown key 'zzzzzzzzz'; known here: title name height_m max_tubes"));
}

TEST_CASE("a common angle in radians given as degrees is read with a warning", "[runtime][toml]") {
  const KeySpec turn{"turn_deg", "number", "deg", "0", "[-360, 360]", "", {}};
  const Schema turned{{TableSpec{"lamp", "", {turn}}}};
  const auto warned = [&](const std::string& number) {
    const Document document = parsed("turn_deg = " + number + "\n");
    Findings findings;
    TableReader keys(document.top, turned, {"lamp"}, findings);
    CHECK(keys.number("turn_deg") == std::stod(number));
    CHECK(keys.clean());
    return findings.take_warnings();
  };
  const auto quarter = warned("1.5708");
  REQUIRE(quarter.size() == 1);
  CHECK(quarter[0].text() ==
        "dir/lamp.toml:1: 'turn_deg' is 1.5708 deg, and 1.5708 rad are 90 deg: angles are in "
        "degrees");
  CHECK(warned("-3.14").at(0).what.find("are -180 deg") != std::string::npos);
  for (const char* meant : {"0", "0.5", "1", "1.5", "2", "3", "3.1", "30", "90", "-45", "360"})
    CHECK(warned(meant).empty());
}

TEST_CASE("the kind of a table decides which further keys it has", "[runtime][toml]") {
  const auto kind_of = [](const std::string& text) {
    const Document document = parsed(text);
    return chosen_kind(document.top, lamp_schema(), "lamp", "kind");
  };
  CHECK(kind_of("") == "round");
  CHECK(kind_of("kind = 'long'") == "long");
  CHECK(kind_of("kind = 'square'").empty());
  CHECK(kind_of("kind = 3").empty());
  const auto specs = [](std::string_view kind) {
    return specs_of_kind(lamp_schema(), "lamp", "kind", kind);
  };
  CHECK(specs("long") == Sentences{"lamp", "lamp.long"});
  CHECK(specs("") == Sentences{"lamp", "lamp.round", "lamp.long"});
}

TEST_CASE("a key that the schema lacks is a programming error", "[runtime][toml]") {
  const Document document = parsed("");
  Findings findings;
  TableReader keys(document.top, lamp_schema(), {"lamp"}, findings);
  CHECK_THROWS_AS(keys.number("colour"), std::logic_error);
  CHECK_THROWS_AS(keys.number("weight_kg"), std::logic_error);
  CHECK_THROWS_AS(keys.text("kind"), std::logic_error);
  CHECK_THROWS_AS(TableReader(document.top, lamp_schema(), {"lmap"}, findings), std::logic_error);
}

TEST_CASE("problems are reported once, by file and line, and their number is bounded",
          "[runtime][toml]") {
  Findings findings;
  findings.problem({"b.toml", 9}, "late");
  findings.problem({"b.toml", 2}, "early");
  findings.problem({"a.toml", 1}, "in another file");
  findings.problem({"b.toml", 2}, "early");
  const Problems few = findings.take_problems();
  REQUIRE(few.list().size() == 3);
  CHECK(few.list()[0].what == "early");
  CHECK(few.list()[2].where.file == "a.toml");
  Findings many;
  for (int i = 0; i < 5000; ++i) many.problem({"a.toml", i}, "wrong");
  const Problems all = many.take_problems();
  CHECK(all.list().size() == limits::toml_problems + 1);
  CHECK(all.list().back().what == "more problems follow; the first 1000 are shown");
}

}  // namespace luxodus::toml
