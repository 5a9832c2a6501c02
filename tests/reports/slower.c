/* Preloaded into a program, it makes everything between two looks at the clock take a tenth longer, by work and not by
   a wrong clock: a thread that asks for the time first spins for a tenth of what went by since it asked last. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>

typedef int (*Clock)(clockid_t, struct timespec*);

/* The C library's own clock, which makes no system call: one would cost more than the tenth. */
static Clock real(void) {
  static Clock clock;
  if (!clock) clock = (Clock)dlsym(RTLD_NEXT, "clock_gettime");
  return clock;
}

static long long now_ns(void) {
  struct timespec t;
  real()(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1000000000LL + t.tv_nsec;
}

int clock_gettime(clockid_t id, struct timespec* out) {
  static _Thread_local long long last = 0;
  if (id == CLOCK_MONOTONIC) {
    const long long start = now_ns();
    const long long end = start + (last == 0 ? 0 : (start - last) / 10);
    while ((last = now_ns()) < end) {
    }
  }
  return real()(id, out);
}
