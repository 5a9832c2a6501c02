#include "reference/mutants/serial_pipeline.hpp"

#include <algorithm>
#include <utility>

#include "core/method/frame_digest.hpp"
#include "core/method/integrate.hpp"
#include "core/method/levels.hpp"
#include "core/method/response.hpp"
#include "reference/octree_cpu/vertex_stage.hpp"

namespace broadside::reference {
namespace {

using core::Contact;
using core::Pair;
using core::Vec3;

const core::NodeBoxes& boxes_of(const World& world, std::uint32_t body) {
  return world.bodies.shapes[world.bodies.shape[body]].boxes;
}

}  // namespace

SerialPipeline::SerialPipeline(const Stages& stages, std::uint64_t run) : stages_(stages) {
  world_.run = run;
}

const char* SerialPipeline::settings() {
  return "broad=octree,contact=conjugate,levels=C,sleep=off,solver=colored,substeps=0,sweep=flagged,threads=1,"
         "thresholds=scaled,variant=sound,vertex_stage=on";
}

core::Status SerialPipeline::load(const core::Scene& scene) {
  const std::uint64_t run = world_.run;
  world_ = {};
  world_.run = run;
  world_.scene = &scene;
  world_.bodies = make_bodies(scene);
  return core::Done{};
}

core::Status SerialPipeline::step(float dt_s) {
  World& w = world_;
  w.dt_s = dt_s;
  ++w.step;
  w.last_state = w.bodies.state;
  w.last_boxes = w.bodies.boxes;
  w.last_pairs = w.candidates.pairs;
  w.contacts.clear();
  integrate();
  find_candidates();
  confirm();
  if (stages_.faces_first) resolve_faces();
  resolve_bodies();
  if (!stages_.faces_first) resolve_faces();
  for (std::uint32_t i = 0; i < w.bodies.count(); ++i) {
    if (w.bodies.is_static[i] != 0) continue;
    Vec3& v = w.bodies.state[i].v;
    const float v_max = w.scene->parameters.v_max_m_s;
    v = stages_.clip != nullptr ? stages_.clip(v, v_max) : core::clipped(v, v_max);
  }
  if (stages_.end != nullptr) stages_.end(w);
  return core::Done{};
}

void SerialPipeline::integrate() {
  World& w = world_;
  for (std::uint32_t i = 0; i < w.bodies.count(); ++i) {
    Vec3 acceleration = w.scene->gravity_m_s2;
    for (const core::Spring& s : w.bodies.springs_of(i))
      acceleration = acceleration + core::spring_acceleration(s, w.bodies.state[i], w.bodies.inverse_mass[i]);
    w.bodies.state[i] =
        stages_.integrate != nullptr
            ? stages_.integrate(w, i, acceleration)
            : core::semi_implicit_euler(w.bodies.state[i], w.bodies.inverse_mass[i], acceleration, w.dt_s);
    w.bodies.detected[i] = w.bodies.state[i];
  }
  for (std::uint32_t i = 0; i < w.bodies.count(); ++i)
    w.bodies.boxes[i] =
        stages_.box != nullptr ? stages_.box(w, i) : core::translated(w.bodies.local_box(i), w.bodies.state[i].x);
}

void SerialPipeline::find_candidates() {
  World& w = world_;
  octree_.find_pairs(w.bodies.boxes, w.bodies.is_static, w.scene->domain, w.candidates.pairs);
  w.candidates.demanded = w.candidates.raw = w.candidates.pairs.size();
  if (stages_.candidates != nullptr) stages_.candidates(w);
}

void SerialPipeline::confirm() {
  World& w = world_;
  w.confirmed.clear();
  for (const Pair p : w.candidates.pairs) {
    const bool is_confirmed = stages_.confirms != nullptr
                                  ? stages_.confirms(w, p)
                                  : core::is_confirmed(core::Levels::kC, boxes_of(w, p.i), w.bodies.state[p.i].x,
                                                       boxes_of(w, p.j), w.bodies.state[p.j].x);
    if (is_confirmed) w.confirmed.push_back(p);
  }
  measure_proximity(w.bodies, w.scene->parameters, w.confirmed, w.proximity);
  if (stages_.nearest == nullptr) return;
  for (std::size_t k = 0; k < w.confirmed.size(); ++k)
    w.proximity[k] = stages_.nearest(w, w.confirmed[k], w.proximity[k]);
}

bool SerialPipeline::is_written(std::uint32_t body) const {
  return world_.bodies.is_static[body] == 0 || stages_.moves_static;
}

void SerialPipeline::apply(Contact& contact, const core::ContactGeometry& geometry, float w_b,
                           const core::Material& material) {
  World& w = world_;
  const float w_a = w.bodies.inverse_mass[contact.a];
  const Application application{contact, geometry, w_a, w_b, material, w.scene->parameters};
  if (stages_.respond != nullptr)
    stages_.respond(w, application);
  else
    application.apply(material, w.scene->parameters);
  if (stages_.store != nullptr) stages_.store(w, contact);
  if (is_written(contact.a)) w.bodies.state[contact.a] = contact.post_a;
  if (!core::is_face(contact.b) && is_written(contact.b)) w.bodies.state[contact.b] = contact.post_b;
  if (contact.depth_m != 0.0F) w.contacts.push_back(contact);
}

void SerialPipeline::resolve_bodies() {
  World& w = world_;
  std::vector<Pair> touching;
  for (std::size_t k = 0; k < w.confirmed.size(); ++k)
    if (w.proximity[k].is_touching()) touching.push_back(w.confirmed[k]);
  std::vector<std::uint8_t> never_written;
  for (std::uint32_t i = 0; i < w.bodies.count(); ++i) never_written.push_back(is_written(i) ? 0 : 1);
  coloring_.color(touching, never_written);
  Order order;
  for (std::uint32_t color = 0; color < coloring_.color_count(); ++color)
    for (std::uint32_t k = coloring_.color_begin()[color]; k < coloring_.color_begin()[color + 1]; ++k) {
      order.pairs.push_back(touching[coloring_.order()[k]]);
      order.color.push_back(color);
    }
  if (stages_.order != nullptr) stages_.order(w, order);
  for (std::size_t k = 0; k < order.pairs.size(); ++k) {
    const Pair p = order.pairs[k];
    Contact c;
    c.a = p.i;
    c.b = p.j;
    c.color = order.color[k];
    core::ContactGeometry geometry = core::box_contact(core::translated(w.bodies.local_box(p.i), w.bodies.state[p.i].x),
                                                       core::translated(w.bodies.local_box(p.j), w.bodies.state[p.j].x),
                                                       w.scene->parameters.epsilon_m);
    if (stages_.geometry != nullptr) geometry = stages_.geometry(w, p, geometry);
    if (!geometry.exists) continue;
    c.pre_a = w.bodies.state[p.i];
    c.pre_b = w.bodies.state[p.j];
    const core::Material& a = w.bodies.material[p.i];
    const core::Material& b = w.bodies.material[p.j];
    apply(c, geometry, w.bodies.inverse_mass[p.j], stages_.combine != nullptr ? stages_.combine(a, b) : combine(a, b));
  }
}

void SerialPipeline::resolve_faces() {
  World& w = world_;
  for (std::uint32_t body = 0; body < w.bodies.count(); ++body) {
    if (w.bodies.is_static[body] != 0) continue;
    for (int face = 0; face < core::kFaceCount; ++face) {
      core::ContactGeometry geometry =
          core::face_contact(core::translated(w.bodies.local_box(body), w.bodies.state[body].x), w.scene->domain, face);
      if (stages_.face_geometry != nullptr) geometry = stages_.face_geometry(w, body, face, geometry);
      if (!geometry.exists) continue;
      Contact c;
      c.a = body;
      c.b = core::kFirstFace + static_cast<std::uint32_t>(face);
      c.color = core::kFaceColor;
      c.pre_a = w.bodies.state[body];
      const core::Material& a = w.bodies.material[body];
      const core::Material& b = w.scene->face_material;
      apply(c, geometry, 0.0F, stages_.combine != nullptr ? stages_.combine(a, b) : combine(a, b));
    }
  }
}

std::uint32_t SerialPipeline::groups() const {
  using core::Group;
  return core::bit(Group::kBodies) | core::bit(Group::kDetection) | core::bit(Group::kPairs) |
         core::bit(Group::kConfirmed) | core::bit(Group::kContacts) | core::bit(Group::kOctree) |
         core::bit(Group::kBodyOctree);
}

core::Status SerialPipeline::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  const World& w = world_;
  frame = {};
  frame.step = w.step;
  frame.time_s = static_cast<double>(w.step) * static_cast<double>(w.dt_s);
  for (std::uint32_t i = 0; i < w.bodies.count(); ++i)
    frame.digest += core::body_digest(i, w.bodies.state[i].x, w.scene->bodies[i].orientation, w.bodies.state[i].v,
                                      w.scene->bodies[i].angular_velocity);
  for (const Pair p : w.confirmed) frame.digest += core::confirmed_digest(p);
  for (const Contact& c : w.contacts) frame.digest += core::contact_digest(c);
  if (level != core::RecordLevel::kFull) return core::Done{};
  for (std::uint32_t i = 0; i < w.bodies.count(); ++i) {
    frame.position.push_back(w.bodies.state[i].x);
    frame.velocity.push_back(w.bodies.state[i].v);
    frame.orientation.push_back(w.scene->bodies[i].orientation);
    frame.angular_velocity.push_back(w.scene->bodies[i].angular_velocity);
    frame.detected_position.push_back(w.bodies.detected[i].x);
    frame.detected_velocity.push_back(w.bodies.detected[i].v);
  }
  frame.boxes = w.bodies.boxes;
  frame.pairs = w.candidates.pairs;
  frame.pairs_demanded = w.candidates.demanded;
  frame.pairs_raw = w.candidates.raw;
  frame.confirmed = w.confirmed;
  frame.proximity = w.proximity;
  frame.contacts = w.contacts;
  octree_.tell_octree(frame.octree_nodes, frame.octree_node_of_body);
  if (w.step == 1) {
    frame.shape_of_body = w.bodies.shape;
    for (const ShapeData& s : w.bodies.shapes) {
      const core::BodyOctree& tree = s.shape.octree;
      frame.body_octree_boxes.insert(frame.body_octree_boxes.end(), tree.boxes.begin(), tree.boxes.end());
      frame.leaf_of_vertex.insert(frame.leaf_of_vertex.end(), tree.leaf_of_vertex.begin(), tree.leaf_of_vertex.end());
    }
  }
  if (stages_.tell != nullptr) stages_.tell(w, frame);
  return core::Done{};
}

}  // namespace broadside::reference
