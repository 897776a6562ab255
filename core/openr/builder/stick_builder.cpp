#include "core/openr/builder/stick_builder.h"

#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include "core/openr/builder/kit_paths.h"
#include "core/openr/builder/makefiles.h"
#include "core/openr/builder/merged_config.h"
#include "core/openr/builder/shell.h"
#include "core/openr/builder/source_copy.h"
#include "core/openr/builder/source_folders.h"
#include "core/openr/builder/stub_generator.h"
#include "core/openr/file_text.h"
#include "core/openr/stick_config.h"
#include "core/spec/error.h"
#include "core/spec/system/scratch_folder.h"

namespace btr::openr {
namespace {

namespace fs = std::filesystem;

const std::string modulesFolder = "OPEN-R/MW/OBJS", configFolder = "OPEN-R/MW/CONF", dataFolder = "OPEN-R/MW/DATA/P";

std::set<std::string> modulesOn(const fs::path& stick) {
  std::set<std::string> modules;
  std::error_code error;
  for (fs::directory_iterator at(stick / modulesFolder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file(error) && at->file_size(error) > 0) modules.insert(at->path().filename().string());
  return modules;
}

bool isBelow(const fs::path& path, const fs::path& folder) {
  return path.string().rfind(folder.string() + "/", 0) == 0;
}

bool isSubsequence(const std::string& part, const std::string& whole) {
  std::size_t at = 0;
  for (const char c : whole)
    if (at < part.size() && part[at] == c) ++at;
  return at == part.size();
}

/// The name that OBJECT.CFG has for the object, else the first eight letters of its own.
std::string moduleName(const std::string& object, const std::vector<std::string>& listed) {
  std::string name;
  int count = 0;
  for (const std::string& path : listed) {
    const std::string stem = upper(fs::path(path).stem().string());
    if (!isSubsequence(stem, upper(object))) continue;
    name = upper(fs::path(path).filename().string());
    ++count;
  }
  return count == 1 ? name : upper(object).substr(0, 8) + ".BIN";
}

constexpr const char* longsRefused = ": a long has 64 bits here, 32 on the robot: with 32 it is refused (";

/// What openr-compile said of sources that it compiled with a `long` of 64 bits, a line each; "" where there are none.
std::string refusedLongs(const StickBuild& built) {
  std::string lines;
  for (const StickBuild::Object& object : built.objects)
    for (std::size_t at = 0; (at = object.said.find(longsRefused, at)) != std::string::npos; ++at) {
      const std::size_t before = object.said.rfind('\n', at), end = object.said.find('\n', at);
      const std::size_t begin = before == std::string::npos ? 0 : before + 1;
      lines += object.said.substr(begin, at - begin) + ": " +
               object.said.substr(at + std::strlen(longsRefused), end - at - std::strlen(longsRefused) - 1) + "\n";
    }
  return lines;
}

/// While it lives, openr-compile takes a `long` for 64 bits in all sources.
class WideLongs {
 public:
  WideLongs() { ::setenv(name, "1", 1); }
  ~WideLongs() { ::unsetenv(name); }
  WideLongs(const WideLongs&) = delete;
  WideLongs& operator=(const WideLongs&) = delete;

 private:
  static constexpr const char* name = "BTR_OPENR_WIDE";
};

class StickBuilder {
 public:
  explicit StickBuilder(const StickBuildOptions& options) : options_(options), out_(options.out) {
    sdk_ = options.sdk;
    if (sdk_.empty()) {
      std::error_code error;
      const fs::path self = fs::read_symlink("/proc/self/exe", error);
      sdk_ = self.parent_path().parent_path() / "share/uchilsim/openr-sdk";
    }
    if (!fs::exists(sdk_ / "OPEN_R/include/OPENR/OObject.h"))
      throw InputError(sdk_.string() + " has no OPEN-R headers; reinstall the program");
  }

  StickBuild build() {
    try {
      for (const fs::path& each : {out_ / modulesFolder, out_ / configFolder, out_ / dataFolder})
        fs::create_directories(each);
      std::size_t objects = 0;
      for (const std::string& folder : options_.folders) {
        buildFolder(folder);
        if (result_.objects.size() == objects)
          throw InputError(folder +
                           " has no OPEN-R object: a folder with a stub.cfg, an .ocf or a Makefile that calls mkbin "
                           "is one");
        objects = result_.objects.size();
      }
      listModules();
    } catch (const fs::filesystem_error& error) {
      throw InputError(error.path1().string() + ": " + error.code().message());
    }
    return std::move(result_);
  }

 private:
  void buildFolder(const std::string& folder) {
    if (!fs::is_directory(folder)) throw InputError(folder + " is no folder; a folder with OPEN-R sources is needed");
    if (isBelow(fs::weakly_canonical(out_), fs::canonical(folder)) &&
        fs::weakly_canonical(out_) != fs::canonical(folder) / "MS")
      throw InputError(options_.out + " lies in " + folder + "; a folder outside of the sources is needed");
    const ScratchFolder work("btr-openr");
    const fs::path copy = copyOfSources(folder, work.path(), work.path() / "sdk");
    fs::create_directory_symlink(fs::canonical(sdk_), work.path() / "sdk");
    const fs::path stick = work.path() / "MS";
    for (const fs::path& each : {stick / modulesFolder, stick / configFolder, stick / dataFolder})
      fs::create_directories(each);
    SourceFolders found = findSources(copy);
    if (found.sticks.empty() && fs::exists(fs::path(folder) / ".." / "MS" / "OPEN-R"))
      found.sticks.push_back(fs::canonical(fs::path(folder) / ".." / "MS"));
    for (const fs::path& each : found.sticks) {
      // Version control keeps no empty folder, and Makefiles write into it.
      if (isBelow(each, copy)) fs::create_directories(each / modulesFolder);
      copySettings(each, stick);
    }
    if (found.sticks.empty())
      for (const fs::path& each : found.lists) copyLists(each, stick / configFolder);
    const auto name = [&](const fs::path& path) {
      return (fs::path(folder) / path.lexically_relative(copy)).lexically_normal().string();
    };
    std::string said;  // of libraries: told where one of them is missing in the end
    for (const fs::path& each : found.libraries) make(each, stick, work.path() / "sdk", "", said);
    const std::size_t firstObject = result_.objects.size();
    for (const fs::path& each : found.withMakefile) byMakefile(each, name(each), copy, stick, work.path() / "sdk");
    for (const fs::path& each : found.byHand) byHand(each, name(each), stick, work.path() / "sdk");
    byWholeMakefile(copy, stick, work.path() / "sdk", firstObject);
    tellOfLibraries(said, firstObject);
    if (!fs::exists(stick / configFolder / "OBJECT.CFG")) {
      std::string list;
      for (const std::string& module : modulesOn(stick)) list += "/MS/" + modulesFolder + "/" + module + "\n";
      if (!list.empty()) writeContent(stick / configFolder / "OBJECT.CFG", list);
    }
    copySettings(stick, out_);
    for (const std::string& module : modulesOn(stick))
      fs::copy_file(stick / modulesFolder / module, out_ / modulesFolder / upper(module),
                    fs::copy_options::overwrite_existing);
  }

  /// What the compiler refused of a library is the reason why an object is not built.
  void tellOfLibraries(const std::string& said, std::size_t firstObject) {
    if (said.find("error: ") == std::string::npos) return;
    for (std::size_t i = firstObject; i < result_.objects.size(); ++i) {
      StickBuild::Object& object = result_.objects[i];
      if (!object.modules.empty()) continue;
      object.said = said + object.said;
      return;
    }
  }

  /// All but modules: configuration is added to, other files are replaced.
  void copySettings(const fs::path& from, const fs::path& to) {
    for (const auto& entry : fs::recursive_directory_iterator(from)) {
      if (!entry.is_regular_file()) continue;
      const fs::path relative = entry.path().lexically_relative(from);
      const std::string name = upper(relative.filename().string());
      fs::path target = to;
      for (const fs::path& part : relative) target = entryNamed(target, part.string());
      const std::string place = upper(relative.parent_path().generic_string());
      if (name.ends_with(".BIN") && place == modulesFolder) continue;
      fs::create_directories(target.parent_path());
      if (name.ends_with(".CFG") && place == configFolder && fs::exists(target) &&
          (name == "OBJECT.CFG" || name == "CONNECT.CFG" || name == "DESIGNDB.CFG"))
        writeContent(target, mergedConfig(content(target), content(entry.path())));
      else
        fs::copy_file(entry.path(), target, fs::copy_options::overwrite_existing);
    }
  }

  /// Teams keep the lists of a stick where they like, as in a folder "cfg".
  static void copyLists(const fs::path& from, const fs::path& to) {
    for (const char* name : {"OBJECT.CFG", "CONNECT.CFG", "DESIGNDB.CFG"}) {
      const fs::path list = entryNamed(from, name);
      if (!fs::is_regular_file(list)) continue;
      const fs::path target = to / name;
      writeContent(target, fs::exists(target) ? mergedConfig(content(target), content(list)) : content(list));
    }
  }

  static void make(const fs::path& folder, const fs::path& stick, const fs::path& sdk, const std::string& target,
                   std::string& said) {
    const std::string kit = shellWord(sdk.string());
    std::string places = " OPENRSDK_ROOT=" + kit + " INSTALLDIR=" + shellWord(stick.string());
    std::map<std::string, std::string> values;
    withIncludes(folder, entryNamed(folder, "Makefile"), values);
    for (const auto& [name, value] : values)
      if (isKitFolder(value) && isName(name)) places += " " + name + "=" + kit;
    runInShell(folder,
               "env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL LC_ALL=C make --no-print-directory -B" + places + " " + target,
               said);
  }

  static bool isName(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    });
  }

