/* Dynamics of version 1: bodies fall by METHOD's step, in float32. With BOTH the library exports version 2 too, and
 * gives no table for it. */
#include <stdlib.h>
#include <string.h>

#include "broadside_engine_v2.h"

typedef struct {
  uint32_t count;
  float gravity[3];
  broadside_state states[64];
} world;

static void* create(const uint64_t* values) {
  (void)values;
  return calloc(1, sizeof(world));
}
static void destroy(void* self) {
  free(self);
}
static const char* last_error(void* self) {
  return self == NULL ? "out of memory" : "too many bodies";
}

static int begin(void* self, const broadside_scene* scene) {
  world* w = self;
  if (scene->body_count > 64) return BROADSIDE_FAILED;
  w->count = scene->body_count;
  memcpy(w->gravity, scene->gravity, sizeof w->gravity);
  for (uint32_t i = 0; i < w->count; ++i) w->states[i] = scene->bodies[i].state;
  return BROADSIDE_OK;
}

static int step(void* self, float dt) {
  world* w = self;
  for (uint32_t i = 0; i < w->count; ++i)
    for (int k = 0; k < 3; ++k) {
      w->states[i].velocity[k] += dt * w->gravity[k];
      w->states[i].position[k] += dt * w->states[i].velocity[k];
    }
  return BROADSIDE_OK;
}

static int read_states(void* self, broadside_state* states, uint32_t count) {
  memcpy(states, ((world*)self)->states, count * sizeof *states);
  return BROADSIDE_OK;
}

const broadside_engine* broadside_engine_v1(void) {
  static const broadside_engine engine = {
      .abi = BROADSIDE_ENGINE_ABI,
      .size = sizeof(broadside_engine),
      .id = "falling",
      .build = "test 1, float",
      .what = "bodies that fall",
      .create = create,
      .destroy = destroy,
      .last_error = last_error,
      .begin = begin,
      .step = step,
      .read_states = read_states,
  };
  return &engine;
}

#ifdef BOTH
const broadside_engine2* broadside_engine_v2(void) {
  return NULL;
}
#endif
