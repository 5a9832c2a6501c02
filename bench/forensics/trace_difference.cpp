#include "bench/forensics/trace_difference.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace broadside::bench {
namespace {

constexpr std::uint64_t kHistoryFrames = 10;

// The digest of the scene without its length: runs of 100 and of 200 frames are of one scene here.
std::uint64_t endless_digest(core::Scene scene) {
  scene.frames = 1;
  return core::scene_digest(scene);
}

core::Status check_same_scene(const core::TraceReader& a, const core::TraceReader& b) {
  const core::Scene& p = a.header().scene;
  const core::Scene& q = b.header().scene;
  if (endless_digest(p) == endless_digest(q)) return core::Done{};
  return core::Error{
      fmt::format("the two traces are of different scenes ({}, {} bodies, {:#018x}; {}, {} bodies, {:#018x})", p.name,
                  p.body_count(), endless_digest(p), q.name, q.body_count(), endless_digest(q)),
      a.path().string() + " and " + b.path().string(), "record both from one scene"};
}

// Digests can be compared when both traces hold the same groups, and both engines simulated or both were driven by
// another trace. Traces of other programs may leave the digest at zero.
bool have_one_digest(const core::TraceReader& a, const core::TraceReader& b) {
  const auto is_zero = [](std::uint64_t d) { return d == 0; };
  const auto& p = a.digests();
  const auto& q = b.digests();
  return a.header().groups == b.header().groups && a.header().driver.empty() == b.header().driver.empty() &&
         !std::all_of(p.begin(), p.end(), is_zero) && !std::all_of(q.begin(), q.end(), is_zero);
}

std::vector<std::string> group_paths(std::uint32_t groups) {
  std::vector<std::string> paths;
  for (const core::GroupRow& row : core::group_rows())
    if ((groups & core::bit(row.group)) != 0) paths.emplace_back(row.path);
  return paths;
}

std::vector<DeclaredDifference> declared_differences(const core::Declaration& a, const core::Declaration& b) {
  std::vector<DeclaredDifference> found;
  const auto text_of = [](const core::Declaration& d, std::string_view key) {
    return d.declares(key) ? std::string(d.text(key)) : std::string("not declared");
  };
  for (const core::DeclarationKey& row : core::declaration_keys())
    if (text_of(a, row.key) != text_of(b, row.key))
      found.push_back({std::string(row.key), text_of(a, row.key), text_of(b, row.key)});
  return found;
}

class Comparer {
 public:
  Comparer(const core::TraceReader& a, const core::TraceReader& b, DifferenceRule& rule)
      : a_(a), b_(b), rule_(rule), groups_(a.header().groups & b.header().groups & rule.groups()) {
    const std::uint32_t p = a.header().groups & rule.groups();
    const std::uint32_t q = b.header().groups & rule.groups();
    found_.groups = group_paths(groups_);
    found_.groups_only_in_a = group_paths(p & ~q);
    found_.groups_only_in_b = group_paths(q & ~p);
    found_.declared = declared_differences(a.header().declaration, b.header().declaration);
    constexpr std::uint32_t kBodies = core::bit(core::Group::kBodies);
    constexpr std::uint32_t kWide = core::bit(core::Group::kWideBodies);
    found_.is_narrowed = (groups_ & kBodies) != 0 && (p & kWide) != (q & kWide);
    found_.has_digests = rule.includes_bookkeeping() && have_one_digest(a, b);
  }

  core::Result<TraceDifference> run(const std::function<void(std::uint64_t)>& progress) {
    if (groups_ == 0 && !found_.has_digests)
      return core::Error{"the two traces have nothing recorded that could be compared",
                         a_.path().string() + " and " + b_.path().string(), "record both with --record full"};
    match_steps();
    if (steps_.empty())
      return core::Error{"the two traces have no step in common", a_.path().string() + " and " + b_.path().string(),
                         "record both with the same --every"};
    for (std::size_t k = 0; k < steps_.size() && !found_.first; ++k) {
      if (core::Status s = compare_step(k); !s) return s.error();
      if (progress) progress(k + 1);
    }
    return found_;
  }

