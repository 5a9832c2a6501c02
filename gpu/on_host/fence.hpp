// The device's fence on fibers, which never run side by side.
#pragma once

inline void __threadfence() {}
