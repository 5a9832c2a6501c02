// Simbody's objects behind plain numbers. Its headers are not valid C++20 (their == are ambiguous there), so the source
// beside this header is compiled as C++17, and includes nothing of ours that needs a newer standard.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "reference/plain_rigid/linear.hpp"

namespace broadside::reference {

struct SimbodySurface {
  double dissipation_s_m = 0.0;  // e = 1 - c v for slow impacts at v
  double mu_static = 0.0;
  double mu_kinetic = 0.0;
};

struct SimbodyPose {
  plain::Vec x;  // of the center of mass
  plain::Quaternion q;
  plain::Vec v;
  plain::Vec w;  // world
};

struct SimbodyBody {
  bool is_static = false;
  double mass_kg = 0.0;
  plain::Mat inertia;
  SimbodyPose start;
  plain::Vec shape_at;    // center of the shape from the center of mass, in body axes
  double radius_m = 0.0;  // of a ball; 0: a brick
  plain::Vec half_extents;
  SimbodySurface surface;
  // Constant in the world, and in the body's axes, at the center of mass: N, N m.
  plain::Vec force_world;
  plain::Vec force_body;
  plain::Vec torque_world;
  plain::Vec torque_body;
};

struct SimbodySetup {
  plain::Vec gravity_m_s2;
  double accuracy = 1e-3;
  double stiffness_pa = 0.0;
  double slip_speed_m_s = 0.0;
  bool turns = true;  // otherwise bodies slide along the world's axes
  std::vector<SimbodyBody> bodies;
  // Half-spaces: inward normal along an axis of the world.
  struct Face {
    int axis = 0;
    bool is_upper = false;
    double at_m = 0.0;
  };
  std::vector<Face> faces;
  SimbodySurface face_surface;
};

class SimbodySystem {
 public:
  explicit SimbodySystem(const SimbodySetup& setup);
  SimbodySystem(const SimbodySystem&) = delete;
  SimbodySystem& operator=(const SimbodySystem&) = delete;
  ~SimbodySystem();

  void advance_to(double time_s);
  SimbodyPose pose(std::size_t body) const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

std::string simbody_version();     // "3.7.0"
const void* address_in_simbody();  // of an object inside its library

}  // namespace broadside::reference
