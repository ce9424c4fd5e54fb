// The kernel for AVX2 with FMA (flags in physics/CMakeLists.txt).
#include <pantin/physics/lanes/kernel_of.hpp>

namespace pantin::lanes {

namespace {
struct Avx2Lanes {};  // of this source alone
}  // namespace

extern const Kernel kAvx2Kernel;
const Kernel kAvx2Kernel = kernel_of<Lane<Avx2Lanes, 4>>(InstructionSet::Avx2);

}  // namespace pantin::lanes
