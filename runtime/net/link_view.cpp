#include "runtime/net/link_view.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace luxodus {

LinkView::LinkView(std::vector<Edge> edges) {
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end())
    throw std::invalid_argument("a link stands twice in the graph");
  if (edges.size() > limits::link_changes)
    throw std::invalid_argument("a graph has more links than one message can tell of");
  for (const Edge& edge : edges) {
    if (edge.b <= edge.a) throw std::invalid_argument("a link must name its smaller node first");
    links_.push_back({edge});
  }
}

const LinkView::Known* LinkView::find(Edge edge) const {
  const auto at = std::lower_bound(links_.begin(), links_.end(), edge,
                                   [](const Known& k, const Edge& e) { return k.edge < e; });
  return at != links_.end() && at->edge == edge ? &*at : nullptr;
}

bool LinkView::set(Edge edge, bool up) {
  Known* known = find(edge);
  if (known == nullptr) throw std::invalid_argument("the graph has no such link");
  if ((known->version % 2 == 0) == up) return false;
  raise(*known, known->version + 1);
  return true;
}

uint32_t LinkView::version(Edge edge) const {
  return find(edge)->version;
}

bool LinkView::merge(const LinkChange& change) {
  // No link changes so often unheard; and a version near the largest number could never be
  // superseded.
  constexpr uint32_t max_unheard = 1 << 20;
  Known* known = find({change.a, change.b});
  if (known == nullptr || change.version <= known->version) return false;
  if (change.version - known->version > max_unheard) return false;
  raise(*known, change.version);
  return true;
}

/// Each link contributes a part of its own to the hash, so the order of changes does not matter.
void LinkView::raise(Known& known, uint32_t version) {
  const auto part = [&](uint32_t of) {
    const std::array<uint32_t, 3> words{known.edge.a.value, known.edge.b.value, of};
    return of == 0 ? 0 : XXH3_64bits(words.data(), sizeof words);
  };
  hash_ ^= part(known.version) ^ part(version);
  epoch_ += version - known.version;
  known.version = version;
}

std::vector<Edge> LinkView::down() const {
  std::vector<Edge> out;
  for (const Known& known : links_)
    if (known.version % 2 == 1) out.push_back(known.edge);
  return out;
}

LinkChanges LinkView::changes() const {
  LinkChanges out;
  for (const Known& known : links_)
    if (known.version > 0) out.changes.push_back({known.edge.a, known.edge.b, known.version});
  return out;
}

}  // namespace luxodus
