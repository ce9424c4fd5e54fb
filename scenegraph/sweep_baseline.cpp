// The sweep with what the build is for.
#define PANTIN_SWEEP_NAMESPACE sweep_baseline
#if defined(__SSE2__)
#define PANTIN_SWEEP_LANES 2
#else
#define PANTIN_SWEEP_LANES 1
#endif
#include <pantin/scenegraph/sweep_kernel.inc>
