// Sections with checks: what fails, routes and areas, and all other checks. A rule that is judged
// without and with furniture has one row with two values.
#include <algorithm>
#include <array>

#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

std::string limit_text(const Texts& t, const Check& check) {
  if (!check.limit) return "–";
  const std::string unit = unit_text(t, check.unit);
  return std::string(check.at_least ? "≥\u00a0" : "≤\u00a0") + t.number(*check.limit) +
         (unit.empty() ? "" : "\u00a0" + unit);
}

std::string place_text(const Texts& t, const Check& check) {
  const auto& at = check.worst;
  return at ? t.place(at->x, at->y, at->z) : "–";
}

/// A check, or the two of one rule without and with furniture.
struct CheckRow {
  const CheckRecord* without = nullptr;  // or a check that furniture does not change
  const CheckRecord* with = nullptr;
};

bool has_condition(const Check& check, RemarkId id) {
  return std::any_of(check.conditions.begin(), check.conditions.end(),
                     [&](const Remark& one) { return one.id == id; });
}

/// Conditions but for that of the furniture, which the columns say.
Remarks other_conditions(const Check& check) {
  Remarks out;
  for (const Remark& one : check.conditions)
    if (one.id != RemarkId::without_furniture && one.id != RemarkId::with_furniture)
      out.push_back(one);
  return out;
}

/// Whether two checks are of one rule, subject and limit. Counts of points that were left out may
/// differ.
bool are_of_one_rule(const Check& a, const Check& b) {
  const auto alike = [](const Remarks& x, const Remarks& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const Remark& p, const Remark& q) {
      return p.id == q.id && (p == q || p.id == RemarkId::points_in_bodies);
    });
  };
  return a.rule.id == b.rule.id && a.rule.set == b.rule.set &&
         a.rule.deviation == b.rule.deviation && a.subject == b.subject && a.limit == b.limit &&
         alike(other_conditions(a), other_conditions(b));
}

/// Pairs the checks of a list; the order is that of the first of each pair.
std::vector<CheckRow> paired(const std::vector<const CheckRecord*>& checks) {
  std::vector<CheckRow> out;
  for (const CheckRecord* check : checks) {
    const bool furnished = has_condition(*check, RemarkId::with_furniture);
    const auto partner = std::find_if(out.begin(), out.end(), [&](const CheckRow& row) {
      return furnished && row.without && !row.with &&
             has_condition(*row.without, RemarkId::without_furniture) &&
             are_of_one_rule(*row.without, *check);
    });
    if (partner != out.end())
      partner->with = check;
    else if (furnished)
      out.push_back({nullptr, check});
    else
      out.push_back({check, nullptr});
  }
  return out;
}

/// The worse of the two, whose limit, margin and place a row shows.
const CheckRecord& worse_of(const CheckRow& row) {
  if (!row.with) return *row.without;
  if (!row.without) return *row.with;
  constexpr std::array order{CheckVerdict::fail, CheckVerdict::not_verified,
                             CheckVerdict::not_assessed, CheckVerdict::pass,
                             CheckVerdict::information};
  const auto rank = [&](const CheckRecord& check) {
    return std::find(order.begin(), order.end(), check.verdict) - order.begin();
  };
  if (rank(*row.with) != rank(*row.without))
    return rank(*row.with) < rank(*row.without) ? *row.with : *row.without;
  const auto with = row.with->margin(), without = row.without->margin();
  return with && (!without || *with < *without) ? *row.with : *row.without;
}

/// A value, with its verdict where that is not the row's.
std::string value_cell(const Texts& t, const CheckRecord* check, CheckVerdict of_row) {
  if (!check) return no_number_cell();
  if (check->verdict == of_row) return number_cell(t, check->value, check->unit);
  const std::string unit = unit_text(t, check->unit);
  const std::string value =
      check->value ? t.number(*check->value) + (unit.empty() ? "" : "\u00a0" + unit) : "–";
  return html_cell(escaped(value) + "<br>" + verdict_mark(t, "verdict", name_of(check->verdict)),
                   "n");
}

