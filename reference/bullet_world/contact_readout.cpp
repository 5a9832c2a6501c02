#include "reference/bullet_world/contact_readout.hpp"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "reference/bullet_vectors.hpp"

namespace broadside::reference {
namespace {

using core::Contact;

std::uint32_t body_of(const btCollisionObject* object) {
  return static_cast<std::uint32_t>(object->getUserIndex());
}

// Friction on the lower body; turn is 1 where that is Bullet's body 0, else -1.
btVector3 friction_of(const btManifoldPoint& point, btScalar turn) {
  return turn * (point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                 point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2);
}

Contact contact_of(const btManifoldPoint& point, std::uint32_t body0, std::uint32_t body1, const StepStates& states) {
  // Bullet's normal points from its body 1 to its body 0, and impulses act on body 0 along it.
  const btScalar turn = body0 < body1 ? 1 : -1;
  Contact c;
  c.a = std::min(body0, body1);
  c.b = std::max(body0, body1);
  c.color = core::is_face(c.b) ? core::kFaceColor : 0;
  c.depth_m = -point.getDistance();
  c.normal = to_core(turn * point.m_normalWorldOnB);
  c.normal_impulse_n_s = point.m_appliedImpulse;
  const btVector3 friction = friction_of(point, turn);
  const btScalar size = friction.length();
  if (size > 0) {
    c.tangent = to_core(-friction / size);
    c.tangent_impulse_n_s = -size;
  }
  c.pre_a = states.before[c.a];
  c.post_a = states.after[c.a];
  if (!core::is_face(c.b)) {
    c.pre_b = states.before[c.b];
    c.post_b = states.after[c.b];
  }
  return c;
}

// Bullet keeps a point on each surface and lets the two slide apart, by up to its breaking threshold; the impulse on
// each body acts at that body's point. Where both bodies move, the middle between the points is recorded.
btVector3 place_of(const btManifoldPoint& point, const btCollisionObject& body0, const btCollisionObject& body1) {
  if (body1.isStaticObject()) return point.getPositionWorldOnA();
  if (body0.isStaticObject()) return point.getPositionWorldOnB();
  return btScalar(0.5) * (point.getPositionWorldOnA() + point.getPositionWorldOnB());
}

core::ContactPoint point_of(const btManifoldPoint& point, const btCollisionObject& object0,
                            const btCollisionObject& object1) {
  const std::uint32_t body0 = body_of(&object0);
  const std::uint32_t body1 = body_of(&object1);
  const btScalar turn = body0 < body1 ? 1 : -1;
  const btVector3 normal = turn * point.m_normalWorldOnB;
  core::ContactPoint p;
  p.a = std::min(body0, body1);
  p.b = std::max(body0, body1);
  p.point = to_core(place_of(point, object0, object1));
  p.normal = to_core(normal);
  p.gap_m = point.getDistance();
  p.impulse = to_core(point.m_appliedImpulse * normal + friction_of(point, turn));
  return p;
}

// Pairs of bodies come first and pairs with faces after them, each ordered by body.
template <typename T>
bool is_before(const T& p, const T& q) {
  return std::tuple(core::is_face(p.b), p.a, p.b) < std::tuple(core::is_face(q.b), q.a, q.b);
}

// Points within the breaking threshold stay in the manifold although they do not touch.
bool is_contact(const btManifoldPoint& point) {
  return !(point.getDistance() > 0) || point.m_appliedImpulse != 0;
}

// Bullet skips friction in sweeps where the normal impulse is zero, so a point may keep friction of earlier sweeps when
// its normal impulse is gone.
bool acts(const btManifoldPoint& point) {
  return is_contact(point) || point.m_appliedImpulseLateral1 != 0 || point.m_appliedImpulseLateral2 != 0;
}

// Calls use(point, object 0, object 1) for each manifold point.
template <typename Use>
void each_point(btDispatcher& dispatcher, const Use& use) {
  for (int k = 0; k < dispatcher.getNumManifolds(); ++k) {
    const btPersistentManifold* manifold = dispatcher.getManifoldByIndexInternal(k);
    for (int p = 0; p < manifold->getNumContacts(); ++p)
      use(manifold->getContactPoint(p), *manifold->getBody0(), *manifold->getBody1());
  }
}

}  // namespace

std::vector<Contact> read_contacts(btDispatcher& dispatcher, const StepStates& states) {
  std::vector<Contact> contacts;
  each_point(dispatcher,
             [&](const btManifoldPoint& point, const btCollisionObject& object0, const btCollisionObject& object1) {
               if (is_contact(point))
                 contacts.push_back(contact_of(point, body_of(&object0), body_of(&object1), states));
             });
  std::stable_sort(contacts.begin(), contacts.end(), is_before<Contact>);
  return contacts;
}

std::vector<core::ContactPoint> read_points(btDispatcher& dispatcher) {
  std::vector<core::ContactPoint> points;
  each_point(dispatcher,
             [&](const btManifoldPoint& point, const btCollisionObject& object0, const btCollisionObject& object1) {
               if (acts(point)) points.push_back(point_of(point, object0, object1));
             });
  std::stable_sort(points.begin(), points.end(), is_before<core::ContactPoint>);
  return points;
}

}  // namespace broadside::reference
