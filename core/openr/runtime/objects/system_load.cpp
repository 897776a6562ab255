// Modules become objects.
#include <OPENR/OPENRMessages.h>
#include <ObjectEntryTable.h>
#include <btr_openr_version.h>
#include <dlfcn.h>
#include <elf.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/process/console.h"
#include "core/openr/runtime/process/faults.h"
#include "core/openr/runtime/robot/gunzip.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

/// A handle on a copy of the module that no other robot or object shares; nullptr with `error` set.
void* openCopy(const std::vector<char>& bytes, std::string& error) {
  const int file = memfd_create("openr-module", MFD_CLOEXEC);
  if (file < 0 || ::write(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    error = "there is no memory for it";
    if (file >= 0) close(file);
    return nullptr;
  }
  const std::string copy = "/proc/self/fd/" + std::to_string(file);
  void* handle = dlopen(copy.c_str(), RTLD_NOW | RTLD_LOCAL);
  // It stays open: the loader would take another file of this number for the same module.
  if (handle != nullptr) return handle;
  error = dlerror();
  // Whoever reads it knows the module, not the copy.
  const std::string prefix = copy + ": ";
  for (auto at = error.find(prefix); at != std::string::npos; at = error.find(prefix)) error.erase(at, prefix.size());
  return nullptr;
}

/// Whether all that was compiled into the module had the headers that this run-time has. Looked at before any of its
/// code runs. What is no module of this computer is judged by the loader.
bool hasOurHeaders(const std::vector<char>& bytes) {
  constexpr std::size_t machineAt = 18;
  constexpr char elf[] = "\177ELF";
  if (bytes.size() <= machineAt || !std::equal(elf, elf + 4, bytes.begin()) || bytes[machineAt] != EM_X86_64)
    return true;
  constexpr std::string_view mark = BTR_OPENR_MARK, ours(BTR_OPENR_VERSION, sizeof BTR_OPENR_VERSION);
  bool found = false;
  for (auto at = bytes.begin(); (at = std::search(at, bytes.end(), mark.begin(), mark.end())) != bytes.end(); ++at) {
    const auto version = at + static_cast<std::ptrdiff_t>(mark.size());
    if (version == bytes.end() || std::isdigit(static_cast<unsigned char>(*version)) == 0) continue;  // no version
    found = true;
    // With the 0 at its end: 12 is not 1.
    const std::string_view rest(&*version, static_cast<std::size_t>(bytes.end() - version));
    if (!rest.starts_with(ours)) return false;
  }
  return found;
}

std::string nameOf(void* handle, const std::string& path) {
  if (const auto* name = static_cast<const char*>(dlsym(handle, "btr_openr_object"))) return name;
  if (const auto* ocf = static_cast<const char*>(dlsym(handle, "btr_openr_ocf"))) {
    std::istringstream words(ocf);
    std::string first, name;
    if (words >> first >> name) return name;
  }
  const auto slash = path.rfind('/');
  return path.substr(slash == std::string::npos ? 0 : slash + 1);
}

/// The high 4 bits of the priority in an .ocf; objects of a lower class wait for those of a higher.
unsigned priorityClassOf(void* handle) {
  const auto* ocf = static_cast<const char*>(dlsym(handle, "btr_openr_ocf"));
  if (ocf == nullptr) return 8;
  std::istringstream words(ocf);
  std::string first, name;
  unsigned stack = 0, heap = 0, priority = 128;
  words >> first >> name >> stack >> heap >> priority;
  return words ? (priority >> 4) & 15 : 8;
}

}  // namespace

void System::load() {
  config = stickConfig(stick, design.name);
  for (const std::string& path : config.objects) {
    if (ended_) return;
    loadObject(path);
  }
  const bool none = std::all_of(objects_.begin(), objects_.end(),
                                [](const auto& object) { return object->native || object->entries.empty(); });
  if (none && !ended_)
    end(Ended::Why::refused, "", "",
        leftOut_.empty() ? "OBJECT.CFG lists no object for the " + design.name
                         : "no object could be started: " + leftOut_);
}

void System::leaveOut(const std::string& why) {
  leftOut_ += (leftOut_.empty() ? "" : "; ") + why;
  say("", why + ": started without it");
}

void System::loadObject(const std::string& path) {
  const std::string file = onStick(stick, path);
  std::vector<char> bytes;
  std::error_code missing;
  if (file.empty() || !std::filesystem::exists(file, missing)) return leaveOut(path + " is not on the stick");
  if (!unpackedFile(file, bytes)) return leaveOut(path + " cannot be unpacked: the file is damaged");
  auto added = std::make_unique<RunningObject>();
  RunningObject& object = *added;
  object.index = static_cast<int>(objects_.size());
  object.oid = oidOf(object.index);
  object.name = path.substr(path.rfind('/') + 1);
  objects_.push_back(std::move(added));
  addStack(object);
  if (!hasOurHeaders(bytes)) {
    end(Ended::Why::refused, "", "",
        path + " was built by another version of this program; build the stick again with btr openr build");
    return;
  }

  FaultState& fault = faultState();
  fault.object = &object;
  fault.selector = UNDEF;
  setMethod(fault, object.methodName(UNDEF));
  void* handle = nullptr;
  std::string error;
  if (sigsetjmp(fault.home, 1) == 0) {
    current_ = &object;
    enter(object);
    ++fault.serial;
    fault.inMethod = true;
    handle = openCopy(bytes, error);
    fault.inMethod = false;
    leave();
  } else {
    fault.inMethod = false;
    leave();
    end(Ended::Why::crash, object.name, object.methodName(UNDEF), fault.what);
    return;
  }
  const auto* table = handle == nullptr ? nullptr : static_cast<const ObjectEntry*>(dlsym(handle, "ObjectEntryTable"));
  if (table == nullptr) {
    leaveOut(path + " is no module that `btr openr build` has made for this computer (" +
             (error.empty() ? "it has no ObjectEntryTable" : error) + ")");
    object.entries.clear();
    object.name.clear();
    return;
  }
  const std::string fileName = object.name;
  object.name = nameOf(handle, path);
  for (ConsoleLine& line : orders_.lines)  // of its constructors
    if (line.object == fileName) line.object = object.name;
  object.priorityClass = priorityClassOf(handle);
  for (; table->selector != UNDEF; ++table)
    object.entries[table->selector] = reinterpret_cast<void (*)(void*)>(table->entry);
  if (const auto* methods = static_cast<const char* const*>(dlsym(handle, "btr_openr_methods")))
    for (; *methods != nullptr; ++methods) object.methods.emplace_back(*methods);
}

void System::addStack(RunningObject& object) {
  const std::size_t guard = 65536;
  const int kind = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  // Below 2 GiB, where there is room: addresses of local variables, too, are kept in an int.
  void* place = mmap(nullptr, stackBytes + guard, PROT_NONE, kind | MAP_32BIT, -1, 0);
  if (place == MAP_FAILED) place = mmap(nullptr, stackBytes + guard, PROT_NONE, kind, -1, 0);
  auto* memory = static_cast<char*>(place);
  if (memory == MAP_FAILED) throw InputError("there is no memory for the stack of another object");
  object.stack = memory + guard;
  mprotect(object.stack, stackBytes, PROT_READ | PROT_WRITE);
  openConsole(object);
}

}  // namespace btr::openr
