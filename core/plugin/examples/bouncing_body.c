/* One body that flies, turns and bounces off the faces of the domain: an engine of version 2, in float64.
 *
 * A ball, a capsule or a box is represented by up to eight small balls that touch a face. Each step finds points where
 * a face is near, applies impacts, which rebound, then gravity, then impulses that keep gaps from closing further
 * (Gauss-Seidel, friction within the cone), and moves the body with its angular momentum constant, which includes the
 * gyroscopic term. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "broadside_engine_v2.h"

#define SWEEPS 100
#define MOST_POINTS 48

typedef struct {
  double x, y, z;
} vec;

typedef struct {
  uint32_t face;
  vec at, normal; /* normal: into the domain */
  double gap, least_speed, push;
  vec drag, total;
} point;

typedef struct {
  const char* error;
  vec corner[8]; /* from the center of mass, in mesh axes */
  int corners;
  double radius, mass, inverse_inertia[9], reach; /* reach: of the farthest corner */
  vec center, gravity, low, high;                 /* center: of mass, in mesh axes */
  double mu_static, mu_kinetic, restitution, v_threshold;
  vec x, v, momentum; /* of the center of mass; angular momentum in world axes */
  double q[4];
  point points[MOST_POINTS];
  int point_count;
  broadside_detection seen;
} body;

static vec add(vec a, vec b) {
  return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}
