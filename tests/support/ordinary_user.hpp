// The rights of an ordinary user, also where the tests run as root, whom no permission stops.
// In: nothing. Out: as long as it lives, the process may do what user "nobody" may.
#pragma once

#include <unistd.h>

#include <exception>
#include <stdexcept>

namespace piblocks::testing_support {

/// LeakSanitizer fails in a process that has given up rights.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kOrdinaryUsersCanRun = false;
#else
inline constexpr bool kOrdinaryUsersCanRun = true;
#endif

class OrdinaryUser {
 public:
  OrdinaryUser() {
    if (was_root_ && ::seteuid(kNobody) != 0) throw std::runtime_error("cannot drop root's rights");
  }
  ~OrdinaryUser() {
    if (was_root_ && ::seteuid(0) != 0) std::terminate();
  }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  const bool was_root_ = ::geteuid() == 0;
};

}  // namespace piblocks::testing_support
