#include "datasets/decimate/decimate.hpp"

namespace broadside::datasets {

bool can_decimate() {
  return false;
}

core::Result<core::Mesh> decimated(const core::Mesh& mesh, std::uint64_t) {
  return core::Error{"decimation is not built in", "mesh " + mesh.name,
                     "configure with -DBROADSIDE_CGAL=ON (needs CGAL)", core::Exit::kMissing};
}

}  // namespace broadside::datasets
