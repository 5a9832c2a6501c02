#include "reference/mutants/mutants.hpp"

#include "reference/mutants/serial_pipeline.hpp"

namespace broadside::reference {

std::unique_ptr<core::Dynamics> make_mutant(const Mutant& mutant, std::uint64_t run) {
  return std::make_unique<SerialPipeline>(mutant.stages, run);
}

}  // namespace broadside::reference
