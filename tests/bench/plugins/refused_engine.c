/* Libraries that are no engine, one by one, by macros: EMPTY exports nothing, LATER speaks a later version of the
 * interface, HALF has an update and no find. */
#include <stddef.h>

#include "broadside_engine.h"

#ifdef EMPTY
int nothing;
#else
static void* create(const uint64_t* values) {
  return (void*)values;
}
static void destroy(void* self) {
  (void)self;
}
static const char* last_error(void* self) {
  return self == NULL ? "" : "";
}
static int update_boxes(void* self, const broadside_box* boxes, uint32_t count) {
  return self == NULL || boxes == NULL || count == 0;
}

const broadside_engine* broadside_engine_v1(void) {
  static const broadside_engine table = {
#ifdef LATER
      .abi = BROADSIDE_ENGINE_ABI + 1,
#else
      .abi = BROADSIDE_ENGINE_ABI,
#endif
      .size = sizeof(broadside_engine),
      .id = "refused",
      .build = "test",
      .what = "",
      .create = create,
      .destroy = destroy,
      .last_error = last_error,
      .update_boxes = update_boxes,
  };
  return &table;
}
#endif
