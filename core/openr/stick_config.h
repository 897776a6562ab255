#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace btr::openr {

/// The three lists in OPEN-R/MW/CONF of a stick, for one robot: lines before any [ERS-x] and those after its own.
struct StickConfig {
  std::vector<std::string> objects;                              ///< OBJECT.CFG: "/MS/OPEN-R/MW/OBJS/HELLO.BIN"
  std::vector<std::pair<std::string, std::string>> connections;  ///< CONNECT.CFG: subject, observer
  bool connected = false;                                        ///< whether there is a CONNECT.CFG
  std::map<std::string, std::string> designData;                 ///< DESIGNDB.CFG: keyword, path
};

/// The lines that hold for robot `design`: without comments (from # on) and empty ones, each with its words.
std::vector<std::vector<std::string>> configLines(const std::string& text, const std::string& design);

/// Reads the lists of the stick in folder `stick`; a list that is not there is empty, but for OBJECT.CFG: InputError. A
/// line with too few words is an InputError with its file.
StickConfig stickConfig(const std::string& stick, const std::string& design);

/// The file or folder that "/MS/…" means in folder `stick`: names count whatever their case, a name that is not there
/// is upper-cased. Empty if the path leaves the stick ("..", or a link to outside) or does not begin with /MS.
std::string onStick(const std::string& stick, const std::string& path);

}  // namespace btr::openr
