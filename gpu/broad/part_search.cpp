#include "gpu/broad/part_search.hpp"

#include <algorithm>
#include <cmath>

namespace broadside::gpu {
namespace {

// Of n boxes in a cube some n^(2/3) reach over a face; more are found again.
std::uint64_t expected_guests(std::uint64_t boxes) {
  const double side = std::cbrt(static_cast<double>(boxes));
  return 1024 + static_cast<std::uint64_t>(2.0 * side * side);
}

}  // namespace

core::Status PartSearch::load(std::span<const PackedBox> boxes, const BoxFacts& facts, std::uint32_t base,
                              const core::SpaceCut& cut) {
  BROADSIDE_TRY(use_device(device_));
  BROADSIDE_TRY(stream_.create());
  own_ = static_cast<std::uint32_t>(boxes.size());
  facts_ = facts;
  has_searched_ = false;
  options_.has_shares = true;
  const std::uint32_t parts = cut.parts();
  auto room = search_.room_for(own_ + expected_guests(own_));
  if (!room.ok()) return room.error();
  if (own_ != 0) BROADSIDE_TRY(copy_to_device(room.value(), boxes.data(), boxes.size_bytes()));
  BROADSIDE_TRY(faces_.upload(cut.faces, "faces of parts"));
  BROADSIDE_TRY(counts_.reserve(parts + 1, "counts of guests"));
  BROADSIDE_TRY(out_.reserve(expected_guests(own_) * parts, "guests"));
  reached_.assign(parts, 0);
  borders_.count = own_;
  borders_.axis = cut.axis;
  borders_.faces = faces_.data();
  borders_.part = part_;
  borders_.parts = parts;
  borders_.base = base;
  borders_.reached = counts_.data();
  return wait_for_device("copying the boxes of a part");
}

core::Status PartSearch::start_borders() {
  BROADSIDE_TRY(use_device(device_));
  guests_ = copied_ = 0;
  std::fill(reached_.begin(), reached_.end(), 0);
  if (part_ + 1 == borders_.parts || own_ == 0) return core::Done{};
  BROADSIDE_TRY(counts_.fill_bytes(0));
  BROADSIDE_TRY(wait_for_device("clearing counts of guests"));
  auto boxes = search_.room_for(own_);
  if (!boxes.ok()) return boxes.error();
  borders_.boxes = boxes.value();
  borders_.out = out_.data();
  borders_.capacity = out_.capacity() / borders_.parts;
  return launch_borders(borders_, stream_.get());
}

core::Result<bool> PartSearch::finish_borders() {
  if (part_ + 1 == borders_.parts || own_ == 0) return true;
  BROADSIDE_TRY(use_device(device_));
  BROADSIDE_TRY(stream_.wait("finding what reaches into other parts"));
  BROADSIDE_TRY(copy_to_host(reached_.data(), counts_.data(), reached_.size() * sizeof(unsigned long long)));
  const std::uint64_t most = *std::max_element(reached_.begin(), reached_.end());
  if (most <= borders_.capacity) return true;
  BROADSIDE_TRY(out_.reserve(most * borders_.parts, "guests"));
  return false;
}

core::Status PartSearch::make_room_for_guests(std::uint64_t count) {
  BROADSIDE_TRY(use_device(device_));
  guests_ = count;
  auto room = search_.move_to_room_for(own_ + guests_, own_, stream_.get());
  return room.ok() ? core::Status{core::Done{}} : core::Status{room.error()};
}

core::Status PartSearch::start_copy_from(const PartSearch& other) {
  const std::uint64_t count = other.reaching(part_);
  if (count == 0) return core::Done{};
  BROADSIDE_TRY(use_device(device_));
  auto room = search_.room_for(own_ + guests_);
  if (!room.ok()) return room.error();
  PackedBox* const to = room.value() + own_ + copied_;
  copied_ += count;
  return copy_between_devices(to, device_, other.out_.data() + part_ * other.borders_.capacity, other.device_,
                              count * sizeof(PackedBox), stream_.get());
}

core::Status PartSearch::start_search() {
  BoxFacts facts = facts_;
  facts.count = own_ + static_cast<std::uint32_t>(guests_);
  has_searched_ = facts.count > 1;
  if (!has_searched_) return core::Done{};
  BROADSIDE_TRY(use_device(device_));
  BROADSIDE_TRY(search_.load_packed(facts, options_, false));
  if (!search_.can_share())
    return core::Error{"a box is longer than 2^125 m", "a set that is spread over devices",
                       "search it by one device: leave out devices"};
  NamedPairsView share;
  share.names = {borders_.base, own_, own_};
  share.end_place = facts.count;
  return search_.launch_share(share, stream_.get());
}

core::Result<bool> PartSearch::finish_search() {
  if (!has_searched_) return true;
  BROADSIDE_TRY(use_device(device_));
  BROADSIDE_TRY(stream_.wait("finding pairs"));
  if (!search_.is_aborted()) return true;
  BROADSIDE_TRY(search_.grow());
  return false;
}

core::Status PartSearch::append_pairs(std::vector<core::Pair>& to) const {
  if (!has_searched_) return core::Done{};
  BROADSIDE_TRY(use_device(device_));
  return search_.append_pairs(to);
}

core::Result<std::uint64_t> PartSearch::digest() {
  if (!has_searched_) return std::uint64_t{0};
  BROADSIDE_TRY(use_device(device_));
  unsigned long long sum = 0;
  PairDigestView view;
  view.pairs = found().data;
  view.count = found().count;
  view.sum = counts_.data() + borders_.parts;
  BROADSIDE_TRY(copy_to_device(view.sum, &sum, sizeof sum));
  BROADSIDE_TRY(wait_for_device("clearing a digest"));
  BROADSIDE_TRY(launch_pair_digest(view, stream_.get()));
  BROADSIDE_TRY(stream_.wait("adding up a digest"));
  BROADSIDE_TRY(copy_to_host(&sum, view.sum, sizeof sum));
  return std::uint64_t{sum};
}

}  // namespace broadside::gpu