static vec scaled(double s, vec a) {
  return (vec){s * a.x, s * a.y, s * a.z};
}
static double dot(vec a, vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static double size(vec a) {
  return sqrt(dot(a, a));
}
static vec cross(vec a, vec b) {
  return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static vec from(const double* a) {
  return (vec){a[0], a[1], a[2]};
}
static void into(double* to, vec a) {
  to[0] = a.x, to[1] = a.y, to[2] = a.z;
}
static double part(vec a, uint32_t axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* v + 2 w (u x v) + 2 u x (u x v), q = (w, u): a rotation. */
static vec turned(const double* q, vec v) {
  const vec u = {q[1], q[2], q[3]};
  const vec t = scaled(2.0, cross(u, v));
  return add(add(v, scaled(q[0], t)), cross(u, t));
}
static vec turned_back(const double* q, vec v) {
  const double back[4] = {q[0], -q[1], -q[2], -q[3]};
  return turned(back, v);
}
static vec spin(const body* b, const double* q, vec momentum) {
  const vec l = turned_back(q, momentum);
  const double* i = b->inverse_inertia;
  const vec w = {dot(from(i), l), dot(from(i + 3), l), dot(from(i + 6), l)};
  return turned(q, w);
}

static void* create(const uint64_t* values) {
  (void)values;
  return calloc(1, sizeof(body));
}
static void destroy(void* self) {
  free(self);
}
static const char* last_error(void* self) {
  return self == NULL ? "out of memory" : ((body*)self)->error;
}

/* Inverse of the symmetric matrix xx yy zz xy xz yz. */
static void invert(const double* m, double* inverse) {
  const vec r0 = {m[0], m[3], m[4]}, r1 = {m[3], m[1], m[5]}, r2 = {m[4], m[5], m[2]};
  const double s = 1.0 / dot(r0, cross(r1, r2));
  into(inverse, scaled(s, cross(r1, r2)));
  into(inverse + 3, scaled(s, cross(r2, r0)));
  into(inverse + 6, scaled(s, cross(r0, r1)));
}

/* The small balls of a shape; 0 = unsupported. */
static int corners_of(const broadside_shape* s, vec* corner) {
  if (s->kind == BROADSIDE_SPHERE) {
    corner[0] = (vec){0, 0, 0};
    return 1;
  }
  if (s->kind == BROADSIDE_CAPSULE) {
    double end[3] = {0, 0, 0};
    end[s->axis] = s->half_length;
    corner[0] = from(end);
    corner[1] = scaled(-1.0, corner[0]);
    return 2;
  }
  if (s->kind != BROADSIDE_BOX) return 0;
  const double* h = s->half_extents;
  for (int k = 0; k < 8; ++k) corner[k] = (vec){k & 1 ? h[0] : -h[0], k & 2 ? h[1] : -h[1], k & 4 ? h[2] : -h[2]};
  return 8;
}

static int begin(void* self, const broadside_scene2* scene) {
  body* b = self;
  memset(b, 0, sizeof *b);
  const broadside_body2* given = scene->bodies;
  b->error = scene->body_count != 1             ? "this example simulates one body"
             : given->is_static                 ? "this example simulates a body that moves"
             : scene->motion != BROADSIDE_RIGID ? "this example's body turns: the scene needs motion = rigid"
             : scene->wrench_count > 0          ? "unsupported: wrenches"
                                                : NULL;
  if (b->error != NULL) return BROADSIDE_FAILED;
  const broadside_shape* shape = scene->shapes + given->mesh;
  b->corners = corners_of(shape, b->corner);
  b->radius = shape->kind == BROADSIDE_BOX ? 0.0 : shape->radius;
  if (b->corners == 0) {
    b->error = "unsupported shape: this example has spheres, capsules and boxes";
    return BROADSIDE_FAILED;
  }
  b->center = from(given->center_of_mass);
  for (int k = 0; k < b->corners; ++k) {
    b->corner[k] = add(b->corner[k], scaled(-1.0, b->center));
    b->reach = fmax(b->reach, size(b->corner[k]) + b->radius);
  }
  b->mass = given->mass;
  invert(given->inertia, b->inverse_inertia);
  b->mu_static = sqrt(given->mu_static * scene->face_mu_static);
  b->mu_kinetic = sqrt(given->mu_kinetic * scene->face_mu_kinetic);
  b->restitution = fmax(given->restitution, scene->face_restitution);
  b->v_threshold = scene->v_threshold;
  b->gravity = from(scene->gravity);
  b->low = from(scene->domain_min);
  b->high = from(scene->domain_max);
  memcpy(b->q, given->state.orientation, sizeof b->q);
  b->x = add(from(given->state.position), turned(b->q, b->center));
  b->v = from(given->state.velocity);
  const double* i = given->inertia;
  const vec w = turned_back(b->q, from(given->state.angular_velocity));
  const vec l = {i[0] * w.x + i[3] * w.y + i[4] * w.z, i[3] * w.x + i[1] * w.y + i[5] * w.z,
                 i[4] * w.x + i[5] * w.y + i[2] * w.z};
  b->momentum = turned(b->q, l);
  return BROADSIDE_OK;
}

/* Boxes hold floats; they are rounded outward, so that they contain the shape. */
static void see(body* b) {
  into(b->seen.position, add(b->x, scaled(-1.0, turned(b->q, b->center))));
  memcpy(b->seen.orientation, b->q, sizeof b->q);
  into(b->seen.velocity, b->v);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < b->corners; ++k) {
      const double at = part(add(b->x, turned(b->q, b->corner[k])), axis);
      low = fmin(low, at - b->radius);
      high = fmax(high, at + b->radius);
    }
    b->seen.box.min[axis] = nextafterf((float)low, -HUGE_VALF);
    b->seen.box.max[axis] = nextafterf((float)high, HUGE_VALF);
  }
}

static void find_points(body* b, double h) {
  const double near = h * (size(b->v) + size(spin(b, b->q, b->momentum)) * b->reach + h * size(b->gravity));
  b->point_count = 0;
  for (uint32_t face = 0; face < 6; ++face)
    for (int k = 0; k < b->corners; ++k) {
      const uint32_t axis = face / 2;
      const double side = face % 2 == 0 ? 1.0 : -1.0;
      const vec n = {axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0};
      const vec at = add(add(b->x, turned(b->q, b->corner[k])), scaled(-b->radius, n));
      const double gap = side * (part(at, axis) - part(face % 2 == 0 ? b->low : b->high, axis));
      if (gap <= near) b->points[b->point_count++] = (point){.face = face, .at = at, .normal = n, .gap = gap};
    }
}

static vec velocity_at(const body* b, vec at) {
  return add(b->v, cross(spin(b, b->q, b->momentum), add(at, scaled(-1.0, b->x))));
}
static void push(body* b, vec at, vec impulse) {
  b->v = add(b->v, scaled(1.0 / b->mass, impulse));
  b->momentum = add(b->momentum, cross(add(at, scaled(-1.0, b->x)), impulse));
}
/* The change of the point's speed along d by an impulse of 1 N s along d. */
static double mobility(const body* b, vec at, vec d) {
  const vec arm = cross(add(at, scaled(-1.0, b->x)), d);
  return 1.0 / b->mass + dot(arm, spin(b, b->q, arm));
}

static void solve(body* b, point* p) {
  const vec n = p->normal;
  const double before = p->push;
  p->push = fmax(0.0, before + (p->least_speed - dot(velocity_at(b, p->at), n)) / mobility(b, p->at, n));
  push(b, p->at, scaled(p->push - before, n));

  const vec t = {n.y, n.z, n.x}, u = {n.z, n.x, n.y}; /* of an axis: the two others */
  const vec v = velocity_at(b, p->at);
  const vec slip = add(v, scaled(-dot(v, n), n));
  /* The sum of both mobilities is at least that of any direction between, so no step goes too far. */
  vec drag = add(p->drag, scaled(-1.0 / (mobility(b, p->at, t) + mobility(b, p->at, u)), slip));
  if (size(drag) > b->mu_static * p->push) drag = scaled(b->mu_kinetic * p->push / size(drag), drag);
  push(b, p->at, add(drag, scaled(-1.0, p->drag)));
  p->drag = drag;
}

static void solve_all(body* b, const int* takes_part) {
  for (int sweep = 0; sweep < SWEEPS; ++sweep)
    for (int k = 0; k < b->point_count; ++k)
      if (takes_part[k]) solve(b, &b->points[k]);
  for (int k = 0; k < b->point_count; ++k) {
    point* p = &b->points[k];
    p->total = add(p->total, add(scaled(p->push, p->normal), p->drag));
    p->push = 0.0;
    p->drag = (vec){0, 0, 0};
  }
}

static void normalize(double* q) {
  const double s = 1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int k = 0; k < 4; ++k) q[k] *= s;
}

