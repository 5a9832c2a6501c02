/* A dynamics engine of version 2 whose bodies fly freely, right or wrong in one way, by its setting `fault`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "broadside_engine_v2.h"

enum {
  SOUND,
  ABSURD_COUNT,
  CLAIMS_MORE_POINTS,
  GROWS_FROM_CALL_TO_CALL,
  IMPULSE_IS_NAN,
  POINT_NAMES_NO_BODY,
  POINT_OF_ONE_BODY,
  WRITES_NO_STATES,
  WRITES_NO_DETECTION,
  PAIR_OF_NO_BODY,
  FAILS_IN_TWO_LINES,
  KNOWS_NO_SUCH_SHAPE,
  WRITES_BEHIND,
  NORMAL_IS_INFINITE
};

typedef struct {
  uint64_t fault;
  uint64_t calls;
  const char* error;
  uint32_t count;
  double gravity[3];
  broadside_state2 states[64];
  broadside_detection seen[64];
} world;

static void* create(const uint64_t* values) {
  world* w = calloc(1, sizeof *w);
  if (w != NULL) w->fault = values[0];
  return w;
}

static void destroy(void* self) {
  free(self);
}

static const char* last_error(void* self) {
  return self == NULL ? "out of memory" : ((world*)self)->error;
}

static int fail(world* w, const char* why) {
  w->error = why;
  return BROADSIDE_FAILED;
}

static int begin(void* self, const broadside_scene2* scene) {
  world* w = self;
  if (scene->size < sizeof *scene || scene->body_size < sizeof(broadside_body2)) return fail(w, "a scene too small");
  if (scene->body_count > 64) return fail(w, "too many bodies");
  if (w->fault == KNOWS_NO_SUCH_SHAPE && scene->shapes[0].kind == BROADSIDE_BOX) return fail(w, "unsupported: box");
  w->count = scene->body_count;
  memcpy(w->gravity, scene->gravity, sizeof w->gravity);
  for (uint32_t i = 0; i < w->count; ++i) {
    const broadside_body2* body = (const void*)((const char*)scene->bodies + i * scene->body_size);
    w->states[i] = body->state;
  }
  return BROADSIDE_OK;
}

/* Free flight, and no turning: scenes of tests give no spin. */
static int step(void* self, double h) {
  world* w = self;
  if (w->fault == FAILS_IN_TWO_LINES) return fail(w, "the moon\nis \033[31mfull\xff");
  for (uint32_t i = 0; i < w->count; ++i) {
    broadside_detection* seen = &w->seen[i];
    memcpy(seen->position, w->states[i].position, sizeof seen->position);
    memcpy(seen->orientation, w->states[i].orientation, sizeof seen->orientation);
    memcpy(seen->velocity, w->states[i].velocity, sizeof seen->velocity);
    for (int k = 0; k < 3; ++k) {
      seen->box.min[k] = nextafterf((float)(seen->position[k] - 0.5), -HUGE_VALF);
      seen->box.max[k] = nextafterf((float)(seen->position[k] + 0.5), HUGE_VALF);
      w->states[i].position[k] += h * (w->states[i].velocity[k] + 0.5 * h * w->gravity[k]);
      w->states[i].velocity[k] += h * w->gravity[k];
    }
  }
  return BROADSIDE_OK;
}

static int read_states(void* self, broadside_state2* states, uint32_t count) {
  world* w = self;
  if (w->fault == WRITES_BEHIND) states[count] = w->states[0];
  if (w->fault != WRITES_NO_STATES) memcpy(states, w->states, count * sizeof *states);
  return BROADSIDE_OK;
}

static int read_points(void* self, broadside_point* points, uint64_t capacity, uint64_t* demanded) {
  world* w = self;
  const int is_wrong = w->fault >= CLAIMS_MORE_POINTS && w->fault <= POINT_OF_ONE_BODY;
  *demanded = is_wrong || w->fault == NORMAL_IS_INFINITE ? 1 : 0;
  if (w->fault == ABSURD_COUNT) *demanded = (uint64_t)1 << 60;
  if (w->fault == GROWS_FROM_CALL_TO_CALL) *demanded = capacity + 1;
  if (*demanded != 1 || capacity < 1) return BROADSIDE_OK;
  broadside_point point = {.a = 0, .b = BROADSIDE_FIRST_FACE + 2, .normal = {0, 1, 0}, .gap = 1.0};
  if (w->fault == IMPULSE_IS_NAN) point.impulse[1] = NAN;
  if (w->fault == POINT_NAMES_NO_BODY) point.b = w->count;
  if (w->fault == POINT_OF_ONE_BODY) point.b = 0;
  if (w->fault == NORMAL_IS_INFINITE) point.normal[2] = HUGE_VAL;
  if (w->fault != CLAIMS_MORE_POINTS) points[0] = point;
  return BROADSIDE_OK;
}

static int read_detection(void* self, broadside_detection* bodies, uint32_t count) {
  world* w = self;
  if (w->fault != WRITES_NO_DETECTION) memcpy(bodies, w->seen, count * sizeof *bodies);
  return BROADSIDE_OK;
}

static int read_step_pairs(void* self, broadside_pair* pairs, uint64_t capacity, uint64_t* demanded) {
  world* w = self;
  *demanded = w->fault == PAIR_OF_NO_BODY ? 1 : 0;
  const broadside_pair pair = {0, w->count};
  if (*demanded == 1 && capacity > 0) pairs[0] = pair;
  return BROADSIDE_OK;
}

const broadside_engine2* broadside_engine_v2(void) {
  static const broadside_setting settings[] = {{"fault", 0, "what is wrong; 0 = nothing"},
                                               {"sweeps", 3, "it declares so many iterations"}};
  static const broadside_declared declared[] = {
      {"contacts", "totals"}, {"detection_at", "start"}, {"iterations", "setting:sweeps"}};
  static const broadside_engine2 engine = {
      .abi = BROADSIDE_ENGINE_ABI_2,
      .size = sizeof(broadside_engine2),
      .id = "wrong-world",
      .build = "test 1, double",
      .what = "wrong on demand",
      .is_exact = 1,
      .settings = settings,
      .setting_count = 2,
      .declared = declared,
      .declared_count = 3,
      .create = create,
      .destroy = destroy,
      .last_error = last_error,
      .begin = begin,
      .step = step,
      .read_states = read_states,
      .read_points = read_points,
      .read_detection = read_detection,
      .read_step_pairs = read_step_pairs,
  };
  return &engine;
}
