#include "runtime/observe/trace_ring.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/observe/node_trace.hpp"

namespace luxodus {

namespace {

/// Names are written into the JSON unescaped.
bool needs_no_escape(const std::string& name) {
  return std::none_of(name.begin(), name.end(), [](char c) {
    return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20;
  });
}

std::string event_json(NodeId node, const TraceEvent& event, const std::string& kind) {
  const double at_us = static_cast<double>(event.at) * 1e-3;
  const std::string common =
      fmt::format(R"("name":"{}","pid":{},"tid":0,"ts":{:.3f})", kind, node.value, at_us);
  if (event.phase == TracePhase::moment)
    return fmt::format(R"({{"ph":"i","s":"t",{},"args":{{"id":"{:#x}","arg":{}}}}})", common,
                       event.id, event.arg);
  // A global id joins the spans of one request across nodes (here: processes).
  return fmt::format(
      R"({{"ph":"{}","cat":"request","id2":{{"global":"{:#x}"}},{},"args":{{"arg":{}}}}})",
      event.phase == TracePhase::begin ? 'b' : 'e', event.id, common, event.arg);
}

}  // namespace

const std::vector<std::string>& trace_kind_names() {
  static const std::vector<std::string> names{"particle", "wait",  "fetch",
                                              "build",    "batch", "flush"};
  return names;
}

std::vector<TraceEvent> TraceRing::kept() const {
  if (recorded_ < events_.size())
    return {events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(next_)};
  std::vector<TraceEvent> out = events_;
  std::rotate(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(next_), out.end());
  return out;
}

std::string chrome_trace(const std::vector<TraceTrack>& tracks,
                         const std::vector<std::string>& kinds) {
  LUX_CHECK(std::all_of(kinds.begin(), kinds.end(), needs_no_escape),
            "kinds of trace events have plain names");
  std::string out = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[";
  const char* separator = "\n";
  for (const TraceTrack& track : tracks) {
    out += separator;
    out += fmt::format(R"({{"ph":"M","name":"process_name","pid":{},"args":{{"name":"node {}"}}}})",
                       track.node.value, track.node.value);
    separator = ",\n";
    for (const TraceEvent& event : track.events) {
      LUX_CHECK(event.kind < kinds.size(), "a trace event of a kind without a name");
      out += separator + event_json(track.node, event, kinds[event.kind]);
    }
  }
  return out + "\n]}\n";
}

}  // namespace luxodus
