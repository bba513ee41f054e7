// Compiles the file that includes it once for each kind of processor.
//
// That file defines HWY_TARGET_INCLUDE as its own path before. This one has no guard: Highway
// includes the file again for each target, and the last line must then be read again.
#include "core/kernels/targets.h"
// Reads what targets.h defines.
#include <hwy/foreach_target.h>
// Must come last: it reads which target is being compiled.
#include <hwy/highway.h>
