/* Broadside's engine interface, version 2: for engines whose bodies turn, and for engines that declare what they do.
 *
 * Export broadside_engine_v2 instead of broadside_engine_v1. If you export both, version 2 is used. The rules of
 * broadside_engine.h about signs, memory and outputs apply here too. New are:
 *
 *   the declaration   what the engine declares; laws are chosen by it (core/trace/FOREIGN.md lists the keys)
 *   the scene         inertia, center of mass, shapes in closed form, wrenches, everything that laws read
 *   read_states       float64, with orientation and angular velocity
 *   read_points       totals: one row per point of contact and step
 *   read_detection    poses and boxes that collision detection saw
 *   read_step_pairs   pairs that collision detection found
 *
 * Compatibility. `size` in the table is the size of the table in the header with which the library was built; functions
 * past that size count as null. `size` in a scene is the size with which Broadside was built, and the scene's arrays
 * have a stride: element k of bodies is at (const char*)bodies + k * body_size. A library that uses only what its own
 * header has may ignore both. Records that a library writes never change; a new record gets a new function.
 *
 * No record has padding: a program engine (PROGRAMS.md) receives and sends the same bytes. */
#ifndef BROADSIDE_ENGINE_V2_H
#define BROADSIDE_ENGINE_V2_H

#include "broadside_engine.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BROADSIDE_ENGINE_ABI_2 2

#define BROADSIDE_TRANSLATE 0 /* bodies keep their orientation */
#define BROADSIDE_RIGID 1     /* bodies turn */

#define BROADSIDE_BOX 1
#define BROADSIDE_SPHERE 2
#define BROADSIDE_CAPSULE 3
#define BROADSIDE_CYLINDER 4
#define BROADSIDE_CONVEX 5 /* closed and convex: its hull is the body itself */
#define BROADSIDE_MESH 6

#define BROADSIDE_WORLD_AXES 0
#define BROADSIDE_BODY_AXES 1

/* The shape that a mesh represents, centered at the mesh's origin. An engine that does not have this shape must fail in
 * begin with "unsupported: cylinder" and must not use another shape instead. */
typedef struct {
  uint32_t kind;          /* BROADSIDE_BOX ... BROADSIDE_MESH */
  uint32_t axis;          /* capsule, cylinder: 0, 1 or 2 */
  double half_extents[3]; /* m; of the mesh's box */
  double radius;          /* m; sphere, capsule, cylinder, else 0 */
  double half_length;     /* m; of a capsule's segment or half a cylinder's height, else 0 */
} broadside_shape;

typedef struct {
  double position[3];         /* of the mesh's origin, m */
  double orientation[4];      /* unit quaternion w x y z, world from body */
  double velocity[3];         /* of the center of mass, m/s */
  double angular_velocity[3]; /* rad/s, world axes */
} broadside_state2;

typedef struct {
  uint32_t mesh; /* index into meshes and shapes */
  uint32_t is_static;
  broadside_state2 state;
  double mass;              /* kg; 0 = static */
  double center_of_mass[3]; /* in mesh coordinates, m */
  double inertia[6];        /* xx yy zz xy xz yz about the center of mass, in mesh axes, kg m^2; zeros = static, or not
                               defined in a scene whose bodies translate only */
  double mu_static;
  double mu_kinetic;
  double restitution;
} broadside_body2;

/* A constant force at the center of mass and a constant torque on one body, in every step, in addition to gravity. */
typedef struct {
  uint32_t body;
  uint32_t axes;    /* BROADSIDE_WORLD_AXES or BROADSIDE_BODY_AXES */
  double force[3];  /* N */
  double torque[3]; /* N m */
} broadside_wrench;

/* Frictions of two surfaces combine to their geometric mean, restitutions to the larger. */
typedef struct {
  uint32_t size;   /* sizeof(broadside_scene2) of the caller */
  uint32_t motion; /* BROADSIDE_TRANSLATE or BROADSIDE_RIGID */
  const char* name;
  const broadside_mesh* meshes;
  const broadside_shape* shapes; /* one per mesh */
  const broadside_body2* bodies;
  const broadside_wrench* wrenches;
  uint32_t mesh_size; /* strides, in bytes */
  uint32_t shape_size;
  uint32_t body_size;
  uint32_t wrench_size;
  uint32_t mesh_count;
  uint32_t body_count;
  uint32_t wrench_count; /* may be 0 */
  uint32_t frames;       /* steps that the scene asks for */
  double domain_min[3];  /* the faces of this box are static half-spaces */
  double domain_max[3];
  double face_mu_static;
  double face_mu_kinetic;
  double face_restitution;
  double gravity[3];  /* m/s^2 */
  double dt;          /* s */
  double delta;       /* slop: penetration that may stay, m */
  double v_threshold; /* slower approaches do not bounce, m/s */
  double v_max;       /* only for engines of METHOD: each component of a velocity is clipped to it, m/s */
  double theta;       /* only for engines of METHOD: vertices nearer than this touch, m */
  uint64_t seed;
} broadside_scene2;

