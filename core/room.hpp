// Room for items that are written before they are read. Nothing is written when it begins: where most of it is never
// used, as of a face that may have many corners, that would take longer than the work itself.
#pragma once

#include "core/attributes.hpp"

namespace broadside::core {

template <typename Item, int kCount>
union Room {
  Item items[kCount];

  BROADSIDE_HD Room() {}
  BROADSIDE_HD Item& operator[](int k) { return items[k]; }
  BROADSIDE_HD const Item& operator[](int k) const { return items[k]; }
};

}  // namespace broadside::core
