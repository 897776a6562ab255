#include "core/cluster/build_identity.h"

#include <link.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

int addObject(dl_phdr_info* info, std::size_t, void* to) {
  if (info->dlpi_name && info->dlpi_name[0] == '/') static_cast<std::set<std::string>*>(to)->insert(info->dlpi_name);
  return 0;
}

/// A plugin by its folder and file: "fitness/kick.so".
std::string shortName(const fs::path& path) { return (path.parent_path().filename() / path.filename()).string(); }

std::string hashOfFile(const std::string& path) {
  // Asked for again with every experiment: what is loaded does not change.
  static std::map<std::string, std::string> known;
  const auto [entry, isNew] = known.try_emplace(path);
  if (isNew) entry->second = sha256(readFile(path));
  return entry->second;
}

std::string nameOf(const std::string& entry) { return entry.substr(0, entry.rfind(' ')); }

/// The program and what it has loaded by now, without plugins.
std::map<std::string, std::string> programAndLibraries(const PluginHost& host) {
  std::map<std::string, std::string> found;
  std::set<std::string> objects, plugins;
  for (const PluginInfo& plugin : host.plugins()) plugins.insert(fs::weakly_canonical(plugin.path).string());
  dl_iterate_phdr(addObject, &objects);
  for (const std::string& object : objects)
    if (!plugins.contains(fs::weakly_canonical(object).string()))
      found["library " + fs::path(object).filename().string()] = hashOfFile(object);
  found["program btr"] = hashOfFile("/proc/self/exe");
  return found;
}

}  // namespace

Parts buildIdentity(const PluginHost& host) {
  // Once: what is loaded later (MPI, say) is no part of it.
  static const std::map<std::string, std::string> program = programAndLibraries(host);
  std::map<std::string, std::string> found = program;
  for (const PluginInfo& plugin : host.plugins()) found["plugin " + shortName(plugin.path)] = hashOfFile(plugin.path);
#if defined(__x86_64__)
  found["processor's fused arithmetic"] = __builtin_cpu_supports("fma") ? "yes" : "no";
#endif
  Parts identity;
  for (const auto& [name, hash] : found) identity.push_back(name + ' ' + hash);
  return identity;
}

Parts buildIdentity(const PluginHost& host, const std::string& generator) {
  Parts identity = buildIdentity(host);
  identity.push_back("program conceal " + hashOfFile(generator));
  return identity;
}

std::optional<std::string> difference(const Parts& ours, const Parts& theirs) {
  const auto has = [](const Parts& all, const std::string& name) {
    return std::ranges::any_of(all, [&](const std::string& entry) { return nameOf(entry) == name; });
  };
  for (const std::string& entry : ours) {
    if (std::ranges::find(theirs, entry) != theirs.end()) continue;
    const std::string name = nameOf(entry);
    return has(theirs, name) ? "its " + name + " is another one" : "it has no " + name;
  }
  for (const std::string& entry : theirs)
    if (!has(ours, nameOf(entry))) return "it has a " + nameOf(entry) + " that is not here";
  return std::nullopt;
}

}  // namespace btr
