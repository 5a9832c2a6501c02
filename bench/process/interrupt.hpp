// Ctrl-C and SIGTERM set a flag, which is read between frames, so that what was recorded stays readable.
#pragma once

namespace broadside::bench {

// From now on both signals set a flag. A program that does not read the flag is ended after 0.6 s, one that has read it
// after 10 s.
void watch_for_interrupt();
bool is_interrupted();

}  // namespace broadside::bench
