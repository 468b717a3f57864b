#include "scenes/formats/ifc/step_graph.hpp"

#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// The content of a typed value ("IFCBOOLEAN(.T.)").
const StepValue& bare_value(const StepValue& value) {
  const StepValue* v = &value;
  while (v->kind == StepValue::Kind::list && v->items.size() == 1) v = &v->items.front();
  return *v;
}

}  // namespace

std::string words_of(const StepValue& value) {
  const StepValue& v = bare_value(value);
  if (v.kind == StepValue::Kind::text || v.kind == StepValue::Kind::word) return v.text;
  if (v.kind == StepValue::Kind::number) return shortest_number(v.number);
  return {};
}

std::optional<double> number_of(const StepValue& value) {
  const StepValue& v = bare_value(value);
  return v.kind == StepValue::Kind::number ? std::optional(v.number) : std::nullopt;
}

const StepValue& StepNode::at(size_t place) const {
  static const StepValue none;
  return parameters_ == nullptr || place >= parameters_->size() ? none : (*parameters_)[place];
}

std::string StepNode::text(size_t place) const {
  return at(place).kind == StepValue::Kind::text ? at(place).text : std::string();
}

std::string StepNode::word(size_t place) const {
  return at(place).kind == StepValue::Kind::word ? at(place).text : std::string();
}

std::optional<double> StepNode::number(size_t place) const {
  return number_of(at(place));
}

uint64_t StepNode::reference(size_t place) const {
  return at(place).kind == StepValue::Kind::reference ? at(place).id : 0;
}

std::vector<uint64_t> StepNode::references(size_t place) const {
  const StepValue& value = at(place);
  if (value.kind == StepValue::Kind::reference) return {value.id};
  std::vector<uint64_t> out;
  for (const StepValue& item : value.items)
    if (item.kind == StepValue::Kind::reference) out.push_back(item.id);
  return out;
}

std::vector<double> StepNode::numbers(size_t place) const {
  std::vector<double> out;
  for (const StepValue& item : at(place).items)
    if (item.kind == StepValue::Kind::number) out.push_back(item.number);
  return out;
}

StepNode StepGraph::node(uint64_t id) {
  const StepFile::Instance* instance = id == 0 ? nullptr : file_.find(id);
  return instance == nullptr ? StepNode() : node(*instance);
}

StepNode StepGraph::node(const StepFile::Instance& instance) {
  const auto [it, fresh] = taken_apart_.try_emplace(instance.id);
  if (fresh) it->second = file_.parameters(instance);
  return {&instance, &it->second};
}

}  // namespace luxodus
