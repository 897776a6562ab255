#include "core/remote/games_folder.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"

namespace btr::remote {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longestPath = 1000;
constexpr const char* allowed = "a file below the server's folder";

std::string quoted(const std::string& text) {
  std::string shown = text.substr(0, 100);
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return '"' + shown + (text.size() > 100 ? "…" : "") + '"';
}

/// Nothing that the system or a terminal would read otherwise than a person.
bool isPlain(const std::string& text) {
  return !text.empty() && text.size() <= longestPath &&
         std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127 || c == '\\'; });
}

bool isPlainRelative(const std::string& text) {
  const fs::path path(text);
  return isPlain(text) && path.is_relative() && std::ranges::find(path, fs::path("..")) == path.end();
}

}  // namespace

void requireShallow(const std::string& text, const std::string& place) {
  constexpr int deepest = 64;
  int depth = 0;
  bool inText = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inText && c == '\\') ++i;
    if (c == '"') inText = !inText;
    if (inText) continue;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > deepest)
      throw InputError(place, "JSON in more than " + std::to_string(deepest) + " levels", "as many as a game has");
  }
}

GamesFolder::GamesFolder(const std::string& folder, bool writable) : writable_(writable) {
  std::error_code error;
  root_ = fs::canonical(folder, error).string();
  if (error || !fs::is_directory(root_)) throw InputError("--games", folder, "a folder that is there");
  if (!writable) return;
  fs::create_directories(fs::path(root_) / sessions, error);
  if (error) throw InputError("--games", folder + " (" + error.message() + ")", "a folder that can be written");
}

bool GamesFolder::isInside(const std::string& full) const {
  const fs::path relative = fs::path(full).lexically_relative(root_);
  return !relative.empty() && *relative.begin() != "..";
}

std::string GamesFolder::shown(const std::string& full) const {
  return fs::path(full).lexically_relative(root_).string();
}

std::string GamesFolder::file(const std::string& given, std::initializer_list<const char*> endings,
                              const std::string& place) const {
  if (!isPlainRelative(given)) throw InputError(place, quoted(given), allowed);
  const fs::path path = fs::path(root_) / given;
  const bool rightEnding = std::ranges::any_of(endings, [&](const char* ending) { return path.extension() == ending; });
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  if (!rightEnding || error || !isInside(real.string()) || !fs::is_regular_file(real, error))
    throw InputError(place, quoted(given), allowed);
  return path.string();
}

std::string GamesFolder::folder(const std::string& given, const std::string& place) const {
  if (given.empty()) return root_;
  std::error_code error;
  if (isPlainRelative(given)) {
    const fs::path real = fs::canonical(fs::path(root_) / given, error);
    if (!error && (real == root_ || isInside(real.string())) && fs::is_directory(real, error)) return real.string();
  }
  throw InputError(place, quoted(given), "a folder below the server's folder");
}

std::string GamesFolder::toWrite(const std::string& given, const std::string& place) const {
  if (!writable_) throw InputError(place, quoted(given), "nothing: this server was not given a folder to write to");
  const fs::path path = fs::path(root_) / given;
  if (!isPlainRelative(given) || path.extension() != ".json" || !path.has_stem())
    throw InputError(place, quoted(given), "a file *.json below the server's folder");
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  // A link that leads out, also one whose target is not there yet.
  if (error || !isInside(real.string()) || fs::is_symlink(path, error))
    throw InputError(place, quoted(given), "a file *.json below the server's folder");
  if (fs::exists(real, error) && !fs::is_regular_file(real, error))
    throw InputError(place, quoted(given), "a file *.json below the server's folder");
  return real.string();
}

void GamesFolder::requireInside(const std::string& named, const std::string& directory,
                                const std::string& place) const {
  std::error_code error;
  if (isPlain(named) && fs::path(named).is_relative()) {
    const fs::path real = fs::canonical(fs::path(directory) / named, error);
    if (!error && isInside(real.string()) && fs::is_regular_file(real, error)) return;
  }
  throw InputError(place, quoted(named), allowed);
}

void GamesFolder::judgeGame(const nlohmann::json& game, const std::string& directory, const std::string& place) const {
  if (!game.is_object()) return;
  for (const char* key : {"scene", "field"})
    if (const auto found = game.find(key); found != game.end() && found->is_string())
      requireInside(found->get<std::string>(), directory, place + " /" + key);
  if (const auto robots = game.find("robots"); robots != game.end() && robots->is_array())
    for (const auto& robot : *robots)
      if (robot.is_object())
        if (const auto model = robot.find("model"); model != robot.end() && model->is_string())
          requireInside(model->get<std::string>(), directory, place + " /robots/model");
  if (const auto scene = game.find("scene"); scene != game.end() && scene->is_object())
    judgeGame(*scene, directory, place + " /scene");
}

}  // namespace btr::remote
