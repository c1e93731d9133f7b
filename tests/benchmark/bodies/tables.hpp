// The tables of the benchmark of bodies.
// In: nothing. Out: Markdown on standard output.
#pragma once

namespace piblocks::benchmark {

/// Three blocks between two walls, for 50, 500 and 5,000 collisions.
/// @throws SimulationError if the two programs that give the right answers disagree.
void print_line_table();

/// Ten discs in a box: until certainty ends, and for 2,000 collisions.
/// @throws SimulationError if the right answers in fewer and in more bits disagree.
void print_disc_table();

/// The article's blocks with restitution 0.999999, two to six digits.
/// @throws SimulationError as print_line_table().
void print_restitution_table();

}  // namespace piblocks::benchmark
