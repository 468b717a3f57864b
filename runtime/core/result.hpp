// Errors as values. A Problem is one sentence for people with the place it speaks of, and a kind
// for programs; a Result is a value or a Problem; Problems collects many, so that a reader can
// report all of them at once. Thread rule: plain values, no sharing.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace luxodus {

/// Place in a file: 1-based line, 0 if there are no lines (binary files).
struct SourcePlace {
  std::string file;
  int line = 0;
};

/// What kind of a failure a problem is. The exit code of a command follows from it.
enum class ProblemKind {
  bad_input,  // a file, an option or a value is wrong, or what is asked for cannot be
  not_found,  // a file that was named is not there
  refused,    // the system or another process does not allow it: permissions, a port in use
  no_room,    // a disk, the memory or another limit of the machine is exhausted
  lost_peer,  // another process or node does not answer, or has ended
  system,     // any other failure of the system, or of a program that was started
  bug,        // what cannot be unless this program is wrong
};

/// What is wrong, where, and what to do about it.
struct Problem {
  SourcePlace where;
  std::string what;
  ProblemKind kind = ProblemKind::bad_input;

  /// "file:line: what" in one line, the form editors understand. Control characters, which names
  /// and contents of files may carry and a terminal would obey, become \xNN.
  std::string text() const;
};

/// A problem with a text, a value or a request that is in no file. These functions take the text by
/// value: GCC 12 falsely warns of uninitialised members where it may throw within the braces.
inline Problem problem(std::string what, ProblemKind kind = ProblemKind::bad_input) {
  return {{}, std::move(what), kind};
}

/// A problem with a whole file or one of its lines. A path converts to its text.
inline Problem problem_in(std::string file, std::string what,
                          ProblemKind kind = ProblemKind::bad_input) {
  return {{std::move(file), 0}, std::move(what), kind};
}
inline Problem problem_in(std::string file, int line, std::string what,
                          ProblemKind kind = ProblemKind::bad_input) {
  return {{std::move(file), line}, std::move(what), kind};
}
inline Problem problem_in(SourcePlace where, std::string what,
                          ProblemKind kind = ProblemKind::bad_input) {
  return {std::move(where), std::move(what), kind};
}

/// A problem that was found without its place, now with it. What and kind stay.
inline Problem problem_in(std::string file, Problem found) {
  return {{std::move(file), 0}, std::move(found.what), found.kind};
}
inline Problem problem_in(std::string file, int line, Problem found) {
  return {{std::move(file), line}, std::move(found.what), found.kind};
}
inline Problem problem_in(SourcePlace where, Problem found) {
  return {std::move(where), std::move(found.what), found.kind};
}

/// What the system did not do with a file, and its reason: "what: Permission denied". The kind
/// follows from `error`, an errno.
Problem system_problem(std::string file, std::string what, int error);
ProblemKind kind_of_errno(int error);

/// A value, or the problem that kept us from having it. A function passes a problem on by
/// `if (!x) return x.problem();`, and where there is no value, `if (auto ok = f(); !ok) return
/// ok.problem();`.
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

/// All problems found, in order.
class Problems {
 public:
  void add(SourcePlace where, std::string what) {
    list_.push_back({std::move(where), std::move(what)});
  }
  void add(Problem problem) { list_.push_back(std::move(problem)); }
  bool empty() const { return list_.empty(); }
  const std::vector<Problem>& list() const { return list_; }
  /// That of all together: what a person has to mend comes before what the system refuses.
  /// Requires: there is one.
  ProblemKind kind() const;

 private:
  std::vector<Problem> list_;
};

}  // namespace luxodus
