// A sink whose output is the packets' bytes one after another.
// In: chunks in order. Out: one file, or standard output.
#pragma once

#include <string>

#include "core/output_file.hpp"
#include "media/output_request.hpp"

namespace piblocks {

class StreamSink final : public FrameSink {
 public:
  /// @throws UsageError if the file cannot be opened.
  explicit StreamSink(const std::string& name) : file_(name) {}

  void append(const EncodedChunk& chunk) override;
  void finish() override { file_.finish(); }

 private:
  FrameCounter counter_;
  OutputFile file_;
};

}  // namespace piblocks
