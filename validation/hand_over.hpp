// Hand-over: within a frame of the method each contact goes on from the state that the body's last contact left, the
// frame ends in the last one, and no body ends outside a face without a contact with it. Part of state-sanity.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"
#include "validation/application.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {

class HandOver {
 public:
  // local: each body's box relative to its position. All outlive this.
  HandOver(const core::TraceHeader& header, const ContactBodies& bodies, const std::vector<core::Box>& local);

  // A frame with an entry for every body in its states and detection states.
  void look(const core::FrameRecord& frame);

  [[nodiscard]] const Tally& hand_over() const { return hand_over_; }
  [[nodiscard]] const Tally& domain() const { return domain_; }
  // How many bodies ended outside by more than the slop with their face contact recorded; empty when none did.
  [[nodiscard]] std::string notes() const;

 private:
  void judge_chain(const core::FrameRecord& frame);
  void link(const core::Kinematics& pre, const core::Kinematics& post, std::uint32_t body);
  void judge_domain(const core::FrameRecord& frame);
  void judge_face(core::Vec3 x, std::uint32_t body, std::uint32_t face);

  const core::Scene& scene_;
  const ContactBodies& bodies_;
  const std::vector<core::Box>& local_;
  std::vector<core::Kinematics> state_;
  std::vector<std::uint32_t> met_;
  std::uint64_t step_ = 0;
  std::uint64_t outside_ = 0;
  double deepest_m_ = 0.0;
  Tally hand_over_;
  Tally domain_;
};

}  // namespace broadside::validation
