// What the engines whose stages are those of RIGID 8 say of themselves where bodies turn.
#pragma once

#include <string_view>

#include "core/engine/declaration.hpp"
#include "core/method/rigid/soft_settings.hpp"

namespace broadside::core {

// twin_of: empty, or the engine whose bits it repeats. largest_mass_ratio: of the scene's bodies that move.
Declaration rigid_declaration(const SoftSettings& solver, float largest_mass_ratio, std::string_view twin_of = {});

// The same where bodies sleep (core/method/rigid/sleep.hpp): what stands below this speed may be stopped. 0 = nobody.
Declaration with_sleep(const Declaration& declaration, float sleep_speed_m_s);

}  // namespace broadside::core
