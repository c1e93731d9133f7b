// Loops that are compiled twice, for every x86-64 processor and for those with AVX2.
// The dynamic linker picks. Both give the same bits: the project is compiled without contraction
// of multiplications and additions, and everything else in such a loop is correctly rounded.
#pragma once

// The linker picks before a sanitizer is ready.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PIBLOCKS_VECTOR_CLONES [[gnu::target_clones("avx2", "default")]]
#else
#define PIBLOCKS_VECTOR_CLONES
#endif

// Says of the loop that follows that its iterations do not read what others write.
#if defined(__GNUC__) && !defined(__clang__)
#define PIBLOCKS_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#else
#define PIBLOCKS_INDEPENDENT_ITERATIONS
#endif
