/* A broad phase in Python: runs the function find_pairs(boxes, is_static) of a module next to this library. boxes is a
 * list of 6-tuples (min x y z, max x y z) and is_static a list of 0 and 1; it returns pairs of indices. For trying out
 * an idea: the measured time is the interpreter's, not the algorithm's. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "broadside_engine.h"

typedef struct {
  PyObject* find; /* the function */
  PyObject* boxes;
  PyObject* is_static;
  PyObject* pairs; /* what it returned */
  char error[512];
} engine;

static char create_error[512];

/* Python's current exception, as one line. */
static int failed(char* text, size_t room) {
  PyObject *type = NULL, *value = NULL, *trace = NULL;
  PyErr_Fetch(&type, &value, &trace);
  PyObject* word = value != NULL ? PyObject_Str(value) : NULL;
  const char* utf8 = word != NULL ? PyUnicode_AsUTF8(word) : NULL;
  snprintf(text, room, "Python: %s", utf8 != NULL ? utf8 : "failed");
  Py_XDECREF(word);
  Py_XDECREF(type);
  Py_XDECREF(value);
  Py_XDECREF(trace);
  return BROADSIDE_FAILED;
}

/* Puts the folder of this library at the front of Python's path. */
static void add_own_folder(void) {
  Dl_info info;
  if (dladdr((const void*)&add_own_folder, &info) == 0 || info.dli_fname == NULL) return;
  char folder[4096];
  snprintf(folder, sizeof folder, "%s", info.dli_fname);
  char* slash = strrchr(folder, '/');
  if (slash == NULL) return;
  *slash = '\0';
  PyObject* path = PySys_GetObject("path");
  PyObject* word = PyUnicode_FromString(folder);
  if (path != NULL && word != NULL) PyList_Insert(path, 0, word);
  Py_XDECREF(word);
}

static void* create(const uint64_t* values) {
  (void)values;
  if (!Py_IsInitialized()) {
    Py_InitializeEx(0);
    add_own_folder();
  }
  PyObject* module = PyImport_ImportModule("my_engine");
  PyObject* find = module != NULL ? PyObject_GetAttrString(module, "find_pairs") : NULL;
  Py_XDECREF(module);
  if (find == NULL) {
    failed(create_error, sizeof create_error);
    return NULL;
  }
  engine* e = calloc(1, sizeof *e);
  if (e != NULL) e->find = find;
  return e;
}

static void destroy(void* self) {
  engine* e = self;
  Py_XDECREF(e->find);
  Py_XDECREF(e->boxes);
  Py_XDECREF(e->is_static);
  Py_XDECREF(e->pairs);
  free(e);
}

static const char* last_error(void* self) {
  return self == NULL ? create_error : ((engine*)self)->error;
}

static int update_boxes(void* self, const broadside_box* boxes, uint32_t count) {
  engine* e = self;
  PyObject* list = PyList_New(count);
  if (list == NULL) return failed(e->error, sizeof e->error);
  for (uint32_t k = 0; k < count; ++k) {
    const broadside_box* b = &boxes[k];
    PyObject* six = Py_BuildValue("(ffffff)", b->min[0], b->min[1], b->min[2], b->max[0], b->max[1], b->max[2]);
    if (six == NULL) {
      Py_DECREF(list);
      return failed(e->error, sizeof e->error);
    }
    PyList_SET_ITEM(list, k, six);
  }
  Py_XDECREF(e->boxes);
  e->boxes = list;
  return BROADSIDE_OK;
}

static int load_boxes(void* self, const broadside_box* boxes, const uint8_t* is_static, uint32_t count) {
  engine* e = self;
  PyObject* list = PyList_New(count);
  if (list == NULL) return failed(e->error, sizeof e->error);
  for (uint32_t k = 0; k < count; ++k) PyList_SET_ITEM(list, k, PyLong_FromLong(is_static[k]));
  Py_XDECREF(e->is_static);
  e->is_static = list;
  return update_boxes(self, boxes, count);
}

static int find_pairs(void* self) {
  engine* e = self;
  PyObject* result = PyObject_CallFunctionObjArgs(e->find, e->boxes, e->is_static, NULL);
  PyObject* list = result != NULL ? PySequence_List(result) : NULL;
  Py_XDECREF(result);
  if (list == NULL) return failed(e->error, sizeof e->error);
  Py_XDECREF(e->pairs);
  e->pairs = list;
  return BROADSIDE_OK;
}

static int read_pairs(void* self, broadside_pair* pairs, uint64_t capacity, uint64_t* demanded) {
  engine* e = self;
  *demanded = e->pairs != NULL ? (uint64_t)PyList_GET_SIZE(e->pairs) : 0;
  for (uint64_t k = 0; k < *demanded && k < capacity; ++k) {
    unsigned int i = 0;
    unsigned int j = 0;
    PyObject* pair = PySequence_Tuple(PyList_GET_ITEM(e->pairs, (Py_ssize_t)k));
    int good = pair != NULL && PyArg_ParseTuple(pair, "II", &i, &j);
    Py_XDECREF(pair);
    if (!good) return failed(e->error, sizeof e->error);
    pairs[k].i = i < j ? i : j;
    pairs[k].j = i < j ? j : i;
  }
  return BROADSIDE_OK;
}

const broadside_engine* broadside_engine_v1(void) {
  static const broadside_engine table = {
      .abi = BROADSIDE_ENGINE_ABI,
      .size = sizeof(broadside_engine),
      .id = "example-python",
      .build = "example 1.0, Python " PY_VERSION,
      .what = "an example that runs a Python function",
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
  return &table;
}
