// An issue's identifiers follow from its scene, rule and subject: a second assessment of the same
// scene updates the issues of the first in a program, and equal assessments give equal bytes.
#include "actors/judge/assess/bcf_issues.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "actors/judge/texts/remark_json.hpp"
#include "actors/results/formats/stored_zip.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/output_text.hpp"
#include "scenes/emergency/remark.hpp"

namespace luxodus {

namespace {

constexpr size_t ifc_guid_length = 22;
/// A camera stands this far from what it shows, at the height of an eye above a floor [m].
constexpr double camera_distance_m = 2.5, camera_height_m = 1.6;
constexpr double field_of_view_deg = 60;
/// The height over a floor within which a place is in an area [m].
constexpr double storey_m = 1.5;

/// A UUID in the form of version 8 (RFC 9562), made of hashes.
std::string uuid_of(std::string_view text) {
  uint64_t words[2];
  for (uint64_t i = 0; i < 2; ++i) {
    Hasher hasher;
    hasher.add(i);
    hasher.add(text);
    words[i] = hasher.value();
  }
  return fmt::format("{:08x}-{:04x}-8{:03x}-{:04x}-{:012x}", words[0] >> 32,
                     words[0] >> 16 & 0xffff, words[0] & 0xfff, 0x8000 | (words[1] >> 48 & 0x3fff),
                     words[1] & 0xffffffffffff);
}

bool is_ifc_guid(const std::string& text) {
  return text.size() == ifc_guid_length && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                  c == '_' || c == '$';
         });
}

glm::dvec3 point_in(const Json& json) {
  glm::dvec3 out(0);
  if (json.is_array() && json.size() == 3)
    for (size_t i = 0; i < 3; ++i)
      if (json[i].is_number()) out[static_cast<glm::length_t>(i)] = json[i].get<double>();
  return out;
}

/// What an issue is about: where it is, and its GlobalId.
struct IssueSubject {
  std::string guid;
  std::optional<glm::dvec3> place;
  std::optional<glm::dvec3> front;  // direction from which it is seen
};

const Json* row_named(const Json& rows, const std::string& name) {
  for (const Json& row : rows)
    if (text_in(row, "name") == name) return &row;
  return nullptr;
}

