// Run time against error for the engines for bodies and for blocks that lose energy.
// In: nothing. Out: three tables. Build it with the preset release.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstdlib>

#include "bodies/tables.hpp"

int main() {
  try {
    piblocks::benchmark::print_line_table();
    piblocks::benchmark::print_disc_table();
    piblocks::benchmark::print_restitution_table();
  } catch (const piblocks::Error& error) {
    fmt::print(stderr, "bodies_benchmark: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
