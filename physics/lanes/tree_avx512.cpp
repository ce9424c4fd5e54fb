// The kernel for AVX-512 (flags in physics/CMakeLists.txt).
#include <pantin/physics/lanes/kernel_of.hpp>

namespace pantin::lanes {

namespace {
struct Avx512Lanes {};  // of this source alone
}  // namespace

extern const Kernel kAvx512Kernel;
const Kernel kAvx512Kernel = kernel_of<Lane<Avx512Lanes, 8>>(InstructionSet::Avx512);

}  // namespace pantin::lanes
