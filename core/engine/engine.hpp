// A named thing that offers one or more capabilities, and how tables list it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "core/engine/declaration.hpp"
#include "core/engine/dynamics.hpp"
#include "core/engine/equivalence.hpp"
#include "core/engine/narrow_phase.hpp"
#include "core/engine/settings.hpp"
#include "core/result.hpp"

namespace broadside::core {

struct Engine {
  std::string id;
  std::string build;  // library and version really loaded, precision, SIMD: "Bullet 3.24, float"
  Settings settings;
  Declaration declaration;                    // what its dynamics declares
  std::unique_ptr<BroadPhase> broad_phase;    // null = not offered
  std::unique_ptr<NarrowPhase> narrow_phase;  // null = not offered
  std::unique_ptr<Dynamics> dynamics;         // null = not offered
  // How its world differs from this scene; null = nothing to say besides its build. May be called at any time after
  // construction.
  std::function<EquivalenceCard(const Scene&)> equivalence;
  // Known defects of its library and how often they were met since construction; null = none are known.
  std::function<std::vector<DefectHits>()> defects;
};

// One row per engine in the one table (reference/engines.inc, bench/engines.cpp). A row exists also where the engine
// cannot run on this machine; then absent() says why ("not measured: no device") and create is not called.
struct EngineRow {
  std::string_view id;
  std::string_view capabilities;  // "broad narrow dynamics", for listings
  std::string_view what;
  std::span<const SettingRow> settings;
  // Whether recording, timing and pair queries run in a child process, because engines built on other libraries may
  // abort or hang. False for this project's own pipelines, including the CPU twin.
  bool runs_in_child = true;
  Result<Engine> (*create)(const Settings& settings) = nullptr;
  // Why it cannot run here; empty when it can.
  std::string (*absent)() = nullptr;
};

}  // namespace broadside::core
