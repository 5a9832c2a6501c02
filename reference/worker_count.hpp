// How many workers a `threads` setting means.
#pragma once

namespace broadside::reference {

// 0 = every core. Never more than there are cores: oneTBB complains aloud when asked for more.
int worker_count(unsigned long setting);

}  // namespace broadside::reference