/// Sentences on a check: conditions as they are, remarks in italics.
std::vector<std::string> sentences_of(const Texts& t, const CheckRecord& check) {
  std::vector<std::string> out;
  for (const Remark& one : other_conditions(check)) out.push_back(escaped(t.remark(one)));
  for (const Remark& one : check.reasons) out.push_back(remark_html(t, one));
  return out;
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string out;
  for (const std::string& one : sentences) out += (out.empty() ? "" : "<br>") + one;
  return out;
}

/// What the two checks have in common, then what only one of them has.
std::string notes_of(const Texts& t, const CheckRow& row) {
  if (!row.with || !row.without)
    return joined(sentences_of(t, row.with ? *row.with : *row.without));
  std::vector<std::string> common;
  const auto without = sentences_of(t, *row.without), with = sentences_of(t, *row.with);
  const auto has = [](const std::vector<std::string>& list, const std::string& one) {
    return std::find(list.begin(), list.end(), one) != list.end();
  };
  for (const std::string& one : without)
    if (has(with, one)) common.push_back(one);
  std::vector<std::string> out = common;
  for (const auto& [key, list] : {std::pair{"check.without", &without}, {"check.with", &with}})
    for (const std::string& one : *list)
      if (!has(common, one)) out.push_back(escaped(t(key)) + ": " + one);
  return joined(out);
}

std::string check_row(const Texts& t, const CheckRow& row, bool furniture, bool with_subject) {
  const CheckRecord& worse = worse_of(row);
  const std::string rule(name_of(worse.rule.id));
  const std::optional<double> margin = worse.margin();
  std::string what = escaped(t.rule_title(rule));
  if (with_subject) what = "<b>" + escaped(t.subject(worse.subject)) + "</b><br>" + what;
  const bool depends =
      row.with || (row.without && has_condition(*row.without, RemarkId::without_furniture));
  std::string values;
  if (furniture && !depends) {
    const std::string unit = unit_text(t, worse.unit);
    const std::string value =
        worse.value ? t.number(*worse.value) + (unit.empty() ? "" : "\u00a0" + unit) : "–";
    values = "<td class=\"c\" colspan=\"2\">" + escaped(value) + "</td>";
  } else if (furniture) {
    values = value_cell(t, row.without, worse.verdict) + value_cell(t, row.with, worse.verdict);
  } else {
    values = number_cell(t, worse.value, worse.unit);
  }
  return "<tr>" + verdict_cell(t, "verdict", name_of(worse.verdict)) +
         html_cell(what + " <span class=\"id\">" + escaped(rule) + "</span>") + values +
         html_cell(escaped(limit_text(t, worse)), "n") +
         html_cell(margin ? t.percent(*margin) : "–", "n") +
         html_cell(escaped(place_text(t, worse)), "n") + html_cell(notes_of(t, row)) + "</tr>\n";
}

/// A table of checks; `furniture`: with two columns of values.
struct CheckTable {
  const PageParts& parts;
  bool furniture = false;
  std::string rows;

  std::vector<const char*> columns() const {
    if (furniture)
      return {"column.verdict", "column.check",  "column.without",  "column.with",
              "column.limit",   "column.margin", "column.worst_at", "column.remark"};
    return {"column.verdict", "column.check",    "column.value", "column.limit",
            "column.margin",  "column.worst_at", "column.remark"};
  }
  void add(const CheckRow& row, bool with_subject) {
    rows += check_row(parts.texts, row, furniture, with_subject);
  }
  std::string html() const {
    return table(parts.texts, columns(),
                 furniture ? std::vector{10, 18, 12, 12, 9, 7, 12, 20}
                           : std::vector{12, 22, 11, 10, 8, 14, 23},
                 rows, "checks");
  }
};

