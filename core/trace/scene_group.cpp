#include "core/trace/scene_group.hpp"

#include <array>
#include <cstddef>
#include <cstring>

namespace broadside::core {
namespace {

// Plain numbers of a struct, by name. Writing and reading use the same table, so that neither can forget a field.
struct Field {
  const char* name;
  Element element;
  std::size_t offset;
  std::uint32_t width;
  const char* unit;
};

constexpr std::array kParameterFields{
    Field{"delta_m", Element::kF32, offsetof(Parameters, delta_m), 1, "m"},
    Field{"beta", Element::kF32, offsetof(Parameters, beta), 1, "1"},
    Field{"alpha", Element::kF32, offsetof(Parameters, alpha), 1, "1"},
    Field{"v_threshold_m_s", Element::kF32, offsetof(Parameters, v_threshold_m_s), 1, "m/s"},
    Field{"impulse_min_n_s", Element::kF32, offsetof(Parameters, impulse_min_n_s), 1, "N s"},
    Field{"v_max_m_s", Element::kF32, offsetof(Parameters, v_max_m_s), 1, "m/s"},
    Field{"epsilon_m", Element::kF32, offsetof(Parameters, epsilon_m), 1, "m"},
    Field{"theta_m", Element::kF32, offsetof(Parameters, theta_m), 1, "m"},
    Field{"hash_cell_m", Element::kF32, offsetof(Parameters, hash_cell_m), 1, "m"},
};
static_assert(kParameterFields.size() * sizeof(float) == sizeof(Parameters), "a new parameter needs its row");

constexpr std::array kMaterialFields{
    Field{"mu_static", Element::kF32, offsetof(Material, mu_static), 1, "1"},
    Field{"mu_kinetic", Element::kF32, offsetof(Material, mu_kinetic), 1, "1"},
    Field{"restitution", Element::kF32, offsetof(Material, restitution), 1, "1"},
};
static_assert(kMaterialFields.size() * sizeof(float) == sizeof(Material), "a new material property needs its row");

constexpr std::array kBodyFields{
    Field{"mesh", Element::kU32, offsetof(Body, mesh), 1, "1"},
    Field{"position", Element::kF32, offsetof(Body, position), 3, "m"},
    Field{"orientation", Element::kF32, offsetof(Body, orientation), 4, "1"},
    Field{"velocity", Element::kF32, offsetof(Body, velocity), 3, "m/s"},
    Field{"angular_velocity", Element::kF32, offsetof(Body, angular_velocity), 3, "rad/s"},
    Field{"inverse_mass", Element::kF32, offsetof(Body, inverse_mass), 1, "1/kg"},
    Field{"mu_static", Element::kF32, offsetof(Body, material) + offsetof(Material, mu_static), 1, "1"},
    Field{"mu_kinetic", Element::kF32, offsetof(Body, material) + offsetof(Material, mu_kinetic), 1, "1"},
    Field{"restitution", Element::kF32, offsetof(Body, material) + offsetof(Material, restitution), 1, "1"},
};
static_assert(sizeof(Body) == 18 * sizeof(float), "a new property of a body needs its row");

constexpr std::array kSceneFields{
    Field{"domain", Element::kF32, offsetof(Scene, domain), 6, "m"},
    Field{"gravity_m_s2", Element::kF32, offsetof(Scene, gravity_m_s2), 3, "m/s^2"},
    Field{"dt_s", Element::kF32, offsetof(Scene, dt_s), 1, "s"},
    Field{"frames", Element::kU32, offsetof(Scene, frames), 1, "1"},
    Field{"seed", Element::kU64, offsetof(Scene, seed), 1, "1"},
};

template <typename Table>
void write_attributes(Hdf5Sink& sink, const std::string& path, const Table& table, const void* object) {
  for (const Field& f : table)
    sink.number(path, f.name, f.element, static_cast<const std::byte*>(object) + f.offset, f.width);
}

template <typename Table>
void read_attributes(Hdf5Source& source, const std::string& path, const Table& table, void* object) {
  for (const Field& f : table)
    source.numbers(path, f.name, f.element, static_cast<std::byte*>(object) + f.offset, f.width);
}

constexpr std::array kSpringFields{
    Field{"body", Element::kU32, offsetof(Spring, body), 1, "1"},
    Field{"anchor", Element::kF32, offsetof(Spring, anchor), 3, "m"},
    Field{"stiffness", Element::kF32, offsetof(Spring, stiffness_n_m), 1, "N/m"},
    Field{"damping", Element::kF32, offsetof(Spring, damping_n_s_m), 1, "N s/m"},
};
static_assert(sizeof(Spring) == 6 * sizeof(float), "a new property of a spring needs its row");

constexpr std::array kWrenchFields{
    Field{"body", Element::kU32, offsetof(Wrench, body), 1, "1"},
    Field{"axes", Element::kU32, offsetof(Wrench, axes), 1, "1"},
    Field{"force", Element::kF32, offsetof(Wrench, force_n), 3, "N"},
    Field{"torque", Element::kF32, offsetof(Wrench, torque_n_m), 3, "N m"},
};
static_assert(sizeof(Wrench) == 8 * sizeof(float), "a new property of a wrench needs its row");

// Writes an array of structs as one dataset per field.
template <typename Table, typename Row>
void write_rows(Hdf5Sink& sink, const std::string& group, const Table& table, const std::vector<Row>& rows) {
  sink.group(group);
  std::vector<std::byte> column;
  for (const Field& f : table) {
    const std::size_t bytes = f.width * size_of(f.element);
    column.resize(rows.size() * bytes);
    for (std::size_t i = 0; i < rows.size(); ++i)
      std::memcpy(&column[i * bytes], reinterpret_cast<const std::byte*>(&rows[i]) + f.offset, bytes);
    sink.array(group + "/" + f.name, f.element, f.width, rows.size(), column.data(), f.unit);
  }
}

template <typename Row, typename Table>
std::vector<Row> read_rows(Hdf5Source& source, const std::string& group, const Table& table, const std::string& row) {
  std::vector<Row> rows;
  for (const Field& f : table) {
    const std::string path = group + "/" + f.name;
    const std::size_t bytes = f.width * size_of(f.element);
    const std::vector<std::byte> column = source.whole<std::byte>(path, f.element, f.width);
    if (!source.ok()) return {};
    if (&f == table.data()) rows.resize(column.size() / bytes);
    if (column.size() != rows.size() * bytes) {
      source.fail(path, "it does not have one row per " + row, "give every array of " + group + " the same length");
      return {};
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
      std::memcpy(reinterpret_cast<std::byte*>(&rows[i]) + f.offset, &column[i * bytes], bytes);
  }
  return rows;
}

constexpr const char* kInertia = "/scene/body/inertia";
constexpr const char* kCenterOfMass = "/scene/body/center_of_mass";

void write_mass_properties(Hdf5Sink& sink, const std::vector<MassProperties>& rows) {
  std::vector<double> inertia;
  std::vector<double> center;
  for (const MassProperties& m : rows) {
    inertia.insert(inertia.end(), m.inertia_kg_m2.begin(), m.inertia_kg_m2.end());
    center.insert(center.end(), m.center_of_mass_m.begin(), m.center_of_mass_m.end());
  }
  sink.array(kInertia, Element::kF64, 6, rows.size(), inertia.data(), "kg m^2");
  sink.array(kCenterOfMass, Element::kF64, 3, rows.size(), center.data(), "m");
}

// Inertia without a center of mass refers to the mesh's origin.
std::vector<MassProperties> read_mass_properties(Hdf5Source& source, std::size_t bodies) {
  if (!source.has(kInertia)) {
    if (source.has(kCenterOfMass))
      source.fail(kCenterOfMass, "it is given without the inertia", std::string("give ") + kInertia + " too");
    return {};
  }
  const auto inertia = source.whole<std::array<double, 6>>(kInertia, Element::kF64, 6);
  std::vector<std::array<double, 3>> center(bodies);
  if (source.ok() && source.has(kCenterOfMass))
    center = source.whole<std::array<double, 3>>(kCenterOfMass, Element::kF64, 3);
  if (!source.ok()) return {};
  if (inertia.size() != bodies || center.size() != bodies) {
    source.fail(inertia.size() != bodies ? kInertia : kCenterOfMass, "it does not have one row per body",
                "give every array of /scene/body the same length");
    return {};
  }
  std::vector<MassProperties> rows;
  for (std::size_t i = 0; i < bodies; ++i) rows.push_back({center[i], inertia[i]});
  return rows;
}

constexpr const char* kFast = "/scene/body/fast";

std::vector<std::uint8_t> read_fast(Hdf5Source& source, std::size_t bodies) {
  if (!source.has(kFast)) return {};
  std::vector<std::uint8_t> rows = source.whole<std::uint8_t>(kFast, Element::kU8, 1);
  if (source.ok() && rows.size() != bodies)
    source.fail(kFast, "it does not have one row per body", "give every array of /scene/body the same length");
  return rows;
}

Motion read_motion(Hdf5Source& source) {
  if (!source.has_attribute("/scene", "motion")) return Motion::kTranslate;
  const std::string word = source.text("/scene", "motion");
  if (source.ok() && word != motion_word(Motion::kRigid) && word != motion_word(Motion::kTranslate))
    source.fail("/scene@motion", "there is no motion \"" + word + "\"", "give translate or rigid");
  return word == motion_word(Motion::kRigid) ? Motion::kRigid : Motion::kTranslate;
}

void write_meshes(Hdf5Sink& sink, const std::vector<std::shared_ptr<const Mesh>>& meshes) {
  std::vector<std::string> names;
  std::vector<std::string> sources;
  std::vector<std::uint8_t> stand_ins;
  std::vector<std::uint64_t> vertex_offsets{0};
  std::vector<std::uint64_t> triangle_offsets{0};
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const auto& m : meshes) {
    names.push_back(m->name);
    sources.push_back(m->source);
    stand_ins.push_back(m->is_stand_in ? 1 : 0);
    vertices.insert(vertices.end(), m->vertices.begin(), m->vertices.end());
    triangles.insert(triangles.end(), m->triangles.begin(), m->triangles.end());
    vertex_offsets.push_back(vertices.size());
    triangle_offsets.push_back(triangles.size());
  }
  sink.group("/scene/mesh");
  sink.texts("/scene/mesh/name", names, "1");
  sink.texts("/scene/mesh/source", sources, "1");
  sink.array("/scene/mesh/is_stand_in", Element::kU8, 1, stand_ins.size(), stand_ins.data(), "1");
  sink.array("/scene/mesh/vertex_offsets", Element::kU64, 1, vertex_offsets.size(), vertex_offsets.data(), "1");
  sink.array("/scene/mesh/vertices", Element::kF32, 3, vertices.size(), vertices.data(), "m");
  sink.array("/scene/mesh/triangle_offsets", Element::kU64, 1, triangle_offsets.size(), triangle_offsets.data(), "1");
  sink.array("/scene/mesh/triangles", Element::kU32, 3, triangles.size(), triangles.data(), "1");
}

bool are_offsets(const std::vector<std::uint64_t>& offsets, std::size_t lists, std::size_t rows) {
  if (offsets.size() != lists + 1 || offsets.front() != 0 || offsets.back() != rows) return false;
  for (std::size_t i = 0; i < lists; ++i)
    if (offsets[i] > offsets[i + 1]) return false;
  return true;
}

std::vector<std::shared_ptr<const Mesh>> read_meshes(Hdf5Source& source) {
  const auto names = source.texts("/scene/mesh/name");
  const auto sources = source.texts("/scene/mesh/source");
  const auto stand_ins = source.whole<std::uint8_t>("/scene/mesh/is_stand_in", Element::kU8, 1);
  const auto vertex_offsets = source.whole<std::uint64_t>("/scene/mesh/vertex_offsets", Element::kU64, 1);
  const auto vertices = source.whole<Vec3>("/scene/mesh/vertices", Element::kF32, 3);
  const auto triangle_offsets = source.whole<std::uint64_t>("/scene/mesh/triangle_offsets", Element::kU64, 1);
  const auto triangles = source.whole<Triangle>("/scene/mesh/triangles", Element::kU32, 3);
  if (!source.ok()) return {};
  const std::size_t count = names.size();
  if (sources.size() != count || stand_ins.size() != count || !are_offsets(vertex_offsets, count, vertices.size()) ||
      !are_offsets(triangle_offsets, count, triangles.size())) {
    source.fail("/scene/mesh", "names, offsets, vertices and triangles do not fit together",
                "one name, source and flag per mesh; offsets start with 0, never fall, end with the number of rows");
    return {};
  }
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (std::size_t i = 0; i < count; ++i) {
    auto m = std::make_shared<Mesh>();
    m->name = names[i];
    m->source = sources[i];
    m->is_stand_in = stand_ins[i] != 0;
    m->vertices.assign(vertices.data() + vertex_offsets[i], vertices.data() + vertex_offsets[i + 1]);
    m->triangles.assign(triangles.data() + triangle_offsets[i], triangles.data() + triangle_offsets[i + 1]);
    meshes.push_back(std::move(m));
  }
  return meshes;
}

}  // namespace

void write_scene(Hdf5Sink& sink, const Scene& scene) {
  sink.group("/scene");
  sink.text("/scene", "name", scene.name);
  sink.text("/scene", "description", scene.description);
  const std::uint64_t digest = scene_digest(scene);
  sink.number("/scene", "digest", Element::kU64, &digest);
  write_attributes(sink, "/scene", kSceneFields, &scene);
  sink.group("/scene/parameters");
  write_attributes(sink, "/scene/parameters", kParameterFields, &scene.parameters);
  sink.group("/scene/face_material");
  write_attributes(sink, "/scene/face_material", kMaterialFields, &scene.face_material);
  write_rows(sink, "/scene/body", kBodyFields, scene.bodies);
  sink.text("/scene", "motion", std::string(motion_word(scene.motion)));
  if (!scene.answer.empty()) sink.text("/scene", "answer", scene.answer);
  if (!scene.mass_properties.empty()) write_mass_properties(sink, scene.mass_properties);
  if (!scene.is_fast.empty()) sink.array(kFast, Element::kU8, 1, scene.is_fast.size(), scene.is_fast.data(), "1");
  if (!scene.springs.empty()) write_rows(sink, "/scene/spring", kSpringFields, scene.springs);
  if (!scene.wrenches.empty()) write_rows(sink, "/scene/wrench", kWrenchFields, scene.wrenches);
  write_meshes(sink, scene.meshes);
}

Scene read_scene(Hdf5Source& source) {
  Scene scene;
  scene.name = source.text("/scene", "name");
  if (source.has_attribute("/scene", "description")) scene.description = source.text("/scene", "description");
  read_attributes(source, "/scene", kSceneFields, &scene);
  read_attributes(source, "/scene/parameters", kParameterFields, &scene.parameters);
  read_attributes(source, "/scene/face_material", kMaterialFields, &scene.face_material);
  scene.motion = read_motion(source);
  if (source.has_attribute("/scene", "answer")) scene.answer = source.text("/scene", "answer");
  scene.bodies = read_rows<Body>(source, "/scene/body", kBodyFields, "body");
  if (source.ok()) scene.mass_properties = read_mass_properties(source, scene.bodies.size());
  if (source.ok()) scene.is_fast = read_fast(source, scene.bodies.size());
  if (source.ok() && source.has("/scene/spring"))
    scene.springs = read_rows<Spring>(source, "/scene/spring", kSpringFields, "spring");
  if (source.ok() && source.has("/scene/wrench"))
    scene.wrenches = read_rows<Wrench>(source, "/scene/wrench", kWrenchFields, "wrench");
  scene.meshes = read_meshes(source);
  if (!source.ok()) return scene;
  if (const Status s = check_scene(scene); !s)
    source.fail("/scene", s.error().what + " at " + s.error().where, s.error().advice);
  if (source.has_attribute("/scene", "digest") &&
      source.number<std::uint64_t>("/scene", "digest") != scene_digest(scene))
    source.fail("/scene@digest", "it is not the digest of the scene in this file",
                "the file was changed after it was recorded: record it again");
  return scene;
}

}  // namespace broadside::core