/* q + s (0, w) q' / 2, where w is the spin at q' and q' = at. */
static void move(const body* b, double* q, const double* at, double s) {
  double unit[4];
  memcpy(unit, at, sizeof unit);
  normalize(unit);
  const vec w = spin(b, unit, b->momentum);
  const vec u = {at[1], at[2], at[3]};
  const vec d = add(scaled(at[0], w), cross(w, u));
  const double sum[4] = {q[0] - 0.5 * s * dot(w, u), q[1] + 0.5 * s * d.x, q[2] + 0.5 * s * d.y, q[3] + 0.5 * s * d.z};
  memcpy(q, sum, sizeof sum);
}

/* The classical Runge-Kutta method. */
static void turn(body* b, double h) {
  double q[4][4]; /* three stages and the sum */
  for (int k = 0; k < 4; ++k) memcpy(q[k], b->q, sizeof b->q);
  move(b, q[0], b->q, 0.5 * h);
  move(b, q[1], q[0], 0.5 * h);
  move(b, q[2], q[1], h);
  move(b, q[3], b->q, h / 6);
  move(b, q[3], q[0], h / 3);
  move(b, q[3], q[1], h / 3);
  move(b, q[3], q[2], h / 6);
  normalize(q[3]);
  memcpy(b->q, q[3], sizeof b->q);
}

static int step(void* self, double h) {
  body* b = self;
  int hits[MOST_POINTS], all[MOST_POINTS];
  see(b);
  find_points(b, h);
  for (int k = 0; k < b->point_count; ++k) {
    point* p = &b->points[k];
    const double approach = -dot(velocity_at(b, p->at), p->normal);
    hits[k] = approach > b->v_threshold && p->gap < h * (approach - h * dot(b->gravity, p->normal));
    p->least_speed = b->restitution * approach;
    all[k] = 1;
  }
  solve_all(b, hits);
  const vec before = b->v;
  b->v = add(b->v, scaled(h, b->gravity));
  for (int k = 0; k < b->point_count; ++k) b->points[k].least_speed = -fmax(0.0, b->points[k].gap) / h;
  const vec free_speed = b->v;
  solve_all(b, all);
  const int is_free = memcmp(&free_speed, &b->v, sizeof free_speed) == 0;
  /* Free flight is exact; a body that a face stopped moves with the velocity that the face allows. */
  b->x = add(b->x, is_free ? scaled(0.5 * h, add(before, b->v)) : scaled(h, b->v));
  turn(b, h);
  return BROADSIDE_OK;
}

static int read_states(void* self, broadside_state2* states, uint32_t body_count) {
  const body* b = self;
  if (body_count != 1) return BROADSIDE_FAILED;
  into(states->position, add(b->x, scaled(-1.0, turned(b->q, b->center))));
  memcpy(states->orientation, b->q, sizeof b->q);
  into(states->velocity, b->v);
  into(states->angular_velocity, spin(b, b->q, b->momentum));
  return BROADSIDE_OK;
}

static int read_points(void* self, broadside_point* points, uint64_t capacity, uint64_t* demanded) {
  const body* b = self;
  *demanded = 0;
  for (int k = 0; k < b->point_count; ++k) {
    const point* p = &b->points[k];
    if (size(p->total) == 0.0 && p->gap > 0.0) continue;
    if (*demanded < capacity) {
      broadside_point* out = points + *demanded;
      memset(out, 0, sizeof *out);
      out->b = BROADSIDE_FIRST_FACE + p->face;
      into(out->point, p->at);
      into(out->normal, p->normal);
      into(out->impulse, p->total);
      out->gap = p->gap;
    }
    ++*demanded;
  }
  return BROADSIDE_OK;
}

static int read_detection(void* self, broadside_detection* bodies, uint32_t body_count) {
  if (body_count != 1) return BROADSIDE_FAILED;
  *bodies = ((const body*)self)->seen;
  return BROADSIDE_OK;
}

const broadside_engine2* broadside_engine_v2(void) {
  static const broadside_declared declared[] = {
      {"motion", "rigid"},        {"detection_at", "start"},
      {"contacts", "totals"},     {"integrator", "semi-implicit Euler, Runge-Kutta 4 for the orientation"},
      {"iterations", "100"},      {"friction", "cone"},
      {"contact_model", "rigid"}, {"correction", "none"},
      {"precision", "f64"},
  };
  static const broadside_engine2 engine = {
      .abi = BROADSIDE_ENGINE_ABI_2,
      .size = sizeof(broadside_engine2),
      .id = "example-bouncing-body",
      .build = "example 1.0, double",
      .what = "an example in C: one body that turns and bounces",
      .memory = BROADSIDE_HOST,
      .declared = declared,
      .declared_count = sizeof declared / sizeof *declared,
      .create = create,
      .destroy = destroy,
      .last_error = last_error,
      .begin = begin,
      .step = step,
      .read_states = read_states,
      .read_points = read_points,
      .read_detection = read_detection,
  };
  return &engine;
}
