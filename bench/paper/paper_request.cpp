#include "bench/paper/paper_request.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "bench/cell/json_number.hpp"

namespace broadside::bench::paper {
namespace {

constexpr std::uint32_t kMostRequestFrames = 1'000'000'000;
constexpr std::uint32_t kMostRequestRuns = 10'000;
constexpr double kLongestRequestLimit_s = 1e7;

std::vector<std::uint32_t> counts_of(const nlohmann::json& list) {
  std::vector<std::uint32_t> counts;
  for (const nlohmann::json& count : list)
    counts.push_back(whole_number({{"counts", count}}, "counts", 1, std::numeric_limits<std::uint32_t>::max()));
  return counts;
}

}  // namespace

std::string text_of(const PaperRequest& r) {
  return nlohmann::json{
      {"experiments", r.experiments},  {"models", r.plan.models}, {"counts", r.plan.counts},
      {"frames", r.plan.frames},       {"runs", r.plan.runs},     {"limit_s", r.plan.limit_s},
      {"octree", r.device.octree},     {"hash", r.device.hash},   {"beside_hash", r.device.beside_hash},
      {"device", r.device.words},      {"machine", r.machine},    {"stand_in", r.allow_stand_in},
      {"keeps_traces", r.keeps_traces}}
      .dump();
}

core::Result<PaperRequest> request_from(std::string_view text) {
  try {
    const nlohmann::json j = nlohmann::json::parse(text);
    return PaperRequest{.experiments = j.at("experiments"),
                        .plan = {.models = j.at("models"),
                                 .counts = counts_of(j.at("counts")),
                                 .frames = whole_number(j, "frames", 1, kMostRequestFrames),
                                 .runs = whole_number(j, "runs", 1, kMostRequestRuns),
                                 .limit_s = positive_number(j, "limit_s", kLongestRequestLimit_s)},
                        .device = {j.at("octree"), j.at("hash"), j.at("beside_hash"), j.at("device")},
                        .machine = j.at("machine"),
                        .allow_stand_in = j.at("stand_in"),
                        .keeps_traces = j.at("keeps_traces")};
  } catch (const RefusedNumber& refused) {
    return core::Error{"the paper's part is damaged: " + refused.what, "manifest.json", "plan it again"};
  } catch (const nlohmann::json::exception& e) {
    return core::Error{std::string("the paper's part is damaged: ") + e.what(), "manifest.json", "plan it again"};
  }
}

}  // namespace broadside::bench::paper
