#include "scenes/light/transport/kernels.hpp"

namespace luxodus {

template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::homogeneous>(
    const CompiledScene&, const GeometryAccess&, uint64_t);

}  // namespace luxodus
