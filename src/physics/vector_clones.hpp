// What compilers are told about loops over columns of numbers.
// In: marks on a function and before a loop. Out: vector instructions, where the compiler knows the
// marks; the same bits everywhere, since nothing is contracted.
#pragma once

// Compiles a function twice, for every x86-64 processor and for those with AVX2. The dynamic linker
// of the GNU C library picks one, before a sanitizer would be ready.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PIBLOCKS_VECTOR_CLONES [[gnu::target_clones("avx2", "default")]]
#else
#define PIBLOCKS_VECTOR_CLONES
#endif

// Iterations of the loop that follows do not read what others write.
#if defined(__GNUC__) && !defined(__clang__)
#define PIBLOCKS_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#else
#define PIBLOCKS_INDEPENDENT_ITERATIONS
#endif
