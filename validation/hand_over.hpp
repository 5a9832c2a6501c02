// Hand-over: within a frame of the method each contact starts from the state that the body's last contact left, the
// frame ends in the state after the last contact, and no body ends outside a face without a contact with it. Contacts
// of two bodies that are summed (solver=jacobi) all start from what was seen, and their changes are added before the
// faces. Part of state-sanity.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/box.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"
#include "validation/application.hpp"
#include "validation/tally.hpp"
#include "validation/vec3d.hpp"

namespace broadside::validation {

class HandOver {
 public:
  // local: each body's box relative to its position. All outlive this.
  HandOver(const core::TraceHeader& header, const ContactBodies& bodies, const std::vector<core::Box>& local,
           bool is_summed);

  // A frame with an entry for every body in its states and detection states.
  void look(const core::FrameRecord& frame);

  [[nodiscard]] const Tally& hand_over() const { return hand_over_; }
  [[nodiscard]] const Tally& domain() const { return domain_; }
  // How many bodies ended outside by more than the slop with their face contact recorded; empty when none did.
  [[nodiscard]] std::string notes() const;

 private:
  // Where a body stands when its next contact comes, and how far rounding may have taken it from there.
  struct Stand {
    Vec3d x;
    Vec3d v;
    double x_error_m = 0.0;
    double v_error_m_s = 0.0;
  };

  void judge_chain(const core::FrameRecord& frame);
  void add_up(const core::FrameRecord& frame);
  void judge_end(const core::FrameRecord& frame, std::uint32_t body);
  void link(const core::Kinematics& pre, const core::Kinematics& post, std::uint32_t body);
  void judge_domain(const core::FrameRecord& frame);
  void judge_face(core::Vec3 x, std::uint32_t body, std::uint32_t face);

  const core::Scene& scene_;
  const ContactBodies& bodies_;
  const std::vector<core::Box>& local_;
  bool is_summed_;
  std::string_view chain_;  // where its limits come from
  std::vector<Stand> stand_;
  std::vector<std::uint32_t> met_;
  std::uint64_t step_ = 0;
  std::uint64_t outside_ = 0;
  double deepest_m_ = 0.0;
  Tally hand_over_;
  Tally domain_;
};

}  // namespace broadside::validation
