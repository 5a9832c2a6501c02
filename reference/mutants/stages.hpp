// The pipeline's stages as one table of functions: what a wrong engine replaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact.hpp"
#include "core/engine/broad_phase.hpp"
#include "core/material.hpp"
#include "core/method/contact_geometry.hpp"
#include "core/method/proximity.hpp"
#include "core/method/response.hpp"
#include "core/pair.hpp"
#include "core/parameters.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"
#include "reference/octree_cpu/bodies.hpp"

namespace broadside::reference {

// All that a stage may read. `bodies` is the pipeline's own; the rest is what one stage passes to the next.
struct World {
  const core::Scene* scene = nullptr;
  Bodies bodies;
  float dt_s = 0.0F;
  std::uint64_t step = 0;  // of the frame that is being made, from 1
  std::uint64_t run = 0;   // 0, 1, ...: lets a mutant differ from run to run
  core::PairSet candidates;
  std::vector<core::Pair> confirmed;
  std::vector<core::Proximity> proximity;
  std::vector<core::Contact> contacts;
  // The frame before, for stages that lag behind.
  std::vector<core::Kinematics> last_state;
  std::vector<core::Box> last_boxes;
  std::vector<core::Pair> last_pairs;
};

// One contact that is being applied, with the pre states in it; w: inverse masses.
struct Application {
  core::Contact& c;
  const core::ContactGeometry& g;
  float w_a;
  float w_b;
  const core::Material& m;
  const core::Parameters& p;

  // The sound response, with the given material and parameters, which may differ from the scene's.
  void apply(const core::Material& material, const core::Parameters& parameters) const {
    core::respond(c, g, w_a, w_b, material, parameters, core::Variant::kSound);
  }
  // change(core::Parameters&)
  template <typename Change>
  void apply_with(const Change& change) const {
    core::Parameters changed = p;
    change(changed);
    apply(m, changed);
  }
};

// Contacts of one frame in the order of application, colored.
struct Order {
  std::vector<core::Pair> pairs;
  std::vector<std::uint32_t> color;  // one per pair
};

// The defaults are the sound stages, and call what the pipeline calls: core/method's formulas, its scene octree, its
// coloring. With all of them, SerialPipeline and the pipeline give the same bits (tests/mutants).
struct Stages {
  core::Kinematics (*integrate)(const World&, std::uint32_t body, core::Vec3 acceleration) = nullptr;
  core::Box (*box)(const World&, std::uint32_t body) = nullptr;
  // After the sound candidates were found.
  void (*candidates)(World&) = nullptr;
  bool (*confirms)(const World&, core::Pair) = nullptr;
  core::Proximity (*nearest)(const World&, core::Pair, const core::Proximity& sound) = nullptr;
  void (*order)(const World&, Order&) = nullptr;
  core::ContactGeometry (*geometry)(const World&, core::Pair, const core::ContactGeometry& sound) = nullptr;
  core::ContactGeometry (*face_geometry)(const World&, std::uint32_t body, int face,
                                         const core::ContactGeometry& sound) = nullptr;
  core::Material (*combine)(const core::Material& a, const core::Material& b) = nullptr;
  // Fills the contact from the pre states in it.
  void (*respond)(const World&, const Application&) = nullptr;
  // Changes a contact before it is stored.
  void (*store)(const World&, core::Contact&) = nullptr;
  core::Vec3 (*clip)(core::Vec3 v, float v_max) = nullptr;
  // Changes the states before they become those of the frame's end.
  void (*end)(World&) = nullptr;
  // Changes what is recorded of the frame.
  void (*tell)(const World&, core::FrameRecord&) = nullptr;
  bool faces_first = false;
  bool moves_static = false;
};

}  // namespace broadside::reference
