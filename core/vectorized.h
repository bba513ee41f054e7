// Loops over pixels, compiled for newer processors too.
#pragma once

#include <cstddef>

/// Marks a function whose loops should use AVX2 or AVX-512 if the processor has it. The version is
/// selected when the program is loaded. With -ffp-contract=off, results are bit-identical on every
/// x86-64. Other processors have one version, and so have compilers other than GCC: Clang does not
/// pass vectors between versions, even between inlined functions.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MOCAP_VECTORIZED __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define MOCAP_VECTORIZED
#endif
