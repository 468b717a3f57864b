#include "runtime/actor/supervised.hpp"

#include "runtime/core/check.hpp"

namespace luxodus {

void Supervised::reset() {
  LUX_CHECK(false, "an actor that cannot begin anew was told to");
}

}  // namespace luxodus
