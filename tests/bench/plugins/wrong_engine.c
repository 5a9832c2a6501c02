/* An engine that is right or wrong in one way, by its setting `fault`. */
#include <stdlib.h>
#include <string.h>

#include "broadside_engine.h"

enum {
  SOUND,
  CRASH,
  HANG,
  OUT_OF_RANGE,
  WRONG_ORDER,
  ITSELF,
  CLAIMS_MORE,
  WRITES_BEHIND,
  WRITES_INPUT,
  DROPS_A_PAIR,
  TWICE,
  ABSURD_COUNT,
  FAILS_WITH_WORDS,
  FAILS_WITHOUT,
  KEEPS_GROWING
};

typedef struct {
  uint64_t fault;
  uint32_t count;
  broadside_box boxes[4096];
  broadside_pair pairs[65536];
  uint64_t pair_count;
} engine;

static void* create(const uint64_t* values) {
  engine* e = calloc(1, sizeof *e);
  if (e != NULL) e->fault = values[0];
  return e;
}

static void destroy(void* self) {
  free(self);
}

static const char* last_error(void* self) {
  return self != NULL && ((engine*)self)->fault == FAILS_WITH_WORDS ? "the moon is full" : "";
}

static int update_boxes(void* self, const broadside_box* boxes, uint32_t count) {
  engine* e = self;
  if (e->fault == WRITES_INPUT && count > 0) ((broadside_box*)boxes)[0].min[0] = 0;
  memcpy(e->boxes, boxes, count * sizeof *boxes);
  return BROADSIDE_OK;
}

static int load_boxes(void* self, const broadside_box* boxes, const uint8_t* is_static, uint32_t count) {
  engine* e = self;
  (void)is_static;
  if (count > 4096) return BROADSIDE_FAILED;
  e->count = count;
  return update_boxes(self, boxes, count);
}

static int overlap(const broadside_box* a, const broadside_box* b) {
  for (int k = 0; k < 3; ++k)
    if (a->min[k] > b->max[k] || b->min[k] > a->max[k]) return 0;
  return 1;
}

static int find_pairs(void* self) {
  engine* e = self;
  if (e->fault == CRASH) abort();
  if (e->fault == HANG)
    for (volatile int forever = 1; forever;) {
    }
  if (e->fault == FAILS_WITH_WORDS || e->fault == FAILS_WITHOUT) return BROADSIDE_FAILED;
  e->pair_count = 0;
  for (uint32_t i = 0; i < e->count; ++i)
    for (uint32_t j = i + 1; j < e->count; ++j)
      if (overlap(&e->boxes[i], &e->boxes[j]) && e->pair_count < 65536) {
        broadside_pair pair = {i, j};
        e->pairs[e->pair_count++] = pair;
      }
  if (e->pair_count == 0) return BROADSIDE_OK;
  broadside_pair* last = &e->pairs[e->pair_count - 1];
  if (e->fault == DROPS_A_PAIR) --e->pair_count;
  if (e->fault == TWICE) e->pairs[e->pair_count++] = e->pairs[0];
  if (e->fault == OUT_OF_RANGE) last->j = e->count;
  if (e->fault == ITSELF) last->j = last->i;
  if (e->fault == WRONG_ORDER) {
    uint32_t held = last->i;
    last->i = last->j;
    last->j = held;
  }
  return BROADSIDE_OK;
}

static int read_pairs(void* self, broadside_pair* pairs, uint64_t capacity, uint64_t* demanded) {
  engine* e = self;
  uint64_t count = e->pair_count < capacity ? e->pair_count : capacity;
  memcpy(pairs, e->pairs, count * sizeof *pairs);
  *demanded = e->pair_count;
  if (e->fault == CLAIMS_MORE) ++*demanded;
  if (e->fault == ABSURD_COUNT) *demanded = UINT64_C(1) << 62;
  if (e->fault == KEEPS_GROWING) *demanded = capacity + 1;
  if (e->fault == WRITES_BEHIND) pairs[capacity].i = 1;
  return BROADSIDE_OK;
}

const broadside_engine* broadside_engine_v1(void) {
  static const broadside_setting settings[] = {{"fault", SOUND, "what is wrong, 0 = nothing"}};
  static const broadside_engine table = {
      .abi = BROADSIDE_ENGINE_ABI,
      .size = sizeof(broadside_engine),
      .id = "wrong-engine",
      .build = "test 1, float",
      .what = "wrong in one way",
      .memory = BROADSIDE_HOST,
      .is_exact = 1,
      .settings = settings,
      .setting_count = 1,
      .create = create,
      .destroy = destroy,
      .last_error = last_error,
      .load_boxes = load_boxes,
      .update_boxes = update_boxes,
      .find_pairs = find_pairs,
      .read_pairs = read_pairs,
  };
  return &table;
}
