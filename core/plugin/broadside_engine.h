/* Broadside's engine interface, version 1: how a collision engine of your own takes part.
 *
 * Build a shared library that exports one function, broadside_engine_v1, and name it: broadside run SCENE --engine
 * ./libmine.so. It is loaded in a child process, judged and timed like every other engine.
 *
 * C99, plain arrays, nothing to link against. Conventions: SI units, world frame; a pair has i < j, and of a pair A =
 * i, B = j; a contact normal has length 1 and points from B to A; depth > 0 and distance < 0 are penetration; two boxes
 * overlap when their closed intervals meet on all three axes (touching counts); two static bodies are no pair.
 *
 * Memory. Every array belongs to the caller and is valid only during the call, except a scene's arrays (until end()).
 * Where `memory` is BROADSIDE_CUDA, arrays of boxes, pairs, poses, separations and states are CUDA device pointers of
 * device 0; meshes, counts and the scene's structs stay on the host.
 *
 * Outputs have a capacity, in elements. Write at most that many, and always set *demanded to how many there are: the
 * caller then calls again with more room. The memory after an output's end cannot be written.
 *
 * Return BROADSIDE_OK, or BROADSIDE_FAILED with a line in last_error. Calls for one engine never overlap; threads of
 * your own are welcome. */
#ifndef BROADSIDE_ENGINE_H
#define BROADSIDE_ENGINE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BROADSIDE_ENGINE_ABI 1
#define BROADSIDE_OK 0
#define BROADSIDE_FAILED 1

#define BROADSIDE_HOST 0
#define BROADSIDE_CUDA 1

/* Body B of a contact with face k of the domain, in the order -x +x -y +y -z +z, is BROADSIDE_FIRST_FACE + k. */
#define BROADSIDE_FIRST_FACE 0xFFFFFFF0u

typedef struct {
  float min[3]; /* m */
  float max[3]; /* m */
} broadside_box;

typedef struct {
  uint32_t i; /* i < j < number of bodies */
  uint32_t j;
} broadside_pair;

typedef struct {
  float position[3];    /* of the mesh's origin, m */
  float orientation[4]; /* unit quaternion w x y z, world from body */
} broadside_pose;

typedef struct {
  double distance_m; /* of the surfaces; < 0 is penetration, 0 touching or overlap of unknown depth */
  float normal[3];   /* unit, from B to A; zero when not known */
  float witness_a[3];
  float witness_b[3];
  uint32_t is_touching; /* 1 = touching or overlapping */
} broadside_separation;

typedef struct {
  float position[3]; /* m */
  float orientation[4];
  float velocity[3];         /* m/s */
  float angular_velocity[3]; /* rad/s */
} broadside_state;

/* One application of the response, with the states before and after it; for a face, B's fields are zero. */
typedef struct {
  uint32_t a;
  uint32_t b;
  float depth_m;         /* along the normal, before this application */
  float normal[3];       /* unit, from B to A */
  float normal_impulse;  /* N s on A along +normal, >= 0 */
  float tangent[3];      /* unit, A's sliding relative to B; zero when nothing slides */
  float tangent_impulse; /* N s on A along +tangent: sound friction is <= 0 */
  float pre_position_a[3], pre_velocity_a[3], pre_position_b[3], pre_velocity_b[3];
  float post_position_a[3], post_velocity_a[3], post_position_b[3], post_velocity_b[3];
} broadside_contact;

typedef struct {
  const float* vertices; /* [vertex_count][3], body coordinates, m */
  uint64_t vertex_count;
  const uint32_t* triangles; /* [triangle_count][3] */
  uint64_t triangle_count;
} broadside_mesh;

typedef struct {
  uint32_t mesh; /* index into meshes */
  broadside_state state;
  float inverse_mass; /* 1/kg; 0 = static */
  float mu_static;
  float mu_kinetic;
  float restitution;
} broadside_body;

typedef struct {
  const broadside_mesh* meshes;
  uint32_t mesh_count;
  const broadside_body* bodies;
  uint32_t body_count;
  float domain_min[3]; /* the faces of this box are static half-spaces */
  float domain_max[3];
  float face_mu_static;
  float face_mu_kinetic;
  float face_restitution;
  float gravity[3]; /* m/s^2 */
  float dt;         /* s */
  float delta;      /* slop: penetration that may stay, m */
  float theta;      /* vertices nearer than this touch, m; 0 = the mean edge length of the two meshes */
} broadside_scene;

/* A setting of your engine, a number: --engine './libmine.so[cell_mm=250]'. */
typedef struct {
  const char* key; /* lower case, digits, underscores */
  uint64_t default_value;
  const char* what;
} broadside_setting;

/* When you do not offer a group of functions, all functions of that group are null. */
typedef struct {
  uint32_t abi;      /* BROADSIDE_ENGINE_ABI */
  uint32_t size;     /* sizeof(broadside_engine) */
  const char* id;    /* "my-grid": lower case, digits and dashes, 32 characters at most */
  const char* build; /* library, version, precision: "libmine 1.2, float" */
  const char* what;  /* one line for listings */
  uint32_t memory;   /* BROADSIDE_HOST or BROADSIDE_CUDA */
  uint32_t is_exact; /* broad phase: 1 = promises exactly the overlapping pairs of the boxes; 0 = a superset */
  double margin_m;   /* by which it fattens boxes */

  const broadside_setting* settings;
  uint32_t setting_count;

  /* values[k] is the value of settings[k]. Returns null on failure. */
  void* (*create)(const uint64_t* values);
  void (*destroy)(void* self);
  /* One line about the last failure; when self is null, about the failure of create. */
  const char* (*last_error)(void* self);

  /* Broad phase. load is not timed; update and find are. update gets as many boxes as load. find may follow load. */
  int (*load_boxes)(void* self, const broadside_box* boxes, const uint8_t* is_static, uint32_t count);
  int (*update_boxes)(void* self, const broadside_box* boxes, uint32_t count);
  int (*find_pairs)(void* self);
  /* In any order, each pair once. */
  int (*read_pairs)(void* self, broadside_pair* pairs, uint64_t capacity, uint64_t* demanded);

  /* Narrow phase. load_scene is not timed; measure is. One separation per pair, in order. */
  int (*load_scene)(void* self, const broadside_scene* scene);
  int (*measure)(void* self, const broadside_pair* pairs, uint64_t pair_count, const broadside_pose* poses,
                 uint32_t body_count);
  int (*read_separations)(void* self, broadside_separation* separations, uint64_t capacity, uint64_t* demanded);

  /* Dynamics. begin is not timed; step is. */
  int (*begin)(void* self, const broadside_scene* scene);
  int (*step)(void* self, float dt);
  int (*read_states)(void* self, broadside_state* states, uint32_t body_count);
  /* May be null: contacts of the last step in the order of application. */
  int (*read_contacts)(void* self, broadside_contact* contacts, uint64_t capacity, uint64_t* demanded);
  /* Narrow phase and dynamics: after this call the scene's memory is freed. May be null. */
  void (*end)(void* self);
} broadside_engine;

/* What the library exports. The table lives as long as the library. */
const broadside_engine* broadside_engine_v1(void);

#ifdef __cplusplus
}
#endif

#endif
