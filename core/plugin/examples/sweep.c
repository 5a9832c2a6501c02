/* A broad phase in C: boxes sorted by their lower x, then each compared with the boxes that begin before it ends. */
#include <stdlib.h>
#include <string.h>

#include "broadside_engine.h"

typedef struct {
  uint32_t count;
  broadside_box* boxes;
  uint8_t* is_static;
  uint32_t* order; /* boxes by min x */
  broadside_pair* pairs;
  uint64_t pair_count;
  uint64_t pair_room;
  const char* error;
} sweep;

static void* create(const uint64_t* values) {
  (void)values;
  return calloc(1, sizeof(sweep));
}

static void forget(sweep* s) {
  free(s->boxes);
  free(s->is_static);
  free(s->order);
  free(s->pairs);
  memset(s, 0, sizeof *s);
}

static void destroy(void* self) {
  forget(self);
  free(self);
}

static const char* last_error(void* self) {
  return self == NULL ? "out of memory" : ((sweep*)self)->error;
}

static int load_boxes(void* self, const broadside_box* boxes, const uint8_t* is_static, uint32_t count) {
  sweep* s = self;
  forget(s);
  s->boxes = malloc((count + 1) * sizeof *s->boxes);
  s->is_static = malloc(count + 1);
  s->order = malloc((count + 1) * sizeof *s->order);
  if (s->boxes == NULL || s->is_static == NULL || s->order == NULL) {
    s->error = "out of memory";
    return BROADSIDE_FAILED;
  }
  s->count = count;
  if (count > 0) {
    memcpy(s->boxes, boxes, count * sizeof *boxes);
    memcpy(s->is_static, is_static, count);
  }
  for (uint32_t k = 0; k < count; ++k) s->order[k] = k;
  return BROADSIDE_OK;
}

static int update_boxes(void* self, const broadside_box* boxes, uint32_t count) {
  sweep* s = self;
  if (count > 0) memcpy(s->boxes, boxes, count * sizeof *boxes);
  return BROADSIDE_OK;
}

/* Heap sort by min x. */
static void sift(sweep* s, uint32_t root, uint32_t end) {
  for (uint32_t child; (child = 2 * root + 1) < end; root = child) {
    if (child + 1 < end && s->boxes[s->order[child]].min[0] < s->boxes[s->order[child + 1]].min[0]) ++child;
    if (s->boxes[s->order[root]].min[0] >= s->boxes[s->order[child]].min[0]) return;
    uint32_t held = s->order[root];
    s->order[root] = s->order[child];
    s->order[child] = held;
  }
}

static void sort(sweep* s) {
  for (uint32_t k = s->count / 2; k-- > 0;) sift(s, k, s->count);
  for (uint32_t end = s->count; end-- > 1;) {
    uint32_t held = s->order[0];
    s->order[0] = s->order[end];
    s->order[end] = held;
    sift(s, 0, end);
  }
}

static int overlap(const broadside_box* a, const broadside_box* b) {
  for (int k = 0; k < 3; ++k)
    if (a->min[k] > b->max[k] || b->min[k] > a->max[k]) return 0;
  return 1;
}

static int append(sweep* s, uint32_t p, uint32_t q) {
  if (s->pair_count == s->pair_room) {
    uint64_t room = s->pair_room == 0 ? 1024 : 2 * s->pair_room;
    broadside_pair* larger = realloc(s->pairs, room * sizeof *larger);
    if (larger == NULL) return 0;
    s->pairs = larger;
    s->pair_room = room;
  }
  broadside_pair pair = {p < q ? p : q, p < q ? q : p};
  s->pairs[s->pair_count++] = pair;
  return 1;
}

static int find_pairs(void* self) {
  sweep* s = self;
  sort(s);
  s->pair_count = 0;
  for (uint32_t k = 0; k < s->count; ++k) {
    uint32_t p = s->order[k];
    for (uint32_t m = k + 1; m < s->count; ++m) {
      uint32_t q = s->order[m];
      if (s->boxes[q].min[0] > s->boxes[p].max[0]) break;
      if (s->is_static[p] && s->is_static[q]) continue;
      if (overlap(&s->boxes[p], &s->boxes[q]) && !append(s, p, q)) {
        s->error = "out of memory";
        return BROADSIDE_FAILED;
      }
    }
  }
  return BROADSIDE_OK;
}

static int read_pairs(void* self, broadside_pair* pairs, uint64_t capacity, uint64_t* demanded) {
  sweep* s = self;
  uint64_t count = s->pair_count < capacity ? s->pair_count : capacity;
  if (count > 0) memcpy(pairs, s->pairs, count * sizeof *pairs);
  *demanded = s->pair_count;
  return BROADSIDE_OK;
}

const broadside_engine* broadside_engine_v1(void) {
  static const broadside_engine engine = {
      .abi = BROADSIDE_ENGINE_ABI,
      .size = sizeof(broadside_engine),
      .id = "example-sweep",
      .build = "example 1.0, float",
      .what = "an example in C: sort and sweep along x",
      .memory = BROADSIDE_HOST,
      .is_exact = 1,
      .create = create,
      .destroy = destroy,
      .last_error = last_error,
      .load_boxes = load_boxes,
      .update_boxes = update_boxes,
      .find_pairs = find_pairs,
      .read_pairs = read_pairs,
  };
  return &engine;
}