bool depends_on_furniture(const std::vector<const CheckRecord*>& checks) {
  return std::any_of(checks.begin(), checks.end(), [](const CheckRecord* check) {
    return has_condition(*check, RemarkId::with_furniture);
  });
}

std::string table_of(const PageParts& parts, CheckVerdict verdict) {
  std::vector<const CheckRecord*> all;
  for (const CheckRecord& check : parts.a.checks) all.push_back(&check);
  CheckTable out{parts, depends_on_furniture(all), ""};
  for (const CheckRow& row : paired(all))
    if (worse_of(row).verdict == verdict) out.add(row, true);
  return out.html();
}

/// Checks of routes and areas: a row for each rule under a heading for each subject, in the order
/// of their first checks.
std::string table_of_places(const PageParts& parts) {
  std::vector<Subject> subjects;
  std::vector<const CheckRecord*> all;
  for (const CheckRecord& check : parts.a.checks) {
    if (!check.subject.is_place()) continue;
    all.push_back(&check);
    if (std::find(subjects.begin(), subjects.end(), check.subject) == subjects.end())
      subjects.push_back(check.subject);
  }
  CheckTable out{parts, depends_on_furniture(all), ""};
  for (const Subject& subject : subjects) {
    std::vector<const CheckRecord*> of_subject;
    for (const CheckRecord* check : all)
      if (check->subject == subject) of_subject.push_back(check);
    out.rows += heading_row(escaped(parts.texts.subject(subject)), out.columns().size());
    for (const CheckRow& row : paired(of_subject)) out.add(row, false);
  }
  return out.html();
}

/// Rows of one rule, verdict and limit, whose conditions and remarks agree.
using CheckGroup = std::vector<CheckRow>;

bool belong_together(const Texts& t, const CheckRow& a, const CheckRow& b) {
  const CheckRecord &x = worse_of(a), &y = worse_of(b);
  return x.rule.id == y.rule.id && x.rule.set == y.rule.set &&
         x.rule.deviation == y.rule.deviation && x.verdict == y.verdict && x.limit == y.limit &&
         x.unit == y.unit && x.subject.kind == y.subject.kind &&
         (a.with == nullptr) == (b.with == nullptr) && notes_of(t, a) == notes_of(t, b);
}

/// "2.97 m", "2.6–4.2 m", or a dash.
std::string range_text(const Texts& t, const CheckGroup& group,
                       const CheckRecord* CheckRow::*which) {
  std::optional<double> low, high;
  std::string unit;
  for (const CheckRow& row : group) {
    const CheckRecord* check = row.*which;
    if (!check || !check->value) continue;
    low = std::min(low.value_or(*check->value), *check->value);
    high = std::max(high.value_or(*check->value), *check->value);
    unit = unit_text(t, check->unit);
  }
  if (!low) return "–";
  const std::string from = t.number(*low), to = t.number(*high);
  return from + (from == to ? "" : "–" + to) + (unit.empty() ? "" : "\u00a0" + unit);
}

/// "sign \"a\", \"b\" and 3 more".
std::string subjects_text(const Texts& t, const CheckGroup& group) {
  constexpr size_t most = 6;
  std::string out;
  for (size_t i = 0; i < std::min(group.size(), most); ++i) {
    const Subject& subject = worse_of(group[i]).subject;
    out += out.empty() ? t.subject(subject) : ", " + t.say("name.quoted", subject.name);
  }
  return group.size() > most ? t.say("checks.and_more", out, group.size() - most) : out;
}

