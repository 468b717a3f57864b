// An issue's identifiers follow from the ids of its rule, subject and conditions, not from the
// sentences about them: a second assessment of the same scene, in whatever words, updates the
// issues of the first in a program, and equal assessments give equal bytes.
#include "actors/judge/assess/bcf_issues.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <vector>

#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/stored_zip.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/output_text.hpp"
#include "scenes/emergency/remark.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

constexpr size_t ifc_guid_length = 22;
/// A camera stands this far from what it shows, at the height of an eye above a floor [m].
constexpr double camera_distance_m = 2.5, camera_height_m = 1.6;
constexpr double field_of_view_deg = 60;
/// A place up to this far below the floor of an area is still over it [m].
constexpr double sunk_m = 0.1;

/// Adds what distinguishes a check from the others of its scene. A condition counts by its id and
/// by the time after the failure. Other arguments, such as the luminaire whose failure is the
/// worst, are results, which change while the issue remains.
void add_identity(Hasher& hasher, const Check& check) {
  hasher.add(check.rule.set);
  hasher.add(check.rule.deviation);
  hasher.add(name_of(check.rule.id));
  hasher.add(name_of(check.subject.kind));
  hasher.add(check.subject.name);
  const bool emphasis = check.subject.kind == SubjectKind::emphasis;
  hasher.add(emphasis ? emphasis_words.at(static_cast<size_t>(check.subject.emphasis)) : "");
  for (const Remark& condition : check.conditions) {
    hasher.add(kind_of(condition.id).name);
    if (condition.id != RemarkId::after_mains_failure) continue;
    for (const RemarkArgument& one : condition.arguments)
      if (const double* seconds = std::get_if<double>(&one))
        hasher.add(std::bit_cast<uint64_t>(*seconds));
  }
}

