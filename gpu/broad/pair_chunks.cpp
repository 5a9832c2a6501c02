#include "gpu/broad/pair_chunks.hpp"

#include <algorithm>
#include <string>

namespace broadside::gpu {
namespace {

// What the first share is expected to have; in the densest scenes of the campaign it fills half of a chunk.
constexpr std::uint64_t kExpectedPairsPerBox = 16;
// How full a chunk is meant to be, since shares differ.
constexpr double kAim = 0.75;
constexpr double kMostGrowth = 4.0;

// The width of the next share, from how full the last share, of this width, has made a chunk.
std::uint64_t next_width(std::uint64_t width, double fullness) {
  const double growth = fullness * kMostGrowth > kAim ? kAim / fullness : kMostGrowth;
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(static_cast<double>(width) * growth));
}

// Sets that have a box longer than any cell of the grid cannot be searched in shares: all their pairs are found at
// once.
core::Status find_at_once(BoxSearch& search, const Stream& stream, const ChunkConsumer& take) {
  do {
    if (search.is_aborted()) BROADSIDE_TRY(search.grow());
    BROADSIDE_TRY(search.launch(stream.get()));
    BROADSIDE_TRY(stream.wait("finding pairs"));
  } while (search.is_aborted());
  return take(search.found());
}

}  // namespace

core::Status for_each_chunk(BoxSearch& search, const Stream& stream, const ChunkConsumer& take, std::uint64_t& launches,
                            const PairNames& names) {
  search.forget_abort();
  if (!search.can_share()) return ++launches, find_at_once(search, stream, take);
  const std::uint64_t count = search.box_count();
  const std::uint64_t room = search.room_for_pairs();
  std::uint64_t width = std::max<std::uint64_t>(1, room / kExpectedPairsPerBox);
  NamedPairsView share;
  share.names = names;
  while (share.first_place < count) {
    share.end_place = std::min(count, share.first_place + width);
    ++launches;
    BROADSIDE_TRY(search.launch_share(share, stream.get()));
    BROADSIDE_TRY(stream.wait("finding a chunk of pairs"));
    share.is_in_order = true;
    const std::uint64_t searched = share.end_place - share.first_place;
    if (search.is_aborted()) {
      if (searched == 1)
        return core::Error{"one box alone has " + std::to_string(search.found().count) +
                               " pairs, and a chunk has room for " + std::to_string(room),
                           "broad phase on the GPU", "give pairs_at_once of at least that many", core::Exit::kMissing};
      width = std::min(next_width(searched, search.fullness()), searched / 2);
      continue;
    }
    BROADSIDE_TRY(take(search.found()));
    share.first_place = share.end_place;
    width = next_width(searched, search.fullness());
  }
  return core::Done{};
}

}  // namespace broadside::gpu