  /// What single folders did not give, as the sample's own Makefile makes it all.
  void byWholeMakefile(const fs::path& copy, const fs::path& stick, const fs::path& sdk, std::size_t firstObject) {
    std::vector<StickBuild::Object*> missing;
    for (std::size_t i = firstObject; i < result_.objects.size(); ++i)
      if (result_.objects[i].modules.empty()) missing.push_back(&result_.objects[i]);
    if (missing.empty() || !fs::exists(copy / "Makefile")) return;
    // It would go on to neighbours: those are the originals.
    for (const fs::path& neighbours : {copy.parent_path(), copy.parent_path().parent_path()})
      for (const auto& entry : fs::directory_iterator(neighbours))
        if (entry.is_symlink()) fs::remove(entry.path());
    const auto before = modulesOn(stick);
    std::string said;
    make(copy, stick, sdk, "install", said);
    std::size_t next = 0;
    for (const std::string& module : modulesOn(stick))
      if (before.count(module) == 0 && next < missing.size()) missing[next++]->modules.push_back(module);
  }

  void byMakefile(const fs::path& folder, const std::string& name, const fs::path& copy, const fs::path& stick,
                  const fs::path& sdk) {
    if (options_.progress) options_.progress(name);
    StickBuild::Object object{name, {}, {}};
    const auto before = modulesOn(stick);
    const auto older = madeIn(copy);
    make(folder, stick, sdk, "install", object.said);
    for (const std::string& module : modulesOn(stick))
      if (before.count(module) == 0) object.modules.push_back(module);
    if (object.modules.empty() && hasAny(object.said, {"No rule to make target 'install'"})) {
      object.said.clear();
      make(folder, stick, sdk, "", object.said);
    }
    // Whoever wrote the Makefile copied modules by hand, or to a memory stick that is not here.
    if (object.modules.empty()) takeMade(copy, older, stick, object);
    // A Makefile that builds the JPEG library from its sources first: this computer has one.
    if (object.modules.empty() && usesJpeg(folder)) return byHand(folder, name, stick, sdk);
    result_.objects.push_back(std::move(object));
  }

