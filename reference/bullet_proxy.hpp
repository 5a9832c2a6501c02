// Which body a proxy in one of Bullet's broad phases stands for.
#pragma once

#include <cstdint>

namespace broadside::reference {

// Adapters put the body's number where Bullet keeps a pointer of its user's, m_clientObject.
inline std::uint32_t body_of(const void* client_object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(client_object));
}

}  // namespace broadside::reference
