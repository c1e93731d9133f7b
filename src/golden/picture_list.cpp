#include "golden/picture_list.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/stat.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>

#include "core/descriptor.hpp"
#include "core/text.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// More than anybody has; links can make a few folders seem to be billions.
constexpr std::size_t kMaxFolders = 100'000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Removes the number that `text` begins with, and returns it without its leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

/// By the numbers in names: frame2 comes before frame10.
bool comes_before(const std::string& one, const std::string& other) {
  std::string_view a = one;
  std::string_view b = other;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view m = take_number(a);
      const std::string_view n = take_number(b);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.size() != b.size() ? a.empty() : one < other;
}

std::string cannot_read(const fs::path& path, const std::string& why) {
  return fmt::format("compare: cannot read '{}': {}", path.string(), why);
}

/// Lists the pictures of a folder, and of the folders in it.
class FolderWalk {
 public:
  explicit FolderWalk(bool is_recursive) : is_recursive_(is_recursive) {}

  std::vector<ListedPicture> take() { return std::move(pictures_); }

  /// @param name  the folder's path in the outermost folder; empty for that one
  void enter(const fs::path& folder, const std::string& name) {
    struct stat status {};
    const Id id = ::stat(folder.c_str(), &status) == 0 ? Id(status.st_dev, status.st_ino) : Id();
    if (!around_.insert(id).second) {
      return add_problem(folder, name, "it leads back to a folder that it is in");
    }
    if (++folders_ > kMaxFolders) {
      throw UsageError(
          fmt::format("compare: there are more than {} folders; use --no-recursive", kMaxFolders));
    }
    std::error_code error;
    const std::string prefix = name.empty() ? "" : name + '/';
    for (const fs::path& path : entries_of(folder, error)) {
      list(path, prefix + path.filename().string());
    }
    if (error) add_problem(folder, name, error.message());
    around_.erase(id);
  }

 private:
  using Id = std::pair<dev_t, ino_t>;

  void list(const fs::path& path, const std::string& name) {
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if (type == fs::file_type::directory) {
      if (is_recursive_) enter(path, name);
    } else if (has_ending(name, ".png")) {
      pictures_.push_back({name, path});
    } else if (error && type != fs::file_type::not_found && is_recursive_) {
      add_problem(path, name, error.message());  // it may be a folder
    }
  }
  void add_problem(const fs::path& path, const std::string& name, const std::string& why) {
    pictures_.push_back({.name = name, .path = path, .problem = cannot_read(path, why)});
  }

  bool is_recursive_;
  std::vector<ListedPicture> pictures_;
  std::set<Id> around_;  // the folder that is being listed, and those around it
  std::size_t folders_ = 0;
};

PictureList list_folder(const std::string& name, bool is_recursive) {
  FolderWalk walk(is_recursive);
  walk.enter(name, "");
  PictureList list{.pictures = walk.take()};
  std::ranges::sort(list.pictures, comes_before, &ListedPicture::name);
  if (list.pictures.empty()) list.problem = fmt::format("there is no PNG file in '{}'", name);
  return list;
}

PictureList list_pattern(const std::string& name) {
  PictureList list{.pattern = FramePattern(name)};
  const std::string& given = list.pattern->folder();
  const fs::path folder = given.empty() ? "." : given;
  std::error_code error;
  for (const fs::path& path : entries_of(folder, error)) {
    const auto number = list.pattern->number_of(path.filename().native());
    if (number) list.pictures.push_back({path.filename(), given / path.filename(), number});
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    list.pictures.push_back(
        {.name = "", .path = folder, .problem = cannot_read(name, error.message())});
  }
  std::ranges::sort(list.pictures, {}, &ListedPicture::number);
  if (list.pictures.empty()) list.problem = fmt::format("there is no file of '{}'", name);
  return list;
}

/// The sort key of a picture, by which two lists are merged.
struct Place {
  std::optional<std::int64_t> number;
  std::string name;
  std::size_t index = 0;

  bool operator<(const Place& other) const {
    if (number && other.number) return *number < *other.number;
    if (number.has_value() != other.number.has_value()) return number.has_value();
    return comes_before(name, other.name);
  }
};

