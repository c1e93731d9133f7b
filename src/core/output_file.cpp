#include "core/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace piblocks {
namespace fs = std::filesystem;
namespace {

std::string reason(int error_number) { return std::generic_category().message(error_number); }

[[noreturn]] void fail_open(const fs::path& path, const std::string& why) {
  throw UsageError(fmt::format("output: cannot open '{}': {}", path.string(), why));
}

[[noreturn]] void fail_io(const char* operation, const std::string& name, int error_number) {
  throw IoError(fmt::format("output: cannot {} '{}': {}", operation, name, reason(error_number)));
}

/// The permissions that a plain open() for writing would give.
mode_t default_permissions() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// Makes an empty file NAME.part-XXXXXX beside `final_path`.
fs::path make_beside(const fs::path& final_path) {
  static const mode_t permissions = default_permissions();
  std::string name = final_path.string() + ".part-XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) fail_open(final_path, reason(errno));
  ::fchmod(descriptor, permissions);
  ::close(descriptor);
  return name;
}

void sync_to_device(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_io("reopen", path, errno);
  const int failed = ::fsync(descriptor);
  const int error_number = errno;
  ::close(descriptor);
  if (failed != 0) fail_io("sync", path, error_number);
}

}  // namespace

MadeFolders::MadeFolders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code unknown;  // below a folder that may not be searched: making it will say so
  for (fs::path at = folder; !at.empty() && !fs::exists(at, unknown); at = at.parent_path()) {
    missing.push_back(at);
  }
  for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
    std::error_code error;
    fs::create_directory(*at, error);
    if (error) {
      throw UsageError(
          fmt::format("output: cannot make folder '{}': {}", at->string(), error.message()));
    }
    made_.push_back(*at);
  }
}

MadeFolders::~MadeFolders() {
  std::error_code ignored;  // a folder that others have used meanwhile stays
  for (auto at = made_.rbegin(); at != made_.rend(); ++at) fs::remove(*at, ignored);
}

TemporaryFile::TemporaryFile(fs::path final_path)
    : final_path_(std::move(final_path)), folders_(final_path_.parent_path()) {
  if (final_path_.empty()) throw UsageError("output: the name is empty");
  std::error_code error;
  const fs::file_status status = fs::status(final_path_, error);
  if (fs::is_directory(status)) fail_open(final_path_, reason(EISDIR));
  if (fs::exists(status) && !fs::is_regular_file(status)) fail_open(final_path_, "not a file");
  path_ = make_beside(final_path_);
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
}

void TemporaryFile::commit() {
  sync_to_device(path_);
  if (::rename(path_.c_str(), final_path_.c_str()) != 0) fail_io("write", final_path_, errno);
  path_.clear();
  folders_.keep();
}

OutputFile::OutputFile(const std::string& name) : name_(name) {
  if (name == "-") {
    name_ = "standard output";
    descriptor_ = STDOUT_FILENO;
    return;
  }
  temporary_ = std::make_unique<TemporaryFile>(name);
  descriptor_ = ::open(temporary_->path().c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail_open(name, reason(errno));
}

OutputFile::~OutputFile() {
  if (temporary_ && descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_io("write", name_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::write(std::string_view text) {
  write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void OutputFile::finish() {
  if (!temporary_) return;
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) fail_io("close", name_, errno);
  temporary_->commit();
}

}  // namespace piblocks
