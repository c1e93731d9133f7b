// The rights of an ordinary user, also where the tests run as root, whom no permission stops.
// In: nothing. Out: as long as it lives, the process may do what user "nobody" may.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace piblocks::testing_support {

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

/// Why an ordinary user cannot run what is built here; empty if one can. The tests stand beside the
/// program.
inline std::string ordinary_user_problem() {
#ifdef __SANITIZE_ADDRESS__
  return "LeakSanitizer fails in a process that has given up rights";
#else
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const OrdinaryUser user;
  if (::faccessat(AT_FDCWD, self.c_str(), X_OK, AT_EACCESS) == 0) return {};
  return "no ordinary user may enter the folder of " + self.string();
#endif
}

}  // namespace piblocks::testing_support