/* A point of contact, with the totals of the step. Body b may be a face of the domain (BROADSIDE_FIRST_FACE + k). */
typedef struct {
  uint32_t a;
  uint32_t b;
  double point[3];   /* m */
  double normal[3];  /* unit, from B to A */
  double gap;        /* at detection, along the normal, m; negative is penetration */
  double impulse[3]; /* N s on A, of the whole step: normal part and friction together */
  uint32_t feature;  /* your own id of this point, the same while it lasts; 0 = none */
  uint32_t reserved; /* 0 */
} broadside_point;

/* What collision detection saw of one body, at the moment that the declaration names. */
typedef struct {
  double position[3];
  double orientation[4];
  double velocity[3];
  broadside_box box; /* contains the turned shape; the exact set of candidate pairs is that of these boxes */
} broadside_detection;

/* One declared word, text or number: {"friction", "pyramid"}. */
typedef struct {
  const char* key;
  const char* value;
} broadside_declared;

/* When you do not offer a group of functions, all functions of that group are null. */
typedef struct {
  uint32_t abi;      /* BROADSIDE_ENGINE_ABI_2 */
  uint32_t size;     /* sizeof(broadside_engine2) */
  const char* id;    /* "my-world": lower case, digits and dashes, 32 characters at most */
  const char* build; /* library, version, precision: "libmine 1.2, double" */
  const char* what;  /* one line for listings */
  uint32_t memory;   /* BROADSIDE_HOST or BROADSIDE_CUDA: of the arrays of the broad and the narrow phase */
  uint32_t is_exact; /* pairs: 1 = exactly the overlapping pairs of the boxes; 0 = a superset */
  double margin_m;   /* by which it enlarges boxes */

  const broadside_setting* settings;
  uint32_t setting_count;
  uint32_t declared_count;
  const broadside_declared* declared; /* for the dynamics; absent keys take FOREIGN.md's default */

  /* As in version 1. */
  void* (*create)(const uint64_t* values);
  void (*destroy)(void* self);
  const char* (*last_error)(void* self);
  int (*load_boxes)(void* self, const broadside_box* boxes, const uint8_t* is_static, uint32_t count);
  int (*update_boxes)(void* self, const broadside_box* boxes, uint32_t count);
  int (*find_pairs)(void* self);
  int (*read_pairs)(void* self, broadside_pair* pairs, uint64_t capacity, uint64_t* demanded);
  int (*load_scene)(void* self, const broadside_scene2* scene);
  int (*measure)(void* self, const broadside_pair* pairs, uint64_t pair_count, const broadside_pose* poses,
                 uint32_t body_count);
  int (*read_separations)(void* self, broadside_separation* separations, uint64_t capacity, uint64_t* demanded);

  /* Dynamics: host arrays. begin is not timed; step is. */
  int (*begin)(void* self, const broadside_scene2* scene);
  int (*step)(void* self, double dt);
  int (*read_states)(void* self, broadside_state2* states, uint32_t body_count);
  /* Each may be null. They report on the last step. */
  int (*read_points)(void* self, broadside_point* points, uint64_t capacity, uint64_t* demanded);
  int (*read_contacts)(void* self, broadside_contact* contacts, uint64_t capacity, uint64_t* demanded);
  int (*read_detection)(void* self, broadside_detection* bodies, uint32_t body_count);
  int (*read_step_pairs)(void* self, broadside_pair* pairs, uint64_t capacity, uint64_t* demanded);
  /* Narrow phase and dynamics: after this call the scene's memory is freed. May be null. */
  void (*end)(void* self);
} broadside_engine2;

/* What the library exports. The table lives as long as the library. */
const broadside_engine2* broadside_engine_v2(void);

#ifdef __cplusplus
}
#endif

#endif
