// How many threads run at once.
// In: nothing; the texts in which Linux describes the control groups of a process. Out: a number of
// processors. processors_linux.cpp asks Linux, processors_posix.cpp the C++ library; the build
// takes one of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace piblocks {

/// The processors that this process may use: those it may run on, and as much of their time as its
/// control groups grant, rounded up; at least 1.
int processor_count();

/// The text of a file; nothing if it cannot be read.
using ReadText = std::function<std::optional<std::string>(const std::string& path)>;

/// The processors whose time the control groups grant, such as 1.5: the smallest limit of the
/// process's group and of the groups around it, as far as they are mounted. Reads both versions of
/// control groups.
/// @param groups  /proc/self/cgroup
/// @param mounts  /proc/self/mountinfo
/// @return nothing if there is no limit.
std::optional<double> granted_processors(std::string_view groups, std::string_view mounts,
                                         const ReadText& read);

}  // namespace piblocks
