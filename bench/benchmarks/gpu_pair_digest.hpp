// The digest of pairs that lie on the GPU. It is summed there, because hundreds of millions of pairs would take the
// host a minute.
#pragma once

#include <cstdint>
#include <vector>

#include "core/engine/device_boxes.hpp"
#include "core/result.hpp"
#include "gpu/broad/border_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::bench {

// The core::pair_digest of these pairs.
inline core::Result<std::uint64_t> digest_of(const core::DevicePairs& pairs) {
  gpu::DeviceBuffer<unsigned long long> sum;
  const unsigned long long zero = 0;
  if (core::Status s = sum.upload({&zero, 1}, "digest"); !s) return s.error();
  if (core::Status s = gpu::launch_pair_digest({pairs.data, pairs.count, sum.data()}, nullptr); !s) return s.error();
  if (core::Status s = gpu::wait_for_device("adding up a digest"); !s) return s.error();
  std::vector<unsigned long long> out;
  if (core::Status s = sum.download(out, 1); !s) return s.error();
  return std::uint64_t{out[0]};
}

}  // namespace broadside::bench
