/* A module as an older piblocks may have left it behind: its version, and nothing to call. */
const void* piblocks_av_module(void) {
  static const char* const module[] = {"0.0.1"};
  return module;
}
