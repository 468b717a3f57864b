#include "scenes/formats/ifc/step_draft.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/core/text.hpp"

namespace luxodus {

namespace {

constexpr std::string_view blanks = " \t\r\n\f\v";

}  // namespace

std::vector<std::string_view> split_parameters(std::string_view body) {
  std::vector<std::string_view> out;
  int depth = 0;
  size_t from = 0;
  for (size_t at = 0; at < body.size(); ++at) {
    const char c = body[at];
    if (c == '\'') {
      at = std::min(body.find('\'', at + 1), body.size());
    } else if (c == '/' && body.substr(at, 2) == "/*") {
      const size_t end = body.find("*/", at + 2);
      at = end == std::string_view::npos ? body.size() : end + 1;
    } else if (c == '(') {
      ++depth;
    } else if (c == ')') {
      --depth;
    } else if (c == ',' && depth == 0) {
      out.push_back(trimmed(body.substr(from, at - from), blanks));
      from = at + 1;
    }
  }
  const std::string_view last = trimmed(body.substr(std::min(from, body.size())), blanks);
  if (!last.empty() || !out.empty()) out.push_back(last);
  return out;
}

std::string joined_parameters(const std::vector<std::string>& parameters) {
  return fmt::format("{}", fmt::join(parameters, ","));
}

StepDraft::StepDraft(const StepFile& file) : file_(file) {
  uint64_t bytes = 0;
  for (const StepFile::Instance& instance : file.instances()) {
    next_ = std::max(next_, instance.id < UINT32_MAX ? instance.id + 1 : 0);
    bytes += instance.body.size();
  }
  most_bytes_ = limits::draft_bytes + limits::draft_growth * bytes;
}

std::string_view StepDraft::type(uint64_t id) const {
  if (const auto it = changed_.find(id); it != changed_.end()) return it->second.type;
  const StepFile::Instance* instance = file_.find(id);
  return instance == nullptr ? std::string_view() : instance->type;
}

std::string_view StepDraft::body(uint64_t id) const {
  if (const auto it = changed_.find(id); it != changed_.end()) return it->second.body;
  const StepFile::Instance* instance = file_.find(id);
  return instance == nullptr ? std::string_view() : instance->body;
}

std::vector<std::string_view> StepDraft::parameters(uint64_t id) const {
  return split_parameters(body(id));
}

std::vector<std::string> StepDraft::copied_parameters(uint64_t id) const {
  const auto views = parameters(id);
  return {views.begin(), views.end()};
}

void StepDraft::replace(uint64_t id, std::string type, std::string body) {
  changed_[id] = {std::move(type), std::move(body)};
}

uint64_t StepDraft::add(std::string type, std::string body) {
  added_bytes_ += body.size() + type.size();
  // The library that computes shapes counts instances in 32 bits.
  if (added_bytes_ > most_bytes_ || next_ >= UINT32_MAX) {
    is_full_ = true;
    return 0;
  }
  const uint64_t id = next_++;
  changed_[id] = {std::move(type), std::move(body)};
  added_.push_back(id);
  return id;
}

std::string StepDraft::text() const {
  std::string out =
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
      "FILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('" +
      file_.schema() + "'));\nENDSEC;\nDATA;\n";
  const auto write = [&](uint64_t id) {
    out += fmt::format("#{}={}({});\n", id, type(id), body(id));
  };
  for (const StepFile::Instance& instance : file_.instances()) write(instance.id);
  for (const uint64_t id : added_) write(id);
  return out + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace luxodus
