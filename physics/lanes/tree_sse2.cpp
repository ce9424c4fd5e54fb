// The kernel for every machine (flags in physics/CMakeLists.txt).
#include <pantin/physics/lanes/kernel_of.hpp>

namespace pantin::lanes {

namespace {
struct Sse2Lanes {};  // of this source alone
}  // namespace

extern const Kernel kSse2Kernel;
const Kernel kSse2Kernel = kernel_of<Lane<Sse2Lanes, 4>>(InstructionSet::Sse2);

}  // namespace pantin::lanes
