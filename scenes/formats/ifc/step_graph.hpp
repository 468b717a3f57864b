// Instances of a STEP file as a graph: parameters by place, references followed. A missing
// parameter, or one of another kind, reads as an empty value. Internal to the reading of IFC. Holds
// a reference to the file; one thread, since it caches parsed instances.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scenes/formats/ifc/step_file.hpp"

namespace luxodus {

/// An instance and its parameters.
class StepNode {
 public:
  StepNode() = default;
  StepNode(const StepFile::Instance* instance, const std::vector<StepValue>* parameters)
      : instance_(instance), parameters_(parameters) {}

  explicit operator bool() const { return instance_ != nullptr; }
  uint64_t id() const { return instance_ == nullptr ? 0 : instance_->id; }
  std::string_view type() const { return instance_ == nullptr ? "" : instance_->type; }
  bool is(std::string_view type) const { return this->type() == type; }
  /// Number of parameters.
  size_t size() const { return parameters_ == nullptr ? 0 : parameters_->size(); }
  /// A parameter by its place, from 0; an omitted one beyond the last.
  const StepValue& at(size_t place) const;
  std::string text(size_t place) const;
  std::string word(size_t place) const;
  std::optional<double> number(size_t place) const;
  /// The number of a reference; 0 where there is none.
  uint64_t reference(size_t place) const;
  /// Numbers of the references in a list, or of the one reference.
  std::vector<uint64_t> references(size_t place) const;
  std::vector<double> numbers(size_t place) const;

 private:
  const StepFile::Instance* instance_ = nullptr;
  const std::vector<StepValue>* parameters_ = nullptr;
};

class StepGraph {
 public:
  explicit StepGraph(const StepFile& file) : file_(file) {}

  const StepFile& file() const { return file_; }
  StepNode node(uint64_t id);
  StepNode node(const StepFile::Instance& instance);
  /// The instance that a parameter refers to.
  StepNode follow(const StepNode& from, size_t place) { return node(from.reference(place)); }

 private:
  const StepFile& file_;
  std::unordered_map<uint64_t, std::vector<StepValue>> taken_apart_;
};

/// The content of a value for display: a text, a word, a number; of a typed value its content.
std::string words_of(const StepValue& value);
std::optional<double> number_of(const StepValue& value);

}  // namespace luxodus
