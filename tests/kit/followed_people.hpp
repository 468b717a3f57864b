// Two people who were followed, for tests of their record and its report. Pure; any thread.
#pragma once

#include "actors/judge/record/people_record.hpp"

namespace luxodus::test {

inline FollowedPerson followed(const std::string& group, int64_t id, double from_s) {
  FollowedPerson out;
  out.group = group;
  out.id = id;
  out.from_s = from_s;
  out.to_s = from_s + 6;
  return out;
}

/// One reads the sign "exit" for 4 of 7 s; the other reads none for 7 s.
inline FollowedPeople two_followed() {
  FollowedPeople out;
  out.program = "1";
  out.scene = "room";
  out.scenario = "failed";
  out.states_s = {0, 30};
  out.forms = {"text of PeTrack"};
  out.step_s = 1;
  out.field_of_view_deg = 120;
  out.cell_m = 0.5;
  FollowedPerson reads = followed("guests", 7, 0);
  reads.read_s = 4;
  reads.undecided_s = 2;
  reads.unread_s = 1;
  reads.longest_unread_s = 3;
  reads.first_read_s = 0;
  reads.last_read_s = 3;
  reads.signs_read = 1;
  FollowedPerson blind = followed("guests <late>", 8, 20);
  blind.unread_s = blind.longest_unread_s = 7;
  blind.mean_extinction = 1.25;
  out.people = {reads, blind};
  PassedSign sign;
  sign.name = "exit";
  sign.in_view_s = 12;
  sign.read_s = 4;
  sign.hidden_s = 8;
  sign.hidden_by_people_s = 3;
  sign.readers = 1;
  out.signs = {sign};
  out.curve = {{0, 2, 1, 0}, {10, 0, 0, 0}, {20, 1, 0, 0}};
  out.floors = {{0, {{{1, 1}, 0}, {{1.5, 1}, 8}}}};
  return out;
}

}  // namespace luxodus::test
