// What the engines whose stages are those of RIGID 8 say of themselves where bodies turn.
#pragma once

#include <string_view>

#include "core/engine/declaration.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

// Of the steps of this scene. twin_of: empty, or the engine whose bits it repeats.
Declaration rigid_declaration(const SoftSettings& solver, const Scene& scene, std::string_view twin_of = {});

// The same where bodies sleep (core/method/rigid/sleep.hpp): what stands below this speed may be stopped. 0 = nobody.
Declaration with_sleep(const Declaration& declaration, float sleep_speed_m_s);

}  // namespace broadside::core