/// @param pattern  of the other list, if it has one and this list has none. A name with other
///                 leading zeros has its number too, unless another name has that number exactly.
std::vector<Place> places_of(const PictureList& list, const FramePattern* pattern) {
  std::vector<Place> places;
  std::set<std::int64_t> taken;
  for (const ListedPicture& picture : list.pictures) {
    places.push_back({picture.number, picture.name, places.size()});
    if (pattern == nullptr || !picture.problem.empty()) continue;
    places.back().number = pattern->number_of(picture.name);
    if (places.back().number) taken.insert(*places.back().number);
  }
  for (Place& place : places) {
    if (pattern == nullptr || place.number || !list.pictures[place.index].problem.empty()) continue;
    const auto number = pattern->number_in(place.name);
    if (number && taken.insert(*number).second) place.number = number;
  }
  std::ranges::sort(places, [](const Place& a, const Place& b) { return a < b; });
  return places;
}

/// The folders of a list that cannot be read.
std::vector<std::string> unreadable_folders(const PictureList& list) {
  std::vector<std::string> names;
  for (const ListedPicture& picture : list.pictures) {
    if (!picture.problem.empty()) names.push_back(picture.name);
  }
  return names;
}

bool may_hold(const std::vector<std::string>& folders, const ListedPicture& picture) {
  return std::ranges::any_of(folders, [&](const std::string& name) {
    return name.empty() || picture.name.starts_with(name + '/');
  });
}

}  // namespace

bool is_picture_pattern(const std::string& name) {
  std::error_code unknown;
  return has_ending(name, ".png") && name.find('%') != std::string::npos &&
         !fs::exists(fs::status(name, unknown));
}

PictureList list_pictures(const std::string& name, bool is_recursive) {
  if (is_picture_pattern(name)) return list_pattern(name);
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  if (fs::is_directory(status)) return list_folder(name, is_recursive);
  if (status.type() == fs::file_type::not_found) {
    return {.problem = fmt::format("there is no '{}'", name)};
  }
  return {.is_one_file = true, .pictures = {{fs::path(name).filename(), name}}};
}

std::vector<PicturePair> paired(const PictureList& reference, const PictureList& actual) {
  if (reference.is_one_file && actual.is_one_file) return {{0, 0}};
  const auto pattern_for = [](const PictureList& list, const PictureList& other) {
    return list.pattern || !other.pattern ? nullptr : &*other.pattern;
  };
  const auto expected = places_of(reference, pattern_for(reference, actual));
  const auto found = places_of(actual, pattern_for(actual, reference));
  const std::vector<std::string> unreadable_reference = unreadable_folders(reference);
  const std::vector<std::string> unreadable_actual = unreadable_folders(actual);
  std::vector<PicturePair> pairs;
  auto a = expected.begin();
  auto b = found.begin();
  while (a != expected.end() || b != found.end()) {
    const bool has_a = a != expected.end() && (b == found.end() || !(*b < *a));
    const bool has_b = b != found.end() && (a == expected.end() || !(*a < *b));
    const bool is_unknown = (!has_b && may_hold(unreadable_actual, reference.pictures[a->index])) ||
                            (!has_a && may_hold(unreadable_reference, actual.pictures[b->index]));
    PicturePair pair;
    if (has_a) pair.reference = (a++)->index;
    if (has_b) pair.actual = (b++)->index;
    if (!is_unknown) pairs.push_back(pair);
  }
  return pairs;
}

void claim_pictures(OverwriteCheck& check, const std::string& what, const std::string& name,
                    bool is_recursive) {
  std::error_code unknown;
  if (is_picture_pattern(name)) {
    check.reads_folder(what, FramePattern(name).folder(), names_of_pattern(name));
  } else if (!fs::is_directory(name, unknown)) {
    check.reads(what, name);
  } else if (!is_recursive) {
    check.reads_folder(what, name);
  } else {
    std::vector<fs::path> files;
    for (const ListedPicture& picture : list_folder(name, true).pictures) {
      files.push_back(picture.path);
    }
    check.reads_tree(what, name, files,
                     [](const std::string& file) { return has_ending(file, ".png"); });
  }
}

}  // namespace piblocks
