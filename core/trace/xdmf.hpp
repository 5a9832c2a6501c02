// XDMF text: what ParaView 5.11 needs to play the cells of an HDF5 file over time. Private to core/trace/*.cpp.
#pragma once

#include <string>
#include <vector>

#include "core/trace/vtkhdf_group.hpp"

namespace broadside::core {

struct XdmfFrame {
  std::uint64_t step = 0;
  double time_s = 0.0;
};

// file: the HDF5 file with /VTKHDF, as the text names it: relative to the folder of the text.
std::string xdmf_text(const std::string& file, const VtkTopology& topology, const std::vector<XdmfFrame>& frames,
                      bool has_velocity);

}  // namespace broadside::core
