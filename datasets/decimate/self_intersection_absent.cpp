#include "datasets/decimate/self_intersection.hpp"

namespace broadside::datasets {

core::Result<std::uint64_t> self_intersecting_pairs(const core::Mesh& mesh) {
  return core::Error{"CGAL is not built in", "mesh " + mesh.name, "configure with -DBROADSIDE_CGAL=ON (needs CGAL)",
                     core::Exit::kMissing};
}

}  // namespace broadside::datasets