 private:
  struct Step {
    std::uint64_t in_a;
    std::uint64_t in_b;
  };

  void match_steps() {
    const auto& p = a_.steps();
    const auto& q = b_.steps();
    for (std::size_t i = 0, j = 0; i < p.size() || j < q.size();) {
      if (j == q.size() || (i < p.size() && p[i] < q[j])) {
        ++found_.only_in_a, ++i;
      } else if (i == p.size() || q[j] < p[i]) {
        ++found_.only_in_b, ++j;
      } else {
        if (found_.has_digests && a_.digests()[i] != b_.digests()[j]) ++found_.other_digests;
        steps_.push_back({i++, j++});
      }
    }
    found_.common_steps = steps_.size();
  }

  core::Status compare_step(std::size_t k) {
    auto p = a_.read(steps_[k].in_a, groups_);
    if (!p) return p.error();
    auto q = b_.read(steps_[k].in_b, groups_);
    if (!q) return q.error();
    rule_.enter(p.value(), q.value());
    const auto bookkeeping = !rule_.includes_bookkeeping() ? core::Bookkeeping::kIgnored
                             : found_.has_digests          ? core::Bookkeeping::kCountsAndDigest
                                                           : core::Bookkeeping::kCounts;
    found_.first = core::first_difference(p.value(), q.value(), groups_, bookkeeping,
                                          [this](const core::FrameDifference& d) { return rule_.passes(d); });
    if (!found_.first) {
      ++found_.equal_steps;
      return core::Done{};
    }
    found_.step = p.value().step;
    return tell_history(k);
  }

  core::Status tell_history(std::size_t k) {
    using core::Group;
    found_.has_history = (a_.header().groups & core::bit(Group::kContacts)) != 0;
    found_.has_points = (a_.header().groups & core::bit(Group::kPoints)) != 0;
    constexpr std::uint32_t kHistory = core::bit(Group::kContacts) | core::bit(Group::kPoints);
    if ((a_.header().groups & kHistory) == 0 || found_.first->body_count == 0) return core::Done{};
    for (std::size_t at = k > kHistoryFrames ? k - kHistoryFrames : 0; at <= k; ++at) {
      auto p = a_.read(steps_[at].in_a, kHistory);
      if (!p) return p.error();
      take_history(p.value(), false);
    }
    if ((b_.header().groups & kHistory) == 0) return core::Done{};
    auto q = b_.read(steps_[k].in_b, kHistory);
    if (!q) return q.error();
    take_history(q.value(), true);
    return core::Done{};
  }

  void take_history(const core::FrameRecord& frame, bool is_of_b) {
    const auto concerns = [this](std::uint32_t body) {
      const auto& d = *found_.first;
      return !core::is_face(body) &&
             std::find(d.bodies.begin(), d.bodies.begin() + d.body_count, body) != d.bodies.begin() + d.body_count;
    };
    for (const core::Contact& c : frame.contacts)
      if (concerns(c.a) || concerns(c.b)) found_.history.push_back({frame.step, is_of_b, c});
    for (const core::ContactPoint& p : frame.points)
      if (concerns(p.a) || concerns(p.b)) found_.points.push_back({frame.step, is_of_b, p});
  }

  const core::TraceReader& a_;
  const core::TraceReader& b_;
  DifferenceRule& rule_;
  std::uint32_t groups_;
  std::vector<Step> steps_;
  TraceDifference found_;
};

}  // namespace

core::Result<TraceDifference> compare_traces(const core::TraceReader& a, const core::TraceReader& b,
                                             DifferenceRule* rule, const std::function<void(std::uint64_t)>& progress) {
  if (core::Status s = check_same_scene(a, b); !s) return s.error();
  DifferenceRule bits;
  return Comparer(a, b, rule != nullptr ? *rule : bits).run(progress);
}

}  // namespace broadside::bench