bool is_inside(const Json& outline, const glm::dvec3& p) {
  bool inside = false;
  for (size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const double ax = outline[i][0].get<double>(), ay = outline[i][1].get<double>();
    const double bx = outline[j][0].get<double>(), by = outline[j][1].get<double>();
    if ((ay > p.y) != (by > p.y) && p.x < (bx - ax) * (p.y - ay) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}

glm::dvec3 middle_of(const Json& area) {
  glm::dvec3 sum(0);
  for (const Json& corner : area["outline"])
    sum += glm::dvec3(corner[0].get<double>(), corner[1].get<double>(), 0);
  const double n = std::max<double>(1, static_cast<double>(area["outline"].size()));
  return glm::dvec3(sum.x / n, sum.y / n, area["z"].get<double>());
}

/// The area, with a GlobalId, over which a place is.
const Json* area_at(const Json& areas, const glm::dvec3& place) {
  for (const Json& area : areas) {
    const double above = place.z - area["z"].get<double>();
    if (is_ifc_guid(text_in(area, "ifc_guid")) && above > -0.1 && above < storey_m &&
        is_inside(area["outline"], place))
      return &area;
  }
  return nullptr;
}

IssueSubject subject_of(const Json& a, const Json& check) {
  const std::string kind = text_in(check["subject"], "kind"),
                    name = text_in(check["subject"], "name");
  IssueSubject out;
  const Json* row = nullptr;
  if (kind == name_of(SubjectKind::luminaire)) row = row_named(a["luminaires"], name);
  if (kind == name_of(SubjectKind::sign)) row = row_named(a["signs"], name);
  if (kind == name_of(SubjectKind::emphasis)) row = row_named(a["places"]["emphasis"], name);
  if (row != nullptr) {
    out.guid = text_in(*row, "ifc_guid");
    out.place = point_in((*row)["position"]);
    if (row->contains("facing")) out.front = point_in((*row)["facing"]);
  }
  if (kind == name_of(SubjectKind::open_area) || kind == name_of(SubjectKind::task_area))
    if (const Json* area = row_named(a["places"]["areas"], name)) {
      out.guid = text_in(*area, "ifc_guid");
      out.place = middle_of(*area);
    }
  if (kind == name_of(SubjectKind::route))
    if (const Json* route = row_named(a["places"]["routes"], name);
        route && !(*route)["path"].empty())
      out.place = point_in((*route)["path"][0]);
  if (check.contains("worst_place")) out.place = point_in(check["worst_place"]);
  if (out.guid.empty() && out.place)
    if (const Json* area = area_at(a["places"]["areas"], *out.place))
      out.guid = text_in(*area, "ifc_guid");
  return out;
}

/// Where the camera stands: in front of a sign; above the floor beside another place, on the side
/// of the middle of its area.
glm::dvec3 eye_for(const Json& a, const IssueSubject& subject) {
  const glm::dvec3 at = *subject.place;
  if (subject.front) return at + camera_distance_m * *subject.front;
  const Json* area = area_at(a["places"]["areas"], at);
  glm::dvec3 way(1, 0, 0);
  double far = camera_distance_m;
  if (area != nullptr) {
    glm::dvec3 to_middle = middle_of(*area) - at;
    to_middle.z = 0;
    if (glm::length(to_middle) > 0.1) {
      way = glm::normalize(to_middle);
      far = std::min(far, 2 * glm::length(to_middle));
    } else {
      far = 1;
    }
  }
  const double floor = area != nullptr ? (*area)["z"].get<double>() : at.z;
  const bool overhead = at.z > floor + camera_height_m;
  return glm::dvec3(at + far * way) + glm::dvec3(0, 0, overhead ? -1 : camera_height_m);
}

std::string vector_xml(const char* name, const glm::dvec3& v) {
  return fmt::format("<{0}><X>{1:.9g}</X><Y>{2:.9g}</Y><Z>{3:.9g}</Z></{0}>", name, v.x, v.y, v.z);
}

std::string camera_xml(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 way = glm::normalize(target - eye);
  const glm::dvec3 aside = glm::cross(way, glm::dvec3(0, 0, 1));
  const glm::dvec3 up =
      glm::length(aside) > 1e-6 ? glm::cross(glm::normalize(aside), way) : glm::dvec3(0, 1, 0);
  return "<PerspectiveCamera>" + vector_xml("CameraViewPoint", eye) +
         vector_xml("CameraDirection", way) + vector_xml("CameraUpVector", up) +
         fmt::format("<FieldOfView>{:g}</FieldOfView></PerspectiveCamera>", field_of_view_deg);
}

constexpr const char* xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

std::string viewpoint_xml(const Json& a, const IssueSubject& subject, const std::string& uuid) {
  std::string out = xml_head;
  out += "<VisualizationInfo Guid=\"" + uuid + "\"><Components>";
  if (is_ifc_guid(subject.guid))
    out += "<Selection><Component IfcGuid=\"" + subject.guid + "\"/></Selection>";
  out += "<Visibility DefaultVisibility=\"true\"/></Components>";
  if (subject.place) out += camera_xml(eye_for(a, subject), *subject.place);
  return out + "</VisualizationInfo>\n";
}

/// "2026-05-31T00:00:00Z" of the project's date, if that is one; else the first day of the epoch,
/// since an assessment knows no clock.
std::string date_of(const Json& a) {
  const std::string date = text_in(a["project"], "date");
  const bool is_date = date.size() == 10 && date[4] == '-' && date[7] == '-' &&
                       std::all_of(date.begin(), date.end(),
                                   [](char c) { return c == '-' || (c >= '0' && c <= '9'); });
  return (is_date ? date : "1970-01-01") + "T00:00:00Z";
}

std::string title_of(const Json& check) {
  return text_in(check, "rule") + ", " + text_in(check, "edition") + ": " +
         text_in(check["subject"], "text") + ": " + text_in(check, "title");
}

std::string description_of(const Json& check) {
  std::string out = text_in(check, "title") + " (" + text_in(check, "clause") + ").";
  const Json value = check.value("value", Json()), limit = check.value("limit", Json());
  const std::string unit = text_in(check, "unit");
  if (value.is_number()) out += fmt::format(" Found: {:.4g} {}.", value.get<double>(), unit);
  if (limit.is_number())
    out +=
        fmt::format(" Demanded: {} {:.4g} {}.", text_in(check, "sense"), limit.get<double>(), unit);
  for (const char* key : {"conditions", "reasons"})
    if (const std::string words = english_in(check, key); !words.empty()) out += " " + words + ".";
  return out;
}

std::string markup_xml(const Json& a, const Json& check, const std::string& topic,
                       const std::string& viewpoint, size_t index) {
  const std::string author = text_in(a["project"], "author");
  return xml_head + fmt::format(
                        "<Markup><Topic Guid=\"{}\" TopicType=\"Issue\" TopicStatus=\"Open\">"
                        "<Title>{}</Title><Index>{}</Index><Labels>Emergency lighting</Labels>"
                        "<CreationDate>{}</CreationDate><CreationAuthor>{}</CreationAuthor>"
                        "<Description>{}</Description></Topic><Viewpoints Guid=\"{}\">"
                        "<Viewpoint>viewpoint.bcfv</Viewpoint></Viewpoints></Markup>\n",
                        topic, xml_escape(title_of(check)), index, date_of(a),
                        xml_escape(author.empty() ? "Luxodus" : author),
                        xml_escape(description_of(check)), viewpoint);
}

bool has_guids(const Json& a) {
  const auto any = [](const Json& rows) {
    return std::any_of(rows.begin(), rows.end(),
                       [](const Json& row) { return !text_in(row, "ifc_guid").empty(); });
  };
  return any(a["luminaires"]) || any(a["signs"]) || any(a["places"]["areas"]);
}

}  // namespace

std::optional<std::string> bcf_issues(const Json& assessment) {
  if (!has_guids(assessment)) return std::nullopt;
  std::vector<std::pair<std::string, std::string>> files{
      {"bcf.version", std::string(xml_head) +
                          "<Version VersionId=\"2.1\"><DetailedVersion>2.1</DetailedVersion>"
                          "</Version>\n"}};
  size_t index = 0;
  for (const Json& check : assessment["checks"]) {
    if (text_in(check, "verdict") != "fail" || index >= limits::bcf_issues) continue;
    const std::string key = text_in(assessment["scene"], "name") + "\n" +
                            text_in(check, "rule_set") + "\n" + title_of(check) + "\n" +
                            english_in(check, "conditions");
    const std::string topic = uuid_of("topic\n" + key), viewpoint = uuid_of("viewpoint\n" + key);
    const std::string folder = topic + "/";
    if (std::any_of(files.begin(), files.end(),
                    [&](const auto& file) { return file.first == folder + "markup.bcf"; }))
      continue;
    ++index;
    files.emplace_back(folder + "markup.bcf",
                       markup_xml(assessment, check, topic, viewpoint, index));
    files.emplace_back(folder + "viewpoint.bcfv",
                       viewpoint_xml(assessment, subject_of(assessment, check), viewpoint));
  }
  if (index == 0) return std::nullopt;
  return stored_zip(files);
}

}  // namespace luxodus
