#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace btr::remote {

/// JSON that is nested beyond all reason would end the process that reads it. Throws InputError.
void requireShallow(const std::string& text, const std::string& place);

/// The one folder whose files clients may name. What a client names is judged before anything is opened: a relative
/// path without "..", whose real place (links followed) lies in the folder.
class GamesFolder {
 public:
  /// Where logs go.
  static constexpr const char* sessions = "sessions";

  /// Throws InputError if it is no folder. In one that is writable the folder of logs is made.
  explicit GamesFolder(const std::string& folder, bool writable);

  const std::string& path() const { return root_; }
  bool writable() const { return writable_; }

  /// The full path of a file that is there, with one of these endings (".json"). `place` begins the message. Throws
  /// InputError; what is outside and what is not there sound the same.
  std::string file(const std::string& given, std::initializer_list<const char*> endings,
                   const std::string& place) const;
  /// The full path of a folder that is there; "" is the folder itself.
  std::string folder(const std::string& given, const std::string& place) const;
  /// The full path of a *.json file to be written, new or there; its folder may have to be
  /// made. Throws InputError.
  std::string toWrite(const std::string& given, const std::string& place) const;
  /// Throws InputError unless what `named`, relative to `directory` (a full path), leads to lies in the folder. For
  /// paths that stand in a client's text; there ".." is allowed where it stays inside.
  void requireInside(const std::string& named, const std::string& directory, const std::string& place) const;
  /// A full path as a client would name it.
  std::string shown(const std::string& full) const;

  /// Judges all paths in a game's or a scene's text: "model" of its robots, "scene", "field".
  void judgeGame(const nlohmann::json& game, const std::string& directory, const std::string& place) const;

 private:
  bool isInside(const std::string& full) const;

  std::string root_;
  bool writable_;
};

}  // namespace btr::remote
