// Functions of a library that is loaded when one of them is first called.
// In: a function that looks others up by their names. Out: objects that are called like those.
#pragma once

#include <dlfcn.h>

#include <atomic>

namespace piblocks {

/// Loads a library and looks a function up in it and in the libraries it needs. Returns nullptr if
/// either fails; dlerror() says why. The library is never unloaded.
inline void* find_in_library(const char* file, const char* name) {
  void* const library = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  return library == nullptr ? nullptr : ::dlsym(library, name);
}

template <auto find, typename Function>
class FoundFunction;

/// Looked up by `find`, which gets its name, when it is first called. Thread-safe if `find` is.
template <auto find, typename Result, typename... Arguments>
class FoundFunction<find, Result(Arguments...)> {
 public:
  explicit constexpr FoundFunction(const char* name) : name_(name) {}

  Result operator()(Arguments... arguments) const {
    auto function = function_.load(std::memory_order_acquire);
    if (function == nullptr) {
      function = reinterpret_cast<Result (*)(Arguments...)>(find(name_));
      function_.store(function, std::memory_order_release);
    }
    return function(arguments...);
  }

 private:
  const char* name_;
  mutable std::atomic<Result (*)(Arguments...)> function_ = nullptr;
};

}  // namespace piblocks
