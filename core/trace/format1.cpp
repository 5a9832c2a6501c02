#include "core/trace/format1.hpp"

#include <string>

namespace broadside::core {

Declaration declaration_of_format1(std::string_view engine) {
  constexpr std::string_view kOtherSolver = "bullet-";
  constexpr std::string_view kOnDevice = "-gpu";
  if (engine.starts_with(kOtherSolver)) return {};
  if (!engine.ends_with(kOnDevice)) return method_declaration();
  return method_declaration(std::string(engine.substr(0, engine.size() - kOnDevice.size())) + "-cpu");
}

}  // namespace broadside::core
