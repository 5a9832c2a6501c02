// Examples that write traces in Python.
#pragma once

#include <cstdlib>
#include <string>

namespace broadside::tests {

// A Python that has h5py and numpy; "" when none is here.
inline std::string python_with_h5py() {
  for (const char* name : {"/usr/bin/python3", "python3"})
    if (std::system((std::string(name) + " -c 'import h5py, numpy' >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

}  // namespace broadside::tests
