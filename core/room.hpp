// Uninitialized storage for items that are written before they are read. Constructing it writes nothing: for arrays
// that are mostly unused, such as the corners of a face that may have many, initialization would take longer than the
// work.
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
