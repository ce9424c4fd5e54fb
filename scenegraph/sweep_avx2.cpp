// The sweep with AVX2; empty for other processors. CMake compiles this file with -mavx2.
#if defined(__x86_64__)
#define PANTIN_SWEEP_NAMESPACE sweep_avx2
#define PANTIN_SWEEP_LANES 4
#include <pantin/scenegraph/sweep_kernel.inc>
#endif
