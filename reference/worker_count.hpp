// The setting `threads`, and how many workers a value of it means.
#pragma once

#include "core/engine/settings.hpp"

namespace broadside::reference {

// 0 = every core. Never more than there are cores: oneTBB prints a warning when asked for more.
int worker_count(unsigned long setting);

// The row of this setting in the table of an engine whose answers do not depend on it.
core::SettingRow threads_setting();

}  // namespace broadside::reference
