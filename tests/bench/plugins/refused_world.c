/* Tables of version 2 that are refused, or that are of a later or an earlier header, one by one, by macros. */
#include <stddef.h>

#include "broadside_engine_v2.h"

static void* create(const uint64_t* values) {
  return (void*)values;
}
static void destroy(void* self) {
  (void)self;
}
static const char* last_error(void* self) {
  return self == NULL ? "" : "";
}
static int begin(void* self, const broadside_scene2* scene) {
  return self == NULL || scene == NULL;
}
static int step(void* self, double dt) {
  return self == NULL || dt == 0.0;
}
static int read_states(void* self, broadside_state2* states, uint32_t count) {
  return self == NULL || states == NULL || count == 0;
}

/* What a later header appends. */
typedef struct {
  broadside_engine2 known;
  void* later[4];
} larger;

const broadside_engine2* broadside_engine_v2(void) {
  static const broadside_declared declared[] = {
#if defined(UNKNOWN_WORD)
    {"friction", "con"},
#elif defined(UNKNOWN_KEY)
    {"frictoin", "cone"},
#elif defined(UNKNOWN_SETTING)
    {"substeps", "setting:sweeps"},
#elif defined(DECLARED_TWICE)
    {"order", "1"},
    {"order", "2"},
#elif defined(NO_POINTS)
    {"contacts", "totals"},
#else
    {"motion", "rigid"},
#endif
  };
  static const larger table = {
      .known =
          {
#ifdef OF_VERSION_3
              .abi = 3,
#else
              .abi = BROADSIDE_ENGINE_ABI_2,
#endif
#if defined(TOO_SMALL)
              .size = 64,
#elif defined(LARGER)
              .size = sizeof(larger),
#else
              .size = sizeof(broadside_engine2),
#endif
              .id = "refused-world",
#ifdef NO_TEXT
              .build = "two\nlines",
#else
              .build = "test",
#endif
              .what = "",
              .declared = declared,
              .declared_count = sizeof declared / sizeof *declared,
              .create = create,
              .destroy = destroy,
              .last_error = last_error,
              .begin = begin,
              .step = step,
#ifndef HALF_WORLD
              .read_states = read_states,
#endif
          },
      .later = {(void*)create},
  };
  return &table.known;
}