std::string group_row(const Texts& t, const CheckGroup& group, bool furniture) {
  const CheckRow* worst = &group.front();
  for (const CheckRow& row : group) {
    const auto margin = worse_of(row).margin(), known = worse_of(*worst).margin();
    if (margin && (!known || *margin < *known)) worst = &row;
  }
  const CheckRecord& worse = worse_of(*worst);
  const std::string rule(name_of(worse.rule.id));
  const auto margin = worse.margin();
  const std::string without = escaped(range_text(t, group, &CheckRow::without));
  const std::string values =
      !furniture ? html_cell(without, "n")
      : worst->with
          ? html_cell(without, "n") + html_cell(escaped(range_text(t, group, &CheckRow::with)), "n")
          : "<td class=\"c\" colspan=\"2\">" + without + "</td>";
  return "<tr>" + verdict_cell(t, "verdict", name_of(worse.verdict)) +
         html_cell(escaped(t.rule_title(rule)) + " <span class=\"id\">" + escaped(rule) +
                   "</span>") +
         cell(subjects_text(t, group)) + values + html_cell(escaped(limit_text(t, worse)), "n") +
         html_cell(margin ? t.percent(*margin) : "–", "n") + html_cell(notes_of(t, *worst)) +
         "</tr>\n";
}

/// All checks but those of routes and areas: a row for each group.
std::string table_by_rule(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::vector<const CheckRecord*> all;
  for (const CheckRecord& check : parts.a.checks)
    if (!check.subject.is_place()) all.push_back(&check);
  const bool furniture = depends_on_furniture(all);
  std::vector<CheckGroup> groups;
  for (const CheckRow& row : paired(all)) {
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const CheckGroup& group) {
      return belong_together(t, group.front(), row);
    });
    if (known == groups.end())
      groups.push_back({row});
    else
      known->push_back(row);
  }
  std::stable_sort(groups.begin(), groups.end(), [](const CheckGroup& a, const CheckGroup& b) {
    return worse_of(a.front()).rule.id < worse_of(b.front()).rule.id;
  });
  std::string rows;
  for (const CheckGroup& group : groups) rows += group_row(t, group, furniture);
  std::vector<const char*> columns{"column.verdict", "column.check", "column.subjects"};
  std::vector<int> widths{12, 20, 25};
  if (furniture) {
    columns.insert(columns.end(), {"column.without", "column.with"});
    widths.insert(widths.end(), {8, 8});
  } else {
    columns.push_back("column.value");
    widths.push_back(11);
  }
  columns.insert(columns.end(), {"column.limit", "column.margin", "column.remark"});
  widths.insert(widths.end(), {8, 7, 20});
  const std::string out = table(t, columns, widths, rows, "checks");
  return out.empty() ? "" : paragraph(t("checks.grouped"), "note") + out;
}

/// Findings of the inspection are in English in every language.
std::string warning_html(const Texts& t, const WarningRecord& warning) {
  if (!warning.remark)
    return (t.language() == Language::en ? "<i>" : "<i lang=\"en\">") + escaped(warning.text) +
           "</i>";
  const SourcePlace place{warning.file, warning.line};
  return "<i>" + escaped(problem_in(place, t.remark(*warning.remark)).text()) + "</i>";
}

}  // namespace

std::string places_section(const PageParts& parts) {
  const std::string checks = table_of_places(parts);
  if (checks.empty()) return paragraph(parts.texts("places.none"));
  return paragraph(parts.texts("places.lead")) + checks;
}

std::string other_checks_appendix(const PageParts& parts) {
  return table_by_rule(parts);
}

std::string verdict_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const std::string fails = table_of(parts, CheckVerdict::fail);
  const std::string unverified = table_of(parts, CheckVerdict::not_verified);
  std::string out = subheading(t("verdict.fails"));
  out += fails.empty() ? paragraph(t("verdict.nothing_fails")) : fails;
  if (!unverified.empty()) out += subheading(t("verdict.unverified_checks")) + unverified;
  if (!parts.a.warnings.empty()) {
    out += subheading(t("verdict.warnings")) + "<ul>\n";
    for (const WarningRecord& warning : parts.a.warnings)
      out += "<li>" + warning_html(t, warning) + "</li>\n";
    out += "</ul>\n";
  }
  return out + paragraph(t("verdict.remarks_english"), "note");
}

}  // namespace luxodus
