// The record of people who were followed: written and read back, and damaged.
#include "actors/judge/record/people_record.hpp"

#include <catch2/catch.hpp>

#include "tests/kit/followed_people.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("followed people are read as they were written", "[record]") {
  const TemporaryFolder folder;
  const Json written = followed_people_json(two_followed());
  REQUIRE(write_json(folder / "walk.json", written));
  const auto read = read_followed_people(folder / "walk.json");
  INFO((read ? "" : read.problem().text()));
  REQUIRE(read);
  CHECK(followed_people_json(read.value()) == written);
  CHECK(written["people"][1]["first_read_s"].is_null());
  CHECK(written["curve"][1]["reading_share"].is_null());
  CHECK(written["curve"][0]["reading_share"] == 0.5);
}

TEST_CASE("the totals of followed people count each of them once", "[record]") {
  const PeopleTotals totals = totals_of(two_followed().people);
  CHECK(totals.all_s == 14);
  CHECK(totals.read_s == 4);
  CHECK(totals.undecided_s == 2);
  CHECK(totals.unread_s() == 8);
  CHECK(totals.longest_unread_s == 7);
  CHECK(totals.never == 1);
}

TEST_CASE("a damaged record of followed people is refused with its place", "[record][failure]") {
  const TemporaryFolder folder;
  const std::string text = followed_people_json(two_followed()).dump();
  const auto refuses = [&](const std::string& from, const std::string& to, const std::string& why) {
    const auto read = read_followed_people(folder.write("walk.json", replaced(text, from, to)));
    REQUIRE_FALSE(read);
    CHECK_THAT(read.problem().text(), Catch::Contains("walk.json") && Catch::Contains(why));
  };
  refuses("luxodus walk 1", "luxodus walk 7", "make it anew by luxodus walk");
  refuses("\"cell_m\"", "\"cells\"", "has no \"cell_m\"");
  refuses("\"signs_read\":0", "\"signs_read\":-1", "people[1].signs_read");
  refuses("\"in_view_s\":12.0", "\"in_view_s\":\"12\"", "signs[0].in_view_s");
  CHECK_FALSE(read_followed_people(folder.write("walk.json", text.substr(0, 100))));
  CHECK_FALSE(read_followed_people(folder / "missing.json"));
}
