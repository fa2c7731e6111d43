// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

// For kernels that are written for the compiler's vectoriser: no calls, no branches, one stream per
// column. A function marked ALS_VECTOR_CLONES is compiled twice, for AVX2 and for every x86-64, and
// chosen when the program starts: the same operations on more lanes, so the same results. What it
// calls is ALS_INLINE. Sanitizers run before that choice is possible.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ALS_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#define ALS_INLINE __attribute__((always_inline)) inline
#else
#define ALS_VECTOR_CLONES
#define ALS_INLINE inline
#endif
