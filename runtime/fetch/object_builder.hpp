// The interface to the code that builds objects from bytes, such as a search tree or a table. A
// simulation provides builds of known cost. Thread rule: called on the node's thread, outside of
// any fiber, whose stack would be too small: committing a search tree takes 45 KB. A builder may
// work on other threads and hand its answer over (Handoff).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "runtime/core/result.hpp"
#include "runtime/fetch/objects.hpp"

namespace luxodus {

/// An object ready for use. It is immutable, and may be released on any thread of its process.
class BuiltObject {
 public:
  virtual ~BuiltObject() = default;
  /// Its memory, including everything that it keeps alive: what a cache charges.
  virtual size_t bytes() const = 0;
  /// The bytes from which it was built, serialised again for a node that asks for them.
  virtual SharedBytes wire_bytes() const = 0;
};

class ObjectBuilder {
 public:
  /// Receives built objects.
  class Client {
   public:
    virtual ~Client() = default;
    /// One allocation if it is made by std::make_shared.
    virtual void built(uint32_t object, Result<std::shared_ptr<const BuiltObject>> result) = 0;
  };

  virtual ~ObjectBuilder() = default;
  /// Builds an object from bytes and calls `client` once: before this returns, or later.
  virtual void build(uint32_t object, SharedBytes bytes, Client& client) = 0;
};

}  // namespace luxodus
