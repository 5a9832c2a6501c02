#include "gpu/broad/part_search.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace broadside::gpu {
namespace {

// Of n boxes in a cube some n^(2/3) reach over a face. If there are more, the search for them is repeated.
std::uint64_t expected_guests(std::uint64_t boxes) {
  const double side = std::cbrt(static_cast<double>(boxes));
  return 1024 + static_cast<std::uint64_t>(2.0 * side * side);
}

}  // namespace

core::Status PartSearch::load(const DealtBoxes& dealt, const core::SpaceCut& cut, const PartOptions& options) {
  BROADSIDE_TRY(use_device(device_));
  BROADSIDE_TRY(stream_.create());
  const std::span<const PackedBox> boxes = dealt.boxes(part_);
  const std::span<const PackedBox> given = dealt.given_boxes(part_);
  own_ = static_cast<std::uint32_t>(boxes.size());
  facts_ = dealt.facts(part_);
  has_searched_ = false;
  is_pass_ = options.is_pass;
  owned_ = options.owned;
  options_.has_shares = true;
  options_.pairs_at_once = options.pairs_at_once;
  const std::uint32_t parts = cut.parts();
  auto room = search_.room_for(own_ + expected_guests(own_));
  if (!room.ok()) return room.error();
  if (own_ != 0) BROADSIDE_TRY(copy_to_device(room.value(), boxes.data(), boxes.size_bytes()));
  if (is_pass_) {
    auto as_given = search_.room_for_given(own_ + expected_guests(own_), 0, stream_.get());
    if (!as_given.ok()) return as_given.error();
    if (own_ != 0) BROADSIDE_TRY(copy_to_device(as_given.value(), given.data(), given.size_bytes()));
  }
  BROADSIDE_TRY(faces_.upload(cut.faces, "faces of parts"));
  BROADSIDE_TRY(counts_.reserve(parts + 1, "counts of guests"));
  borders_ = {};
  borders_.count = own_;
  borders_.axis = cut.axis;
  borders_.faces = faces_.data();
  borders_.part = part_;
  borders_.parts = parts;
  borders_.base = dealt.base(part_);
  borders_.reached = counts_.data();
  BROADSIDE_TRY(reserve_guests(expected_guests(own_)));
  reached_.assign(parts, 0);
  return wait_for_device("copying the boxes of a part");
}

core::Status PartSearch::reserve_guests(std::uint64_t of_each_part) {
  BROADSIDE_TRY(out_.reserve(of_each_part * borders_.parts, "guests"));
  if (is_pass_) BROADSIDE_TRY(given_out_.reserve(out_.capacity(), "guests as given"));
  return core::Done{};
}

core::Status PartSearch::start_borders(Numbers numbers) {
  BROADSIDE_TRY(use_device(device_));
  guests_ = copied_ = 0;
  numbers_ = numbers;
  std::fill(reached_.begin(), reached_.end(), 0);
  if (part_ + 1 == borders_.parts || own_ == 0) return core::Done{};
  BROADSIDE_TRY(counts_.fill_bytes(0));
  BROADSIDE_TRY(wait_for_device("clearing counts of guests"));
  auto boxes = search_.room_for(own_);
  if (!boxes.ok()) return boxes.error();
  borders_.boxes = boxes.value();
  borders_.out = out_.data();
  borders_.capacity = out_.capacity() / borders_.parts;
  borders_.keeps_names = numbers == Numbers::kCallers;
  if (is_pass_) {
    auto as_given = search_.room_for_given(own_, own_, stream_.get());
    if (!as_given.ok()) return as_given.error();
    borders_.given = as_given.value();
    borders_.given_out = given_out_.data();
  }
  return launch_borders(borders_, stream_.get());
}

core::Result<bool> PartSearch::finish_borders() {
  if (part_ + 1 == borders_.parts || own_ == 0) return true;
  BROADSIDE_TRY(use_device(device_));
  BROADSIDE_TRY(stream_.wait("finding what reaches into other parts"));
  BROADSIDE_TRY(copy_to_host(reached_.data(), counts_.data(), reached_.size() * sizeof(unsigned long long)));
  const std::uint64_t most = *std::max_element(reached_.begin(), reached_.end());
  if (most <= borders_.capacity) return true;
  BROADSIDE_TRY(reserve_guests(most));
  return false;
}

core::Status PartSearch::make_room_for_guests(std::uint64_t count) {
  BROADSIDE_TRY(use_device(device_));
  guests_ = count;
  auto room = search_.move_to_room_for(own_ + guests_, own_, stream_.get());
  if (!room.ok() || !is_pass_) return room.ok() ? core::Status{core::Done{}} : core::Status{room.error()};
  room = search_.room_for_given(own_ + guests_, own_, stream_.get());
  return room.ok() ? core::Status{core::Done{}} : core::Status{room.error()};
}

core::Status PartSearch::start_copy_from(const PartSearch& other) {
  const std::uint64_t count = other.reaching(part_);
  if (count == 0) return core::Done{};
  BROADSIDE_TRY(use_device(device_));
  const std::uint64_t from = part_ * other.borders_.capacity;
  const std::uint64_t to = own_ + copied_;
  const std::uint64_t bytes = count * sizeof(PackedBox);
  copied_ += count;
  auto room = search_.room_for(own_ + guests_);
  if (!room.ok()) return room.error();
  BROADSIDE_TRY(
      copy_between_devices(room.value() + to, device_, other.out_.data() + from, other.device_, bytes, stream_.get()));
  if (!is_pass_) return core::Done{};
  room = search_.room_for_given(own_ + guests_, own_ + guests_, stream_.get());
  if (!room.ok()) return room.error();
  return copy_between_devices(room.value() + to, device_, other.given_out_.data() + from, other.device_, bytes,
                              stream_.get());
}

PairNames PartSearch::names() const {
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  if (is_pass_) return {0, kNone, own_};  // the search's own numbers: settling turns them into the caller's
  if (numbers_ == Numbers::kCallers) return {0, 0, own_};
  return {borders_.base, own_, own_};
}

core::Status PartSearch::prepare_search() {
  BoxFacts facts = facts_;
  facts.count = own_ + static_cast<std::uint32_t>(guests_);
  has_searched_ = facts.count > 1;
  if (!has_searched_) return core::Done{};
  BROADSIDE_TRY(use_device(device_));
  BROADSIDE_TRY(search_.load_packed(facts, options_, false));
  if (is_pass_) BROADSIDE_TRY(search_.settle_on_given(owned_, options_));
  if (search_.can_share()) return core::Done{};
  return core::Error{"a box is longer than 2^125 m", "a set that is spread over devices",
                     "search it by one device: leave out devices"};
}

core::Status PartSearch::start_search() {
  BROADSIDE_TRY(prepare_search());
  if (!has_searched_) return core::Done{};
  NamedPairsView share;
  share.names = names();
  share.end_place = search_.box_count();
  return search_.launch_share(share, stream_.get());
}

core::Status PartSearch::hand_on(const ChunkConsumer& take) {
  BROADSIDE_TRY(prepare_search());
  if (!has_searched_) return core::Done{};
  std::uint64_t launches = 0;
  return for_each_chunk(search_, stream_, take, launches, names());
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
