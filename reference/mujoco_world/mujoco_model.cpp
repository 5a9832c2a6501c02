#include "reference/mujoco_world/mujoco_model.hpp"

#include <cstdio>
#include <initializer_list>
#include <numbers>

#include "reference/rigid_world/solid.hpp"

namespace broadside::reference {
namespace {

using plain::Quaternion;
using plain::Vec;

std::string text(std::initializer_list<double> numbers) {
  std::string out;
  char buffer[32];
  for (const double v : numbers) {
    std::snprintf(buffer, sizeof buffer, "%.17g", v);
    out += (out.empty() ? "" : " ") + std::string(buffer);
  }
  return out;
}
std::string text(Vec v) {
  return text({v.x, v.y, v.z});
}
std::string text(Quaternion q) {
  return text({q.w, q.x, q.y, q.z});
}

// name="value", with a space before it.
std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string word(MujocoIntegrator integrator) {
  if (integrator == MujocoIntegrator::kImplicit) return "implicit";
  return integrator == MujocoIntegrator::kRungeKutta ? "RK4" : "Euler";
}

// MuJoCo has one coefficient and takes the larger of two surfaces. It never takes less than 1e-5, so surfaces without
// friction are contacts of one dimension; of two surfaces MuJoCo takes the larger number of dimensions too.
std::string friction(const core::Material& material) {
  return attribute("friction", text({material.mu_kinetic, 0.0, 0.0})) +
         (material.mu_kinetic > 0.0F ? "" : " condim=\"1\"");
}

// Turns z to the inward normal of a face.
Quaternion facing_inward(std::uint32_t face) {
  constexpr double kHalfRoot = 0.5 * std::numbers::sqrt2;
  const int axis = static_cast<int>(face / 2);
  if (face % 2 == 0) return turned_from_z(axis);
  if (axis == 0) return {kHalfRoot, 0.0, -kHalfRoot, 0.0};
  if (axis == 1) return {kHalfRoot, kHalfRoot, 0.0, 0.0};
  return {0.0, 1.0, 0.0, 0.0};
}

std::string plane(const core::Scene& scene, std::uint32_t face) {
  const int axis = static_cast<int>(face / 2);
  Vec at;
  at[axis] = face % 2 == 1 ? scene.domain.max[axis] : scene.domain.min[axis];
  return "<geom type=\"plane\" size=\"0 0 1\"" + attribute("pos", text(at)) +
         attribute("quat", text(facing_inward(face))) + friction(scene.face_material) + "/>\n";
}

std::string mesh_asset(const core::Mesh& mesh, std::size_t index) {
  std::string out = "<mesh" + attribute("name", "mesh" + std::to_string(index)) + " vertex=\"";
  for (const core::Vec3 v : mesh.vertices) out += text({v.x, v.y, v.z}) + " ";
  out += "\" face=\"";
  for (const core::Triangle& t : mesh.triangles)
    for (const std::uint32_t k : t) out += std::to_string(k) + " ";
  return out + "\"/>\n";
}

bool needs_asset(const Solid& solid) {
  return solid.kind == SolidKind::kConvex || solid.kind == SolidKind::kMesh;
}

std::string shape(const Solid& solid, std::uint32_t mesh) {
  const core::Vec3 half = solid.half_extents;
  switch (solid.kind) {
    case SolidKind::kBox:
      return attribute("type", "box") + attribute("size", text({half.x, half.y, half.z}));
    case SolidKind::kSphere:
      return attribute("type", "sphere") + attribute("size", text({solid.radius_m}));
    case SolidKind::kCapsule:
    case SolidKind::kCylinder:
      return attribute("type", solid.kind == SolidKind::kCapsule ? "capsule" : "cylinder") +
             attribute("size", text({solid.radius_m, solid.half_length_m})) +
             attribute("quat", text(turned_from_z(solid.axis)));
    case SolidKind::kConvex:
    case SolidKind::kMesh:
      break;
  }
  return attribute("type", "mesh") + attribute("mesh", "mesh" + std::to_string(mesh));
}

std::string body(const RigidStart& start, const Solid& solid, bool turns) {
  const RigidState& s = start.state;
  const auto& r = start.inertia.row;
  std::string out = "<body" + attribute("pos", text(s.x)) + attribute("quat", text(s.q)) + ">";
  if (!start.is_static) {
    if (turns)
      out += "<freejoint/><inertial pos=\"0 0 0\"" + attribute("mass", text({start.mass_kg})) +
             attribute("fullinertia", text({r[0].x, r[1].y, r[2].z, r[0].y, r[0].z, r[1].z})) + "/>";
    else
      // Sliding along axes of the world; MuJoCo gives axes in the body's.
      for (int axis = 0; axis < 3; ++axis)
        out += "<joint type=\"slide\"" +
               attribute("axis", text(plain::transposed(plain::matrix(s.q)) * plain::axis_of(axis))) + "/>";
    if (!turns)
      out += "<inertial pos=\"0 0 0\" diaginertia=\"1 1 1\"" + attribute("mass", text({start.mass_kg})) + "/>";
  }
  const Vec offset = -1.0 * start.center_of_mass;
  return out + "<geom" + attribute("pos", text(offset)) + shape(solid, start.mesh) + friction(start.material) +
         "/></body>\n";
}

}  // namespace

std::string mujoco_model(const core::Scene& scene, const std::vector<RigidStart>& bodies,
                         const MujocoOptions& options) {
  std::vector<Solid> solids;
  for (const auto& mesh : scene.meshes) solids.push_back(solid_of(mesh));
  // Room for eight points a body, and four rows a point; MuJoCo warns when that is not enough.
  const std::size_t points = 100 + 8 * bodies.size();
  const core::Vec3 g = scene.gravity_m_s2;
  std::string out = "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n<option" +
                    attribute("timestep", text({scene.dt_s})) + attribute("gravity", text({g.x, g.y, g.z})) +
                    attribute("integrator", word(options.integrator)) +
                    attribute("cone", options.has_elliptic_cones ? "elliptic" : "pyramidal") +
                    attribute("impratio", text({options.friction_impedance})) + ">" +
                    (options.has_many_points ? "<flag multiccd=\"enable\"/>" : "") + "</option>\n<size" +
                    attribute("nconmax", std::to_string(points)) + attribute("njmax", std::to_string(4 * points)) +
                    "/>\n<default><geom" + attribute("solref", text({options.contact_time_s, 1.0})) +
                    "/></default>\n<asset>";
  for (std::size_t k = 0; k < solids.size(); ++k)
    if (needs_asset(solids[k])) out += mesh_asset(*solids[k].mesh, k);
  out += "</asset>\n<worldbody>\n";
  for (std::uint32_t face = 0; face < core::kFaceCount; ++face) out += plane(scene, face);
  for (const RigidStart& b : bodies) out += body(b, solids[b.mesh], scene.motion == core::Motion::kRigid);
  return out + "</worldbody></mujoco>\n";
}

}  // namespace broadside::reference
