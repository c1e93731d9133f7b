// What happens when GMP, and MPFR which asks it, find no memory.
// In: a function that ends the process. Out: a call of it, where GMP itself would abort().
//
// An exception will not do: "they must not return", says GMP's manual ("Custom Allocation"), and
// mpz_mul() for one frees the old number before it asks for room for the new.
#pragma once

namespace piblocks {

/// Call it before any other thread is started. `end` must neither return nor throw.
void end_when_gmp_has_no_memory(void (*end)());

}  // namespace piblocks
