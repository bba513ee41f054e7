// Loops over pixels, compiled for newer processors too.
#pragma once

#include <cstddef>

/// Stands before a function whose loops shall use AVX2 or AVX-512 where the processor has it; which
/// version runs is settled when the program is loaded. Compiled with -ffp-contract=off, results are
/// the same bits on every x86-64. Other processors have one version, and so have other compilers
/// than GCC: Clang does not hand lanes over between versions, even where functions are inlined.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MOCAP_VECTORIZED __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define MOCAP_VECTORIZED
#endif
