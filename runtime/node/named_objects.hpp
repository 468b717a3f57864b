// Objects by name: immutable bytes that any node puts and any node gets, without knowing their
// hash, their size or who holds them. The first get() of a name asks the other nodes which of them
// holds it and what its hash and size are. Then it is fetched as every object is: through the
// cache, with retries, checked by its hash. Where a name leads is remembered; names for which there
// is no room any more are forgotten. Thread rule: the node's thread; get() on a fiber.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/fetch/part_server.hpp"
#include "runtime/node/app_actors.hpp"

namespace luxodus {

struct NamedObjectsConfig {
  NodeId self;
  size_t nodes = 0;
  size_t cache_bytes = 0;              // for objects of others; at least two of the largest
  size_t max_object_bytes = 0;         // of one object
  size_t store_bytes = 0;              // for objects that are put here
  size_t known = 0;                    // names of others' objects that are remembered
  Nanoseconds patience = seconds(10);  // to find who holds an object
};

class NamedObjects final : private ObjectStore, private ObjectBuilder {
 public:
  /// Requires: all references outlive this. Errors (exception): those of PartServer.
  NamedObjects(const NamedObjectsConfig& config, Scheduler& scheduler, ActorSystem& system,
               AppActors& line);

  /// Holds an object for all nodes from now on. To put the same bytes again is allowed. Errors: no
  /// bytes, or more than max_object_bytes; other bytes under a name that is taken; the store is
  /// full.
  Result<void> put(std::string_view name, std::span<const std::byte> bytes);

  /// The object's bytes, which are valid until the fiber next suspends. Errors: no node that
  /// answers has it; no node that has it can be reached; the fiber was cancelled. Suspends.
  Result<std::span<const std::byte>> get(std::string_view name);

  /// The actor that serves and fetches, to be added to the node.
  PartServer& server() { return server_; }
  const PartServer& server() const { return server_; }
  /// Objects that are fetched at once; the network has room for as many messages. With 64, fibers
  /// that wait for small objects of a node took a sixth more processor time.
  static constexpr size_t fetches_at_once = limits::part_answers / 2;
  /// Most timers set at once.
  static size_t max_timers();

  /// Receivers of the runtime's own messages have such numbers (AppActors::add_line).
  static constexpr uint64_t line_number = 1;

 private:
  /// An object that this node holds.
  struct Held {
    ObjectId id;
    uint64_t bytes = 0;
  };
  /// A name whose holder is being looked for.
  struct Search {
    std::vector<bool> open;  // nodes that have not denied it
    size_t open_count = 0;
    WaitList asker;
    WaitList others;  // that want the same
    std::optional<uint32_t> slot;
  };
  struct Found;

  SharedBytes find(ObjectId object) override;
  void build(uint32_t object, SharedBytes bytes, Client& client) override;

  Result<uint32_t> locate(std::string_view name, uint64_t key);
  Wake ask_all(Search& search, uint64_t key, Nanoseconds end);
  std::optional<Found> own_knowledge(uint64_t key);
  void take_message(const Mail& mail);
  void answer_where(const Mail& mail, uint64_t key);
  void learn(NodeId holder, const Found& found);
  std::optional<uint32_t> free_slot();
  void forget(uint32_t slot);

  const NamedObjectsConfig config_;
  Scheduler& scheduler_;
  ActorSystem& system_;
  AppActors& line_;
  std::unordered_map<uint64_t, Held> held_;            // by hash of the name
  std::unordered_map<uint64_t, SharedBytes> content_;  // by hash of the bytes
  size_t held_bytes_ = 0;
  std::vector<ObjectPlace> places_;               // by slot; free ones have no bytes
  std::vector<uint64_t> keys_;                    // by slot
  std::unordered_map<uint64_t, uint32_t> slots_;  // by hash of the name
  std::unordered_map<uint64_t, Search*> searches_;
  size_t first_rounds_ = 0;  // searches that wait for their first answers
  WaitList turn_;            // fibers that will search when there are fewer
  uint32_t hand_ = 0;        // the slot that is looked at next for reuse
  uint64_t asked_ = 0;
  PartServer server_;
};

}  // namespace luxodus
