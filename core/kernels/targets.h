// The kinds of processors that kernels are compiled for.
#pragma once

/// On x86-64, there are versions for SSE4, AVX2, AVX-512 and any other processor. Two more, between
/// these, gain too little for the time that it takes to compile them. The vectors of SVE have no
/// fixed width.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
