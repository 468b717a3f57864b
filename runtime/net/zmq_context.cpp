#include "runtime/net/zmq_context.hpp"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <zmq.hpp>

#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// The first and then every hundredth rejected client is logged, so that strangers cannot flood the
/// log.
constexpr uint64_t logged_every = 100;

/// Keeps what is freed. ZeroMQ allocates every frame, and another thread frees it: with the usual
/// limits the C library gives the memory of long frames back to the system and asks for it anew,
/// which took half of the processor time of objects of 100 kB. A process keeps 64 MiB at most of
/// each arena beyond what it uses.
void keep_freed_memory() {
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  mallopt(M_TOP_PAD, 1 << 20);
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
}

std::string text_key(const std::string& binary) {
  std::array<char, 41> text{};
  zmq_z85_encode(text.data(), reinterpret_cast<const uint8_t*>(binary.data()), binary.size());
  return text.data();
}

}  // namespace

std::string routing_id(NodeId node) {
  return "n" + std::to_string(node.value);
}

ZmqContext::ZmqContext(const std::vector<Admitted>& admitted, int io_threads)
    : context_(std::make_unique<zmq::context_t>(io_threads)) {
  keep_freed_memory();
  for (const Admitted& one : admitted) {
    std::string binary(32, '\0');
    if (one.public_key.size() != 40 || zmq_z85_decode(reinterpret_cast<uint8_t*>(binary.data()),
                                                      one.public_key.c_str()) == nullptr)
      throw std::invalid_argument("the public key of node " + std::to_string(one.node.value) +
                                  " is none: 40 characters of Z85");
    listed_.push_back({std::move(binary), routing_id(one.node)});
  }
  door_ = std::make_unique<zmq::socket_t>(*context_, zmq::socket_type::rep);
  door_->set(zmq::sockopt::linger, 0);
  door_->bind("inproc://zeromq.zap.01");
  door_descriptor_ = door_->get(zmq::sockopt::fd);
}

ZmqContext::~ZmqContext() = default;

const ZmqContext::Listed* ZmqContext::find(const std::string& binary_key) const {
  const auto at = std::find_if(listed_.begin(), listed_.end(),
                               [&](const Listed& l) { return l.binary_key == binary_key; });
  return at == listed_.end() ? nullptr : &*at;
}

void ZmqContext::answer_door() {
  // A socket may move between threads with a full fence, which the mutex provides. The descriptor
  // is edge-triggered, so all waiting requests are answered.
  const std::unique_lock lock(door_mutex_, std::try_to_lock);
  if (!lock) return;
  while (answer_one()) {
  }
}

bool ZmqContext::answer_one() {
  // version, request, domain, address, identity, mechanism, credentials
  std::array<std::string, 7> parts;
  size_t count = 0;
  for (bool more = true; more; ++count) {
    zmq::message_t part;
    if (!door_->recv(part, zmq::recv_flags::dontwait)) return false;
    if (count < parts.size()) parts[count] = part.to_string();
    more = part.more();
  }
  const bool curve = count == parts.size() && parts[0] == "1.0" && parts[5] == "CURVE";
  const Listed* listed = curve && parts[6].size() == 32 ? find(parts[6]) : nullptr;
  if (listed != nullptr) {
    ++let_in_;
  } else if (turned_away_++ % logged_every == 0) {
    log_warning(
        "zmq=turned_away address={} mechanism={} key={} total={} text=\"its key is none "
        "of those listed here: give all nodes one folder of public keys\"",
        parts[3], parts[5], curve ? text_key(parts[6]) : "none", turned_away_.load());
  }
  const std::array<std::string, 6> answer{"1.0",
                                          parts[1],
                                          listed ? "200" : "400",
                                          listed ? "OK" : "key not in the allow-list",
                                          listed ? listed->name : "",
                                          ""};
  for (size_t i = 0; i < answer.size(); ++i)
    door_->send(zmq::buffer(answer[i]),
                i + 1 < answer.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
  return true;
}

}  // namespace luxodus
