// Folders of the stick: their entries come in the order of their names, so that a program that lists them does the same
// on every computer and file system. Its root has no "." and "..", as on the robot's file system.
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "core/openr/runtime/objects/system.h"
#include "core/openr/stick_config.h"

using btr::openr::OwnAccess;
using btr::openr::System;
using btr::openr::theSystemIsThere;

namespace {

struct Listing {
  std::vector<dirent> entries;
  std::size_t next = 0;
};

/// Of the folders that programs have open.
std::map<DIR*, Listing>& listings() {
  static auto* const all = new std::map<DIR*, Listing>;
  return *all;
}

Listing* listingOf(DIR* folder) {
  const auto at = listings().find(folder);
  return at == listings().end() ? nullptr : &at->second;
}

/// Where `path` stands; empty if it is not on the stick.
std::string onThisComputer(const char* path) {
  return path == nullptr ? "" : btr::openr::onStick(System::instance().stick, path);
}

template <class F>
F own(const char* name) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

DIR* opendir(const char* path) {
  static const auto real = own<DIR* (*)(const char*)>("opendir");
  static const auto realRead = own<dirent* (*)(DIR*)>("readdir");
  if (!theSystemIsThere() || System::instance().current() == nullptr || OwnAccess::any()) return real(path);
  const OwnAccess access;
  const std::string place = onThisComputer(path);
  if (place.empty()) {
    errno = ENOENT;
    return nullptr;
  }
  DIR* folder = real(place.c_str());
  if (folder == nullptr) return nullptr;
  const bool top = place == onThisComputer("/MS");
  Listing listing;
  while (const dirent* entry = realRead(folder)) {
    const bool dots = std::strcmp(entry->d_name, ".") == 0 || std::strcmp(entry->d_name, "..") == 0;
    if (!top || !dots) listing.entries.push_back(*entry);
  }
  std::sort(listing.entries.begin(), listing.entries.end(),
            [](const dirent& a, const dirent& b) { return std::strcmp(a.d_name, b.d_name) < 0; });
  listings()[folder] = std::move(listing);
  return folder;
}

dirent* readdir(DIR* folder) {
  static const auto real = own<dirent* (*)(DIR*)>("readdir");
  Listing* listing = listingOf(folder);
  if (listing == nullptr) return real(folder);
  return listing->next < listing->entries.size() ? &listing->entries[listing->next++] : nullptr;
}

dirent64* readdir64(DIR* folder) {
  static_assert(sizeof(dirent64) == sizeof(dirent), "the two are one where off_t has 64 bits");
  return reinterpret_cast<dirent64*>(readdir(folder));
}

void rewinddir(DIR* folder) noexcept {
  static const auto real = own<void (*)(DIR*)>("rewinddir");
  if (Listing* listing = listingOf(folder))
    listing->next = 0;
  else
    real(folder);
}

long telldir(DIR* folder) noexcept {
  static const auto real = own<long (*)(DIR*)>("telldir");
  const Listing* listing = listingOf(folder);
  return listing == nullptr ? real(folder) : static_cast<long>(listing->next);
}

void seekdir(DIR* folder, long place) noexcept {
  static const auto real = own<void (*)(DIR*, long)>("seekdir");
  Listing* listing = listingOf(folder);
  if (listing == nullptr) return real(folder, place);
  listing->next = place < 0 ? 0 : static_cast<std::size_t>(place);
}

int closedir(DIR* folder) {
  static const auto real = own<int (*)(DIR*)>("closedir");
  listings().erase(folder);
  return real(folder);
}

/// Programs stand in no folder: every path begins with /MS.
char* getcwd(char* to, size_t size) noexcept {
  static const auto real = own<char* (*)(char*, size_t)>("getcwd");
  if (!theSystemIsThere() || System::instance().current() == nullptr || OwnAccess::any()) return real(to, size);
  errno = ENOSYS;
  return nullptr;
}

}  // extern "C"
