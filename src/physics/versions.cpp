#include "physics/versions.hpp"

#include <fmt/format.h>
#include <gmp.h>
#include <mpfr.h>

#include <Eigen/Core>

namespace piblocks {

std::vector<std::string> physics_library_versions() {
  return {
      fmt::format("Eigen {}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION),
      fmt::format("GMP {}", gmp_version), fmt::format("MPFR {}", mpfr_get_version())};
}

}  // namespace piblocks