  /// Modules in a folder and those below, and when they were made.
  static std::map<fs::path, fs::file_time_type> madeIn(const fs::path& folder) {
    std::map<fs::path, fs::file_time_type> made;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && upper(entry.path().extension().string()) == ".BIN")
        made[entry.path()] = entry.last_write_time();
    return made;
  }

  /// What was made since `older`, wherever the Makefile puts it: on a stick, else where it was linked.
  static void takeMade(const fs::path& folder, const std::map<fs::path, fs::file_time_type>& older,
                       const fs::path& stick, StickBuild::Object& object) {
    std::vector<fs::path> made, installed;
    for (const auto& [path, time] : madeIn(folder))
      if (const auto at = older.find(path); at == older.end() || at->second != time) {
        made.push_back(path);
        if (upper(path.parent_path().generic_string()).ends_with(modulesFolder)) installed.push_back(path);
      }
    if (!installed.empty()) made = installed;
    if (!made.empty()) object.said.clear();
    for (const fs::path& each : made) {
      const std::string module = moduleName(each.stem().string(), listedModules(stick));
      if (runInShell(folder,
                     "gzip -dcf " + shellWord(each.string()) + " | gzip -nc > " +
                         shellWord((stick / modulesFolder / module).string()),
                     object.said) == 0)
        object.modules.push_back(module);
    }
  }

