// What a scene has to look like, kept in a folder.
// In: a scene that has been read. Out: NAME.framehash, a hash of every frame, and NAME-INSTANT.png,
// some pictures. The "#software" line of the hashes tells what painted the frames.
#pragma once

#include <piblocks/compare.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace piblocks {

/// The references of one scene.
class References {
 public:
  /// @param name  the beginning of its files' names.
  /// @throws SceneError if the scene has problems; UsageError for a name such as "..".
  References(std::string name, const ScriptBuilder& scene, std::filesystem::path folder);

  const std::string& name() const noexcept { return name_; }
  const Script& script() const noexcept { return script_; }
  const std::filesystem::path& folder() const noexcept { return folder_; }
  std::filesystem::path path(const std::string& file) const { return folder_ / file; }
  /// The files of the references, without the folder; hashes first.
  std::vector<std::string> files() const;
  /// @throws IoError if the system does not say, as also below.
  bool exist() const;
  /// Whether this one of the files is there.
  bool has(const std::string& file) const;
  /// What painted the references; empty if they do not say.
  std::string fingerprint() const;

  /// Draws frames of the film, each as a PNG file.
  void draw(const std::vector<std::int64_t>& frames,
            const std::function<void(std::int64_t frame, std::vector<std::uint8_t> png)>& use,
            const std::stop_token& stop) const;
  /// Renders all of them into another folder, which is to be empty.
  /// @param on_progress  called as frames are drawn and hashed.
  void render_into(const std::filesystem::path& folder, int jobs, const OnProgress& on_progress,
                   const std::stop_token& stop) const;

 private:
  const Golden& golden() const;

  std::string name_;
  std::filesystem::path folder_;
  Script script_;
};

}  // namespace piblocks
