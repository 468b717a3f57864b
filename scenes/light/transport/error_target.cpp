#include "scenes/light/transport/error_target.hpp"

#include <numeric>

namespace luxodus {

namespace {

struct Word {
  std::string kind, name;  // the name is empty if all of a kind are meant
};

Word split(const std::string& text) {
  const size_t space = text.find(' ');
  if (space == std::string::npos) return {text, ""};
  return {text.substr(0, space), text.substr(space + 1)};
}

/// Targets of one kind, by name; a name may stand for several (a sign seen by many observers).
struct Kind {
  const char* one;   // the word before a name
  const char* all;   // the word for all of them
  const char* what;  // plural of the things named
  std::vector<std::string> names;
  std::vector<uint32_t>* chosen;
};

std::vector<uint32_t> all_of(const Kind& kind) {
  std::vector<uint32_t> numbers(kind.names.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

std::string quoted_list(const std::vector<std::string>& names) {
  constexpr size_t shown = 8;
  std::string text;
  for (size_t i = 0; i < names.size() && i < shown; ++i)
    text += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
  return text + (names.size() > shown ? ", ..." : "");
}

class ErrorTargetReader {
 public:
  ErrorTargetReader(const CompiledScene& scene, const std::vector<std::string>& words)
      : scene_(scene) {
    judged_.words = words;
    const SceneDescription& d = *scene.description;
    for (const PlaneMeasure& p : d.planes) {
      planes_.names.push_back(p.name);
      cells_.names.push_back(p.name);
    }
    for (const ProbeMeasure& p : d.probes) probes_.names.push_back(p.name);
    for (const EyeTarget& t : scene.eye_targets)
      signs_.names.push_back(d.signs[scene.signs[t.sign].sign].name);
  }

  Result<void> add(const std::string& text) {
    if (text == "all") {
      add_all();
    } else if (text == "surfaces") {
      judged_.surfaces = true;
    } else if (text == "patches") {
      judged_.patches = true;
    } else {
      return add_kind(split(text), text);
    }
    return {};
  }

  void add_all() {
    for (const Kind* kind : {&planes_, &probes_, &signs_}) *kind->chosen = all_of(*kind);
    const bool any = !judged_.planes.empty() || !judged_.probes.empty() || !judged_.targets.empty();
    judged_.surfaces |= !any;
  }

  ErrorTarget take() { return std::move(judged_); }

 private:
  Result<void> add_kind(const Word& word, const std::string& text) {
    for (const Kind* each : {&planes_, &probes_, &signs_, &cells_}) {
      const Kind& kind = *each;
      if (word.kind == kind.all && word.name.empty()) {
        if (kind.names.empty()) return fail("the scene has no " + std::string(kind.what) + "s");
        *kind.chosen = all_of(kind);
        return {};
      }
      if (word.kind == kind.one && !word.name.empty()) return add_named(kind, word.name);
    }
    return fail(
        "an error can be of all, planes, cells, probes, signs, surfaces, patches, \"plane NAME\", "
        "\"cells NAME\", \"probe NAME\" or \"sign NAME\", not of \"" +
        text + "\"");
  }

  Result<void> add_named(const Kind& kind, const std::string& name) {
    bool found = false;
    for (uint32_t i = 0; i < kind.names.size(); ++i) {
      if (kind.names[i] != name) continue;
      kind.chosen->push_back(i);
      found = true;
    }
    if (found) return {};
    const std::string known =
        kind.names.empty() ? "there are none" : "there are " + quoted_list(kind.names);
    return fail("an error is wanted of the " + std::string(kind.what) + " \"" + name + "\", but " +
                known);
  }

  Problem fail(std::string what) const {
    return problem_in(scene_.description->file, std::move(what));
  }

  const CompiledScene& scene_;
  ErrorTarget judged_;
  Kind planes_{"plane", "planes", "plane", {}, &judged_.planes};
  Kind probes_{"probe", "probes", "probe", {}, &judged_.probes};
  Kind signs_{"sign", "signs", "sign", {}, &judged_.targets};
  Kind cells_{"cells", "cells", "plane", {}, &judged_.cells};
};

}  // namespace

Result<ErrorTarget> error_target_of(const CompiledScene& scene,
                                    const std::vector<std::string>& words) {
  ErrorTargetReader judging(scene, words);
  if (words.empty()) judging.add_all();
  for (const std::string& word : words) {
    if (auto ok = judging.add(word); !ok) return ok.problem();
  }
  return judging.take();
}

}  // namespace luxodus
