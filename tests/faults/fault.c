// Calls of the system that fail: a library for LD_PRELOAD.
// In: PIBLOCKS_FAULT="CALL N", such as "fsync 1" or "malloc 500". Out: the N-th CALL fails, with
// "no memory" for a malloc, "input/output error" for anything else. Counted from the program's
// first signal(), which is where main() begins.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

// Glibc's own, under names that nobody replaces.
extern void* __libc_malloc(size_t bytes);
extern void* __libc_calloc(size_t count, size_t bytes);
extern void* __libc_realloc(void* memory, size_t bytes);
extern void* __libc_memalign(size_t alignment, size_t bytes);

static char failing[16];
static atomic_long calls_left;  // 0 or less: no more failures

static void set_up(void) {
  const char* const fault = getenv("PIBLOCKS_FAULT");
  const char* const number = fault == NULL ? NULL : strchr(fault, ' ');
  if (failing[0] != '\0' || number == NULL) return;
  strncpy(failing, fault, (size_t)(number - fault));
  calls_left = atol(number);
}

static int fails(const char* call, int error) {
  if (strcmp(call, failing) != 0 || atomic_fetch_sub(&calls_left, 1) != 1) return 0;
  errno = error;
  return 1;
}

int flock(int file, int operation) {
  set_up();
  int (*const real)(int, int) = dlsym(RTLD_NEXT, "flock");
  return real(file, operation);
}

static int no_memory(void) { return fails("malloc", ENOMEM); }

void* malloc(size_t bytes) { return no_memory() ? NULL : __libc_malloc(bytes); }
void* calloc(size_t count, size_t bytes) {
  return no_memory() ? NULL : __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) { return no_memory() ? NULL : __libc_realloc(old, bytes); }
void* memalign(size_t alignment, size_t bytes) {
  return no_memory() ? NULL : __libc_memalign(alignment, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** memory, size_t alignment, size_t bytes) {
  void* const found = memalign(alignment, bytes);
  if (found == NULL) return ENOMEM;
  *memory = found;
  return 0;
}

// TYPE CALL(PARAMETERS), which passes on ARGUMENTS unless it fails.
#define REPLACE(TYPE, CALL, PARAMETERS, ARGUMENTS)          \
  TYPE CALL PARAMETERS {                                    \
    TYPE(*const real) PARAMETERS = dlsym(RTLD_NEXT, #CALL); \
    return fails(#CALL, EIO) ? -1 : real ARGUMENTS;         \
  }

REPLACE(int, fsync, (int file), (file))
REPLACE(int, syncfs, (int file), (file))
REPLACE(int, rename, (const char* from, const char* to), (from, to))
REPLACE(int, renameat, (int from_folder, const char* from, int to_folder, const char* to),
        (from_folder, from, to_folder, to))
REPLACE(int, mkdir, (const char* path, mode_t mode), (path, mode))
REPLACE(ssize_t, read, (int file, void* bytes, size_t count), (file, bytes, count))

ssize_t write(int file, const void* bytes, size_t count) {
  ssize_t (*const real)(int, const void*, size_t) = dlsym(RTLD_NEXT, "write");
  if (fails("stop", 0)) raise(SIGSTOP);
  return fails("write", EIO) ? -1 : real(file, bytes, count);
}
