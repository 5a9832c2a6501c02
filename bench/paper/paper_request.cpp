#include "bench/paper/paper_request.hpp"

#include <nlohmann/json.hpp>

namespace broadside::bench::paper {

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
                                 .counts = j.at("counts"),
                                 .frames = j.at("frames"),
                                 .runs = j.at("runs"),
                                 .limit_s = j.at("limit_s")},
                        .device = {j.at("octree"), j.at("hash"), j.at("beside_hash"), j.at("device")},
                        .machine = j.at("machine"),
                        .allow_stand_in = j.at("stand_in"),
                        .keeps_traces = j.at("keeps_traces")};
  } catch (const nlohmann::json::exception& e) {
    return core::Error{std::string("the paper's part is damaged: ") + e.what(), "manifest.json", "plan it again"};
  }
}

}  // namespace broadside::bench::paper
