#include "core/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace piblocks {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail_open(const fs::path& path, const std::string& why) {
  throw UsageError(fmt::format("output: cannot open '{}': {}", path.string(), why));
}

/// A link to an open file may lead to one without a name: the text of the link is then none.
fs::path named_target(const fs::path& path) {
  fs::path target = follow_links(path);
  std::error_code error;
  if (fs::exists(path, error) && !fs::equivalent(path, target, error)) {
    fail_open(path, error_text(ENOENT));
  }
  return target;
}

}  // namespace

void fail_output(const char* operation, const std::string& name, const std::string& reason) {
  throw IoError(fmt::format("output: cannot {} '{}': {}", operation, name, reason));
}

void fail_output(const char* operation, const std::string& name, int error_number) {
  fail_output(operation, name, error_text(error_number));
}

MadeFolders::MadeFolders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code unknown;  // in a folder that may not be searched: making the folder reports it
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
  std::error_code ignored;  // a folder stays if others have put files there
  for (auto at = made_.rbegin(); at != made_.rend(); ++at) fs::remove(*at, ignored);
}

fs::path follow_links(const fs::path& path) {
  constexpr int kMaxLinks = 40;  // as Linux
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
  // The system protects users from links that others leave in a folder such as /tmp.
  const bool may_follow = fs::exists(path, error) || !error;
  if (!may_follow) fail_open(path, error.message());
  fs::path at = path;
  for (int links = 0; links < kMaxLinks; ++links) {
    const fs::path target = fs::read_symlink(at, error);
    if (error) return at;
    at = at.parent_path() / target;  // which is the target alone if that is absolute
  }
  fail_open(path, error_text(ELOOP));
}

std::string problem_of_replacing(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error == std::errc::filename_too_long) return error.message();
  if (!fs::exists(status)) return {};
  if (fs::is_directory(status)) return error_text(EISDIR);
  if (!fs::is_regular_file(status)) return "not a file";
  return ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0 ? "" : error_text(errno);
}

void take_permissions(int descriptor, const fs::path& replaced) {
  constexpr mode_t kPermissions = 0777;
  struct stat old {};
  if (::stat(replaced.c_str(), &old) != 0) return;
  // Only root may change the owner. Changing it clears some permissions, so these come second.
  [[maybe_unused]] const int ignored = ::fchown(descriptor, old.st_uid, old.st_gid);
  if (::fchmod(descriptor, old.st_mode & kPermissions) == 0) return;
  const int error = errno;
  struct stat now {};
  const bool has_them = ::fstat(descriptor, &now) == 0 &&
                        (now.st_mode & kPermissions) == (old.st_mode & kPermissions);
  if (!has_them) fail_output("keep the permissions of", replaced, error);
}

TemporaryFile::TemporaryFile(fs::path final_path) : final_path_(std::move(final_path)) {
  if (final_path_.empty()) throw UsageError("output: the name is empty");
  const fs::path name = final_path_.filename();
  if (name.empty() || name == "." || name == "..") fail_open(final_path_, error_text(EISDIR));
  const std::string problem = problem_of_replacing(final_path_);
  if (!problem.empty()) fail_open(final_path_, problem);
  final_path_ = named_target(final_path_);
  folders_.emplace(final_path_.parent_path());
  file_.emplace(final_path_, Unfinished::Kind::file);
  take_permissions(file_->descriptor(), final_path_);
}

void TemporaryFile::commit() {
  if (const int error = sync_file(file_->descriptor())) fail_output("sync", path(), error);
  if (::rename(path().c_str(), final_path_.c_str()) != 0)
    fail_output("rename to", final_path_, errno);
  file_->release();
  folders_->keep();
  sync_folder(final_path_.parent_path());
}

OutputFile::OutputFile(const std::string& name, Contents contents)
    : name_(name), contents_(contents) {
  if (name == "-") {
    name_ = "standard output";
    descriptor_ = Descriptor(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0));
  } else {
    temporary_ = std::make_unique<TemporaryFile>(name);
    descriptor_ = Descriptor(::open(temporary_->path().c_str(), O_WRONLY | O_CLOEXEC));
  }
  if (!descriptor_.is_open()) fail_open(name_, error_text(errno));
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  const int error = descriptor_.write(bytes);
  if (error == EPIPE && contents_ == Contents::text) throw ReaderGone("output: nobody reads it");
  if (error != 0) fail_output("write", name_, error);
}

void OutputFile::write(std::string_view text) {
  write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void OutputFile::write_at(std::uint64_t position, std::span<const std::uint8_t> bytes) {
  const int file = descriptor_.get();
  const off_t end = ::lseek(file, 0, SEEK_CUR);
  if (end < 0 || ::lseek(file, static_cast<off_t>(position), SEEK_SET) < 0) {
    fail_output("write", name_, errno);
  }
  write(bytes);
  if (::lseek(file, end, SEEK_SET) < 0) fail_output("write", name_, errno);
}

void OutputFile::finish() {
  if (const int error = descriptor_.close()) fail_output("close", name_, error);
  if (temporary_) temporary_->commit();
}

}  // namespace piblocks
