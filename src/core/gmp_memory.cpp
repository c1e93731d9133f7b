#include "core/gmp_memory.hpp"

#include <gmp.h>

#include <cstdlib>

namespace piblocks {
namespace {

// NOLINTBEGIN(cppcoreguidelines-*): GMP calls C functions without a context.

void (*end_process)() = std::abort;

void* checked(void* memory) {
  if (memory == nullptr) end_process();
  return memory;
}

void* allocate(std::size_t bytes) { return checked(std::malloc(bytes)); }
void* reallocate(void* memory, std::size_t /*old_bytes*/, std::size_t bytes) {
  return checked(std::realloc(memory, bytes));
}
void release(void* memory, std::size_t /*bytes*/) { std::free(memory); }

// NOLINTEND(cppcoreguidelines-*)

}  // namespace

void end_when_gmp_has_no_memory(void (*end)()) {
  end_process = end;
  ::mp_set_memory_functions(allocate, reallocate, release);
}

}  // namespace piblocks
