// The options of a node, checked before anything is made of them, so that a mistake ends the start
// with a sentence and not the run with an abort. Pure; any thread.
#pragma once

#include "runtime/net/zmq_transport.hpp"
#include "runtime/node/node.hpp"

namespace luxodus {

/// All mistakes.
Problems mistakes_in(const NodeOptions& options);

/// The endpoints of a node's two lanes, where "tcp://HOST:PORT" is that of the control lane: the
/// bulk lane has the next port. "ipc://PATH" has PATH-bulk. Errors: another form.
Result<Endpoints> endpoints_of(const std::string& where);

/// The links of the options, or one between any two nodes.
std::vector<Edge> links_of(const NodeOptions& options);

}  // namespace luxodus
