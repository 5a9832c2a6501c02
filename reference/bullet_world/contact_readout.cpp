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
  const btVector3 friction = turn * (point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                     point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2);
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

}  // namespace

std::vector<Contact> read_contacts(btDispatcher& dispatcher, const StepStates& states) {
  std::vector<Contact> contacts;
  for (int k = 0; k < dispatcher.getNumManifolds(); ++k) {
    const btPersistentManifold* manifold = dispatcher.getManifoldByIndexInternal(k);
    for (int p = 0; p < manifold->getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold->getContactPoint(p);
      // Points within the breaking threshold stay in the manifold although they do not touch.
      if (point.getDistance() > 0 && point.m_appliedImpulse == 0) continue;
      contacts.push_back(contact_of(point, body_of(manifold->getBody0()), body_of(manifold->getBody1()), states));
    }
  }
  std::stable_sort(contacts.begin(), contacts.end(), [](const Contact& p, const Contact& q) {
    return std::tuple(core::is_face(p.b), p.a, p.b) < std::tuple(core::is_face(q.b), q.a, q.b);
  });
  return contacts;
}

}  // namespace broadside::reference
