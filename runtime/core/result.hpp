// Errors as values. A Problem is one sentence for people with the place it speaks of; a Result is a
// value or a Problem; Problems collects many, so that a reader can report all of them at once.
// Thread rule: plain values, no sharing.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace luxodus {

/// Where a statement stands in a file: 1-based line, 0 where a line has no meaning (binary files).
struct SourcePlace {
  std::string file;
  int line = 0;
};

/// What is wrong, where, and what to do about it.
struct Problem {
  SourcePlace where;
  std::string what;

  /// "file:line: what", the form editors understand, in one line: control characters, which a name
  /// or a file's content may carry here and a terminal would obey, stand as \xNN.
  std::string text() const;
};

/// What is wrong with a text, a value or a request that stands in no file. These take the text
/// whole: GCC 12 falsely warns of uninitialised members where it may throw within the braces.
inline Problem problem(std::string what) {
  return {{}, std::move(what)};
}

/// What is wrong with a file, as a whole or in one of its lines. A path converts to its text.
inline Problem problem_in(std::string file, std::string what) {
  return {{std::move(file), 0}, std::move(what)};
}
inline Problem problem_in(std::string file, int line, std::string what) {
  return {{std::move(file), line}, std::move(what)};
}
inline Problem problem_in(SourcePlace where, std::string what) {
  return {std::move(where), std::move(what)};
}

/// What the system did not do with a file, and its reason: "what: Permission denied".
Problem system_problem(std::string file, std::string what, int error);

/// A value, or the problem that kept us from having it. A function passes a problem on by
/// `if (!x) return x.problem();`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}  // NOLINT: implicit on purpose, `return value;`
  Result(Problem problem) : state_(std::move(problem)) {}  // NOLINT: implicit on purpose

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// Requires: ok().
  T& value() & { return std::get<0>(state_); }
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  T* operator->() { return &std::get<0>(state_); }
  const T* operator->() const { return &std::get<0>(state_); }

  /// Requires: !ok().
  const Problem& problem() const { return std::get<1>(state_); }

 private:
  std::variant<T, Problem> state_;
};

/// Success, or the problem that prevented it: `return {};` on success.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Problem problem) : problem_(std::move(problem)) {}  // NOLINT: implicit on purpose

  bool ok() const { return !problem_; }
  explicit operator bool() const { return ok(); }

  /// Requires: !ok().
  const Problem& problem() const { return *problem_; }

 private:
  std::optional<Problem> problem_;
};

/// All that is wrong with something, in the order it was found.
class Problems {
 public:
  void add(SourcePlace where, std::string what) {
    list_.push_back({std::move(where), std::move(what)});
  }
  void add(Problem problem) { list_.push_back(std::move(problem)); }
  bool empty() const { return list_.empty(); }
  const std::vector<Problem>& list() const { return list_; }

 private:
  std::vector<Problem> list_;
};

}  // namespace luxodus
