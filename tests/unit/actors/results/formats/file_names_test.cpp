#include "actors/results/formats/file_names.hpp"

#include <array>
#include <catch2/catch.hpp>

using namespace luxodus;

TEST_CASE("a file name has no characters that are special to a shell or another system",
          "[format][names]") {
  CHECK(file_name_of("before the sign") == "before_the_sign");
  CHECK(file_name_of("Flur 1/2 (\"Nord\")") == "Flur_1_2___Nord__");
  CHECK(file_name_of("büro") == "büro");
  CHECK(file_name_of("-rf") == "_rf");
  CHECK(file_name_of("..") == "_.");
  CHECK(file_name_of("a\nb\x1b") == "a_b_");
  CHECK(file_name_of("") == "_");
  CHECK(file_name_of("plain-Name_1.2") == "plain-Name_1.2");
}

TEST_CASE("no two things have a file of the same name, whatever its ending", "[format][names]") {
  constexpr std::array endings{".png", "_human.png"};
  const std::vector<std::string> names{"a b", "a_b", "A B", "door", "door human", "door_human-2"};
  CHECK(file_names_of(names, endings) == std::vector<std::string>{"a_b", "a_b-2", "A_B-3", "door",
                                                                  "door_human-2",
                                                                  "door_human-2-2"});
}