/// A UUID in the form of version 8 (RFC 9562), made of hashes. `what`: "topic" or "viewpoint";
/// `repeat`: how many checks of equal identity come before this one.
std::string uuid_of(std::string_view what, const std::string& scene, const Check& check,
                    uint64_t repeat) {
  uint64_t words[2];
  for (uint64_t i = 0; i < 2; ++i) {
    Hasher hasher;
    hasher.add(i);
    hasher.add(what);
    hasher.add(scene);
    add_identity(hasher, check);
    hasher.add(repeat);
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

/// What an issue is about: where it is, and its GlobalId.
struct IssueSubject {
  std::string guid;
  std::optional<glm::dvec3> place;
  std::optional<glm::dvec3> front;  // direction from which it is seen
  std::optional<double> floor_m{};  // of its storey, where that is known

  /// The place on this floor, or the place itself. Requires: a place.
  glm::dvec3 foot() const { return {place->x, place->y, floor_m.value_or(place->z)}; }
};

template <class Row>
const Row* row_named(const std::vector<Row>& rows, const std::string& name) {
  for (const Row& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

glm::dvec3 middle_of(const AreaRecord& area) {
  glm::dvec2 sum(0);
  for (const glm::dvec2& corner : area.outline) sum += corner;
  const double n = std::max<double>(1, static_cast<double>(area.outline.size()));
  return {sum / n, area.z_m};
}

/// The area over which a place is: on the level of the place the one with the highest floor below
/// it, of those with a GlobalId if `with_guid`; none if it is over no such area of its level.
const AreaRecord* area_below(const AssessmentRecord& a, const glm::dvec3& place, bool with_guid) {
  const std::vector<PlanLevel>& levels = a.plan.levels;
  const AreaRecord* out = nullptr;
  for (const AreaRecord& area : a.places.areas) {
    if (area.z_m > place.z + sunk_m || level_of(levels, area.z_m) != level_of(levels, place.z) ||
        !is_within(area.outline, glm::dvec2(place)) || (with_guid && !is_ifc_guid(area.ifc_guid)))
      continue;
    if (out == nullptr || area.z_m > out->z_m) out = &area;
  }
  return out;
}

/// The height of the highest floor below a place [m]. Where no floor below it is known, it is taken
/// as at the height of an eye above one.
double floor_below(const AssessmentRecord& a, const glm::dvec3& place) {
  if (const AreaRecord* area = area_below(a, place, false)) return area->z_m;
  const std::vector<PlanLevel>& levels = a.plan.levels;
  const size_t level = level_of(levels, place.z);
  if (levels.empty() || levels[level].floor_m > place.z + sunk_m) return place.z - camera_height_m;
  return levels[level].floor_m;
}

/// A part of the building by its name.
IssueSubject named_subject(const AssessmentRecord& a, const Subject& subject) {
  switch (subject.kind) {
    case SubjectKind::luminaire:
      if (const LuminaireRecord* one = row_named(a.luminaires, subject.name))
        return {one->ifc_guid, one->position, std::nullopt, one->floor_m};
      break;
    case SubjectKind::sign:
      if (const SignRecord* one = row_named(a.signs, subject.name))
        return {one->ifc_guid, one->position, one->facing, one->floor_m};
      break;
    case SubjectKind::emphasis:
      if (const EmphasisRecord* one = row_named(a.places.emphasis, subject.name))
        return {one->ifc_guid, one->position, std::nullopt};
      break;
    case SubjectKind::open_area:
    case SubjectKind::task_area:
      if (const AreaRecord* area = row_named(a.places.areas, subject.name))
        return {area->ifc_guid, middle_of(*area), std::nullopt};
      break;
    case SubjectKind::route:
      if (const RouteRecord* route = row_named(a.places.routes, subject.name);
          route != nullptr && !route->path.empty())
        return {"", route->path.front(), std::nullopt};
      break;
    default:
      break;
  }
  return {};
}

IssueSubject subject_of(const AssessmentRecord& a, const Check& check) {
  IssueSubject out = named_subject(a, check.subject);
  if (check.worst) out.place = *check.worst;
  if (out.guid.empty() && out.place)
    if (const AreaRecord* area = area_below(a, out.foot(), true)) out.guid = area->ifc_guid;
  return out;
}

/// Where the camera stands: in front of a sign; beside another place, on the side of the middle of
/// its area, at the height of an eye above the floor below the place. A place at or above that
/// height is below a ceiling, and so is the camera.
glm::dvec3 eye_for(const AssessmentRecord& a, const IssueSubject& subject) {
  const glm::dvec3 at = *subject.place;
  if (subject.front) return at + camera_distance_m * *subject.front;
  const AreaRecord* area = area_below(a, subject.foot(), false);
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
  const glm::dvec3 eye = at + far * way;
  return {eye.x, eye.y, floor_below(a, subject.foot()) + camera_height_m};
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

std::string viewpoint_xml(const AssessmentRecord& a, const IssueSubject& subject,
                          const std::string& uuid) {
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
std::string date_of(const AssessmentRecord& a) {
  const std::string& date = a.project.date;
  const bool is_date = date.size() == 10 && date[4] == '-' && date[7] == '-' &&
                       std::all_of(date.begin(), date.end(),
                                   [](char c) { return c == '-' || (c >= '0' && c <= '9'); });
  return (is_date ? date : "1970-01-01") + "T00:00:00Z";
}

std::string title_of(const Check& check) {
  const std::string rule(name_of(check.rule.id));
  return rule + ", " + check.rule.edition + ": " + english().subject(check.subject) + ": " +
         english().rule_title(rule);
}

std::string description_of(const Check& check) {
  const Texts t = english();
  std::string out = t.rule_title(name_of(check.rule.id)) + " (" + t.clause(check.rule) + ").";
  if (check.value) out += fmt::format(" Found: {:.4g} {}.", *check.value, check.unit);
  if (check.limit)
    out += fmt::format(" Demanded: {} {:.4g} {}.", check.at_least ? "at least" : "at most",
                       *check.limit, check.unit);
  for (const Remarks& remarks : {check.conditions, check.reasons})
    if (!remarks.empty()) out += " " + t.remarks(remarks) + ".";
  return out;
}

std::string markup_xml(const AssessmentRecord& a, const Check& check, const std::string& topic,
                       const std::string& viewpoint, size_t index) {
  const std::string& author = a.project.author;
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

bool has_guids(const AssessmentRecord& a) {
  const auto any = [](const auto& rows) {
    return std::any_of(rows.begin(), rows.end(),
                       [](const auto& row) { return !row.ifc_guid.empty(); });
  };
  return any(a.luminaires) || any(a.signs) || any(a.places.areas);
}

}  // namespace

std::optional<std::string> bcf_issues(const AssessmentRecord& assessment) {
  if (!has_guids(assessment)) return std::nullopt;
  std::vector<std::pair<std::string, std::string>> files{
      {"bcf.version", std::string(xml_head) +
                          "<Version VersionId=\"2.1\"><DetailedVersion>2.1</DetailedVersion>"
                          "</Version>\n"}};
  size_t index = 0;
  std::map<std::string, uint64_t> repeats;  // by the identifier of the first
  for (const Check& check : assessment.checks) {
    if (check.verdict != CheckVerdict::fail || index >= limits::bcf_issues) continue;
    const std::string& scene = assessment.scene.name;
    const uint64_t repeat = repeats[uuid_of("topic", scene, check, 0)]++;
    const std::string topic = uuid_of("topic", scene, check, repeat);
    const std::string viewpoint = uuid_of("viewpoint", scene, check, repeat);
    const std::string folder = topic + "/";
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