  /// Of the stick's OBJECT.CFG.
  static std::vector<std::string> listedModules(const fs::path& stick) {
    std::vector<std::string> listed;
    for (const auto& line : configLines(content(stick / configFolder / "OBJECT.CFG"), "")) listed.push_back(line[0]);
    return listed;
  }

  /// Folders below an object's that are no object, library or stick of their own, relative to it.
  static std::vector<fs::path> partsOf(const fs::path& folder) {
    std::vector<fs::path> parts;
    for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
      if (!at->is_directory()) continue;
      const std::string name = at->path().filename().string();
      const bool other = name[0] == '.' || name == "MS" || looksLikeObject(at->path()) ||
                         fs::exists(at->path() / "Makefile") || fs::exists(at->path() / "OPEN-R");
      if (other)
        at.disable_recursion_pending();
      else
        parts.push_back(at->path().lexically_relative(folder));
    }
    std::sort(parts.begin(), parts.end());
    return parts;
  }

  /// Adds the compiled ones to `objects`; false if one does not compile.
  static bool compile(const fs::path& folder, std::vector<fs::path> sources, const std::string& includes,
                      const fs::path& sdk, std::string& objects, std::string& said) {
    std::sort(sources.begin(), sources.end());
    bool whole = true;
    for (const fs::path& source : sources) {
      const std::string made = (source.parent_path() / source.stem()).string() + ".o";
      const std::string compiler = source.extension() == ".c" ? "mipsel-linux-gcc" : "mipsel-linux-g++";
      const bool compiled = runInShell(folder,
                                       shellWord((sdk / "bin" / compiler).string()) + " -O2 -g" + includes + " -c " +
                                           shellWord(source.string()) + " -o " + shellWord(made),
                                       said) == 0;
      if (compiled) objects += " " + shellWord(made);
      whole = whole && compiled;
    }
    return whole;
  }

  /// Sources in folders below an object's become a library: of them it has what it needs.
  static std::string libraryOf(const fs::path& folder, const std::vector<fs::path>& parts, const std::string& includes,
                               const fs::path& sdk, std::string& said) {
    std::vector<fs::path> sources;
    for (const fs::path& part : parts)
      for (const auto& entry : fs::directory_iterator(folder / part))
        if (isSource(entry.path())) sources.push_back(part / entry.path().filename());
    std::string objects;
    compile(folder, sources, includes, sdk, objects, said);
    if (objects.empty()) return "";
    const std::string library = "parts.a";
    runInShell(folder, shellWord((sdk / "bin/mipsel-linux-ar").string()) + " rcP " + library + objects, said);
    return " " + library;
  }

  void byHand(const fs::path& folder, const std::string& name, const fs::path& stick, const fs::path& sdk) {
    if (options_.progress) options_.progress(name);
    StickBuild::Object object{name, {}, {}};
    std::string title = folder.filename().string();
    if (fs::exists(folder / "stub.cfg")) {
      const StubConfig config = stubConfigFrom(content(folder / "stub.cfg"), name + "/stub.cfg");
      title = config.object;
      for (const auto& [file, text] : stubFiles(config)) writeContent(folder / file, text);
    }
    std::string ocf;
    std::vector<fs::path> sources;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (isSource(entry.path())) sources.push_back(entry.path().filename());
      if (entry.path().extension() == ".ocf") ocf = entry.path().filename().string();
    }
    const std::vector<fs::path> parts = partsOf(folder);
    std::string includes = " -I.";
    for (const char* other : {"include", "../include", "../common", "../common/include"})
      if (fs::exists(folder / other)) includes += std::string(" -I") + other;
    for (const fs::path& part : parts) includes += " -I" + shellWord(part.string());
    std::string objects;
    const bool whole = compile(folder, sources, includes, sdk, objects, object.said) && !sources.empty();
    std::string partsSaid;  // of parts that nobody asks for it does not matter
    objects += libraryOf(folder, parts, includes, sdk, partsSaid);
    const std::string module = moduleName(title, listedModules(stick));
    const bool linked =
        whole && runInShell(folder,
                            shellWord((sdk / "OPEN_R/bin/mkbin").string()) + " -o object.bin" + objects +
                                (ocf.empty() ? "" : " " + shellWord(ocf)) + (usesJpeg(folder) ? " -ljpeg" : "") +
                                " && gzip -nc object.bin > " + shellWord((stick / modulesFolder / module).string()),
                            object.said) == 0;
    if (linked)
      object.modules.push_back(module);
    else
      object.said = partsSaid + object.said;
    result_.objects.push_back(std::move(object));
  }

  /// OBJECT.CFG names what the stick has not.
  void listModules() {
    const auto there = modulesOn(out_);
    for (const auto& line : configLines(content(out_ / configFolder / "OBJECT.CFG"), "")) {
      const std::string module = upper(fs::path(line[0]).filename().string());
      if (there.count(module) == 0) result_.absent.push_back(module);
    }
  }

  const StickBuildOptions& options_;
  fs::path out_, sdk_;
  StickBuild result_;
};

}  // namespace

bool StickBuild::complete() const {
  return std::all_of(objects.begin(), objects.end(), [](const Object& object) { return !object.modules.empty(); });
}

StickBuild buildStick(const StickBuildOptions& options) {
  StickBuild built = StickBuilder(options).build();
  const std::string refused = refusedLongs(built);
  if (refused.empty()) return built;
  // Sources that take a long for 32 bits and for 64 would read each other's structures and messages otherwise.
  StickBuild wide;
  {
    const WideLongs everywhere;
    wide = StickBuilder(options).build();
  }
  const bool isComplete = wide.complete() || !built.complete();
  StickBuild& given = isComplete ? wide : built;
  std::string& said = given.objects.front().said;
  said =
      refused +
      (isComplete ? "a long has 64 bits here in all sources of this stick (32 on the robot): with 32 the compiler "
                    "refuses the above\n"
                  : "not built: with a long of 32 bits, as on the robot, the compiler refuses the above, and with 64 "
                    "it refuses others\n") +
      said;
  if (!isComplete)
    for (StickBuild::Object& object : given.objects) object.modules.clear();
  return given;
}

}  // namespace btr::openr
