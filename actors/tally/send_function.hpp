// How the parts of a tally send messages, to other nodes or to their own: whoever wires them knows
// which. What finds no room or no way is lost; who waits for an answer sends it again.
#pragma once

#include <functional>

#include "runtime/net/network.hpp"

namespace luxodus {

using SendFunction =
    std::function<void(NodeId to, const MessageId&, const Message&, const SharedBytes& payload)>;

}  // namespace luxodus
