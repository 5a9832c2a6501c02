#include "bench/agree/case.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kFormat = "broadside-pair";
constexpr std::string_view kMotionFormat = "broadside-motion";

Json body_of(const core::Mesh& mesh, const core::Pose& pose) {
  Json vertices = Json::array();
  for (const core::Vec3 v : mesh.vertices) vertices.push_back({v.x, v.y, v.z});
  const core::Quat q = pose.orientation;
  return {{"mesh", mesh.name},
          {"vertices", std::move(vertices)},
          {"triangles", mesh.triangles},
          {"position", {pose.position.x, pose.position.y, pose.position.z}},
          {"orientation", {q.w, q.x, q.y, q.z}}};
}

core::Vec3 vector_of(const Json& v) {
  return {v.at(0).get<float>(), v.at(1).get<float>(), v.at(2).get<float>()};
}

std::shared_ptr<const core::Mesh> mesh_of(const Json& body) {
  core::Mesh mesh;
  mesh.name = body.at("mesh").get<std::string>();
  mesh.source = "a saved pair";
  for (const Json& v : body.at("vertices")) mesh.vertices.push_back(vector_of(v));
  for (const Json& t : body.at("triangles")) {
    mesh.triangles.push_back(t.get<core::Triangle>());
    for (const std::uint32_t v : mesh.triangles.back())
      if (v >= mesh.vertices.size()) throw std::out_of_range("a triangle names a vertex that does not exist");
  }
  if (mesh.triangles.empty()) throw std::out_of_range("a mesh has no triangles");
  return std::make_shared<const core::Mesh>(std::move(mesh));
}

core::Pose pose_of(const Json& body) {
  const Json& q = body.at("orientation");
  return {vector_of(body.at("position")),
          {q.at(0).get<float>(), q.at(1).get<float>(), q.at(2).get<float>(), q.at(3).get<float>()}};
}

Json moving_body_of(const core::Mesh& mesh, const exact::RigidMotion& motion) {
  Json out = body_of(mesh, motion.start);
  const exact::Point& d = motion.displacement_m;
  const exact::Point& r = motion.rotation_rad;
  out["displacement"] = {d.x, d.y, d.z};
  out["rotation"] = {r.x, r.y, r.z};
  return out;
}

exact::RigidMotion motion_of(const Json& body) {
  const auto point = [](const Json& v) {
    return exact::Point{v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
  };
  return {pose_of(body), point(body.at("displacement")), point(body.at("rotation"))};
}

// Reads a file of this format; read(json) makes the case from its content.
template <typename Case, typename Read>
core::Result<Case> read_saved(const std::filesystem::path& file, std::string_view format, const Read& read) {
  std::ifstream in(file);
  if (!in) return core::Error{"cannot be read", file.string(), "give a file that agree saved"};
  try {
    const Json saved = Json::parse(in);
    if (saved.at("format") != format || saved.at("version") != 1)
      return core::Error{"it is no saved case '" + std::string(format) + "' of version 1", file.string(),
                         "give a file that agree saved"};
    return read(saved);
  } catch (const std::exception& e) {
    return core::Error{std::string("it is damaged: ") + e.what(), file.string(), "give a file that agree saved"};
  }
}

}  // namespace

core::Status write_case(const PairSource& source, const TestPair& pair, const std::filesystem::path& file) {
  const Json out{{"format", kFormat},
                 {"version", 1},
                 {"is_convex", source.has_depth()},
                 {"distance_m", pair.distance_m},
                 {"a", body_of(*source.meshes()[pair.mesh_a], pair.pose_a)},
                 {"b", body_of(*source.meshes()[pair.mesh_b], pair.pose_b)}};
  return core::write_whole_file(file, out.dump() + "\n");
}

core::Result<Case> read_case(const std::filesystem::path& file) {
  return read_saved<Case>(file, kFormat, [](const Json& saved) -> core::Result<Case> {
    auto source = PairSource::of_case({mesh_of(saved.at("a")), mesh_of(saved.at("b"))}, saved.at("is_convex"));
    if (!source) return source.error();
    TestPair pair;
    pair.mesh_a = 0;
    pair.mesh_b = 1;
    pair.pose_a = pose_of(saved.at("a"));
    pair.pose_b = pose_of(saved.at("b"));
    source.value().arbitrate(pair);
    return Case{std::move(source).value(), pair};
  });
}

core::Status write_motion_case(const BodySource& source, const MotionTest& test, const std::filesystem::path& file) {
  const Json out{{"format", kMotionFormat},
                 {"version", 1},
                 {"are_solid", source.are_solid()},
                 {"a", moving_body_of(*source.meshes()[test.a.mesh], test.a.motion)},
                 {"b", moving_body_of(*source.meshes()[test.b.mesh], test.b.motion)}};
  return core::write_whole_file(file, out.dump() + "\n");
}

core::Result<MotionCase> read_motion_case(const std::filesystem::path& file) {
  return read_saved<MotionCase>(file, kMotionFormat, [](const Json& saved) -> core::Result<MotionCase> {
    BodySource source = BodySource::of_meshes({mesh_of(saved.at("a")), mesh_of(saved.at("b"))}, saved.at("are_solid"));
    MotionTest test;
    test.a = {0, motion_of(saved.at("a"))};
    test.b = {1, motion_of(saved.at("b"))};
    source.arbitrate(test);
    return MotionCase{std::move(source), test};
  });
}

}  // namespace broadside::bench
