// The seam between bytes and what is made of them: a search tree, a table. A simulation puts builds
// of known cost here.
// Thread rule: everything here is called on the node's thread, outside of any fiber, whose stack
// would be too small: committing a search tree takes 45 KB. A builder may work on other threads and
// hand its answer over (Handoff).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "runtime/core/result.hpp"
#include "runtime/fetch/objects.hpp"

namespace luxodus {

/// An object ready for use. It does not change, and may be let go on any thread of its process.
class BuiltObject {
 public:
  virtual ~BuiltObject() = default;
  /// What it takes in memory, everything that it keeps alive included: what a cache is charged.
  virtual size_t bytes() const = 0;
  /// The bytes that it was built of, made anew for a node that asks for them.
  virtual SharedBytes wire_bytes() const = 0;
};

class ObjectBuilder {
 public:
  /// Who wants to know.
  class Client {
   public:
    virtual ~Client() = default;
    /// One allocation if it is made by std::make_shared.
    virtual void built(uint32_t object, Result<std::shared_ptr<const BuiltObject>> result) = 0;
  };

  virtual ~ObjectBuilder() = default;
  /// Makes an object of bytes, and tells `client` once: before this returns, or later.
  virtual void build(uint32_t object, SharedBytes bytes, Client& client) = 0;
};

}  // namespace luxodus
