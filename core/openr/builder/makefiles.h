#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace btr::openr {

bool isMakefile(const std::filesystem::path& path);
/// Whether it is one, or may be what one includes, which has many names: "defs.mk", "makefile.config".
bool isPartOfMakefile(const std::filesystem::path& path);
/// What a Makefile says together with the files that it includes, which are named from `folder`; `values` gets its
/// variables, the first value of each.
std::string withIncludes(const std::filesystem::path& folder, const std::filesystem::path& makefile,
                         std::map<std::string, std::string>& values);
/// Whether a folder is an object's by its other files.
bool looksLikeObject(const std::filesystem::path& folder);
/// Whether a Makefile, or what it includes, makes a module for the robot.
bool makesModule(const std::filesystem::path& makefile);
/// Whether a Makefile makes a library that objects are linked with.
bool makesLibrary(const std::filesystem::path& makefile);

}  // namespace btr::openr
