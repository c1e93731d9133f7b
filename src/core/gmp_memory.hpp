// What happens when GMP, or MPFR which uses it, finds no memory.
// In: a function that ends the process. Out: it is called where GMP itself would abort().
//
// GMP forbids an exception (its manual, "Custom Allocation"): mpz_mul(), for one, frees the old
// number before it allocates the new one.
#pragma once

namespace piblocks {

/// Call it before any other thread is started. `end` must neither return nor throw.
void end_when_gmp_has_no_memory(void (*end)());

}  // namespace piblocks
