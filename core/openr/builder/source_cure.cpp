#include "core/openr/builder/source_cure.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "core/openr/builder/compiler_complaints.h"
#include "core/openr/builder/old_extensions.h"

namespace btr::openr {
namespace {

std::map<Place, std::set<std::string>> placesOf(const std::string& errors) {
  std::map<Place, std::set<std::string>> places;
  std::istringstream in(errors);
  const std::string mark = ": error: redefinition of '";
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(mark);
    if (at == std::string::npos) continue;
    const auto close = line.find('\'', at + mark.size());
    const auto columnAt = line.rfind(':', at - 1);
    const auto lineAt = columnAt == std::string::npos ? columnAt : line.rfind(':', columnAt - 1);
    if (close == std::string::npos || lineAt == std::string::npos) continue;
    auto begin = close;
    while (begin > 0 && isNameCharacter(line[begin - 1])) --begin;
    const std::string number = line.substr(lineAt + 1, columnAt - lineAt - 1);
    if (number.empty() || number.size() > 8 || number.find_first_not_of("0123456789") != std::string::npos) continue;
    places[{line.substr(0, lineAt), std::stoi(number)}].insert(line.substr(begin, close - begin));
  }
  return places;
}

/// The last place where `name` stands as a word.
std::size_t lastWord(const std::string& line, const std::string& name) {
  for (auto at = line.rfind(name); at != std::string::npos;
       at = at == 0 ? std::string::npos : line.rfind(name, at - 1)) {
    const bool begins = at == 0 || !isNameCharacter(line[at - 1]);
    const bool ends = at + name.size() == line.size() || !isNameCharacter(line[at + name.size()]);
    if (begins && ends) return at;
  }
  return std::string::npos;
}

/// The word between `begin` and the next quote; empty if `text` does not start with `begin`.
std::string quoted(const std::string& text, const std::string& begin) {
  if (text.rfind(begin, 0) != 0) return "";
  return text.substr(begin.size(), text.find('\'', begin.size()) - begin.size());
}

bool wordAt(const std::string& text, std::size_t at, const std::string& word) {
  return text.compare(at, word.size(), word) == 0 && (at == 0 || !isNameCharacter(text[at - 1])) &&
         (at + word.size() == text.size() || !isNameCharacter(text[at + word.size()]));
}

/// The first place from `begin` on where `name` stands as a word; npos if it does not.
std::size_t firstWord(const std::string& text, std::size_t begin, const std::string& name) {
  auto found = text.find(name, begin);
  while (found != std::string::npos && !wordAt(text, found, name)) found = text.find(name, found + 1);
  return found;
}

/// What a `for` at `at` begins with, from behind its parenthesis to its first semicolon; empty if that declares no
/// `name`.
std::pair<std::size_t, std::size_t> declarationIn(const std::string& text, std::size_t at, const std::string& name) {
  const std::pair<std::size_t, std::size_t> none{0, 0};
  const auto open = text.find_first_not_of(" \t\n", at + 3);
  if (open == std::string::npos || text[open] != '(') return none;
  const auto end = text.find(';', open);
  const auto begin = text.find_first_not_of(" \t\n", open + 1);
  if (end == std::string::npos || begin >= end) return none;
  const auto found = firstWord(text, begin, name);
  // A declaration has its type before the name: "int i", "T* i", "a, i".
  const bool typed = found < end && found > begin && isNameCharacter(text[begin]);
  return typed ? std::pair{begin, end} : none;
}

/// The nearest `for` before `use` that declares `name` and whose variables were known at `use` before the standard;
/// npos if there is none.
std::size_t forBefore(const std::string& text, std::size_t use, const std::string& name) {
  int depth = 0, outermost = 0;
  for (std::size_t i = use; i-- > 0;) {
    if (text[i] == '}') ++depth;
    if (text[i] == '{') outermost = std::min(outermost, --depth);
    if (depth == outermost && wordAt(text, i, "for") && declarationIn(text, i, name).second != 0) return i;
  }
  return std::string::npos;
}

/// Where the declaration that `at` stands in begins.
std::size_t declarationBegin(const std::string& text, std::size_t at) {
  const auto before = text.find_last_of(";{}", at);
  const auto begin = before == std::string::npos || at == 0 ? 0 : before + 1;
  return text.find_first_not_of(" \t\n", begin);
}

/// Where the class begins that names `name` its friend before `use`, which made that name known before the standard;
/// npos if there is none.
std::size_t befriendingClass(const std::string& text, std::size_t use, const std::string& name) {
  const std::string words = "friend class " + name;
  auto at = text.rfind(words, use);
  while (at != std::string::npos && (at + words.size() > use || !wordAt(text, at, words)))
    at = at == 0 ? std::string::npos : text.rfind(words, at - 1);
  if (at == std::string::npos) return at;
  int depth = 0;
  while (at-- > 0) {
    depth += text[at] == '}' ? 1 : text[at] == '{' ? -1 : 0;
    if (depth < 0) return at == 0 ? std::string::npos : declarationBegin(text, at - 1);
  }
  return std::string::npos;
}

/// Takes the declarations of the `for`s at `places` before them; one whose block already has that variable sets it.
void hoist(const std::string& text, const std::set<std::pair<std::size_t, std::string>>& places, Changes& changes) {
  std::size_t last = std::string::npos;
  std::string lastName;
  for (const auto& [at, name] : places) {
    const auto [begin, end] = declarationIn(text, at, name);
    bool known = false;
    if (last != std::string::npos && lastName == name) {
      int depth = 0, least = 0;
      for (std::size_t i = last; i < at; ++i) {
        depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
        least = std::min(least, depth);
      }
      known = depth == 0 && least == 0;
    }
    if (known) {
      changes[begin] = {firstWord(text, begin, name) - begin, ""};
    } else {
      changes[at] = {0, text.substr(begin, end - begin) + "; "};
      changes[begin] = {end - begin, ""};
    }
    last = at;
    lastName = name;
  }
}

/// Names of which the compiler does not say where they are; headers of 2003 had them by others.
const std::map<std::string, std::string>& systemHeaders() {
  static const std::map<std::string, std::string> all = [] {
    const std::pair<const char*, const char*> namesOf[] = {
        {"unistd.h", "access close getcwd getpid isatty lseek read rmdir sbrk sleep unlink usleep write"},
        {"fcntl.h", "open O_RDONLY O_RDWR O_WRONLY"},
        {"sys/stat.h", "mkdir stat chmod"},
        {"dirent.h", "opendir readdir closedir DIR"},
        {"sys/time.h", "gettimeofday"},
        {"strings.h", "bzero index rindex strcasecmp strncasecmp"},
        {"arpa/inet.h", "htonl htons ntohl ntohs"},
        {"btr_newlib.h", "strlwr strupr stricmp strcmpi strnicmp strncmpi M_TWOPI M_3PI_4 M_SQRTPI M_SQRT3"},
        {"math.h",
         "M_E M_LN10 M_LN2 M_LOG10E M_LOG2E M_PI M_PI_2 M_PI_4 M_1_PI M_2_PI M_SQRT1_2 M_SQRT2 HUGE_VAL acos asin atan "
         "atan2 ceil cos cosh exp fabs floor fmod frexp ldexp log log10 modf pow sin sinh sqrt tan tanh cbrt copysign "
         "expm1 finite hypot ilogb isinf isnan log1p logb nextafter remainder rint acosf asinf atanf atan2f ceilf cosf "
         "expf fabsf floorf fmodf hypotf logf log10f powf rintf sinf sqrtf tanf round roundf lround trunc"},
        {"ctype.h",
         "isalnum isalpha iscntrl isdigit isgraph islower isprint ispunct isspace isupper isxdigit tolower toupper "
         "isascii toascii"},
        {"setjmp.h", "setjmp longjmp jmp_buf"},
        {"signal.h", "signal raise SIGFPE SIGINT SIGSEGV"},
        {"limits.h", "PATH_MAX"},
        {"limits", "numeric_limits"},
        {"iomanip", "setw setfill setprecision setbase setiosflags resetiosflags"},
        {"algorithm",
         "sort stable_sort partial_sort nth_element find find_if count count_if reverse unique random_shuffle "
         "lower_bound upper_bound binary_search min_element max_element for_each replace remove_if transform "
         "next_permutation"},
        {"numeric", "accumulate inner_product partial_sum"},
        {"bitset", "bitset"},
        {"memory", "auto_ptr"},
        {"strstream", "istrstream ostrstream strstream"},
        {"stdint.h", "uint8_t uint16_t uint32_t uint64_t intptr_t uintptr_t"},
        {"values.h", "MAXINT MAXLONG MAXSHORT MAXFLOAT MAXDOUBLE MINDOUBLE MINFLOAT MININT"},
        // Headers of OPEN-R that came with others of it.
        {"OPENR/OUnits.h", "degrees radians micro oradians"},
        {"OPENR/OSyslog.h", "OSYSLOG1 OSYSPRINT OSYSDEBUG osyslogERROR osyslogWARNING osyslogINFO"},
        {"OPENR/OPENRAPI.h", "OPENR"},
        {"OPENR/OFbkImage.h",
         "OFbkImage OFbkImageBand ofbkimageBAND_Y ofbkimageBAND_Cr ofbkimageBAND_Cb ofbkimageBAND_CDT"},
        {"OPENR/ODataFormats.h",
         "OCommandVectorData OCommandInfo OCommandData OSensorFrameVectorData OSensorFrameInfo OSensorFrameData "
         "OSensorValue OJointValue OFbkImageVectorData OFbkImageInfo OSoundVectorData OSoundInfo OCdtVectorData "
         "OCdtInfo"},
        {"OPENR/OPower.h", "OPowerStatus OBootCondition opowerON opowerOFF"},
        {"OPENR/OPENRMessages.h", "OPowerStatusMessage OReasonMessage"},
        {"OPENR/OPrimitiveControl.h", "OPrimitiveControl_CameraParam OPrimitiveControl_SpeakerVolume"},
        {"OPENR/OTime.h", "OTime"},
        {"OPENR/OCalendarTime.h", "OCalendarTime"},
        {"SystemTime.h", "SystemTime GetSystemTime"},
        {"IPAddress.h", "IPAddress IP_ADDR_ANY IP_ADDR_BROADCAST"},
        {"antTypes.h", "TRUE FALSE"},
        {"ant.h", "antStackRef antModuleRef antSharedBuffer antEnvMsg ANTENVMSG"},
        {"EndpointTypes.h", "EndpointType_TCP EndpointType_UDP"},
        {"TCPEndpointMsg.h",
         "TCPEndpointListenMsg TCPEndpointConnectMsg TCPEndpointSendMsg TCPEndpointReceiveMsg TCPEndpointCloseMsg"},
        {"UDPEndpointMsg.h",
         "UDPEndpointBindMsg UDPEndpointConnectMsg UDPEndpointSendMsg UDPEndpointReceiveMsg UDPEndpointCloseMsg"}};
    std::map<std::string, std::string> headers;
    for (const auto& [header, names] : namesOf) {
      std::istringstream words(names);
      for (std::string word; words >> word;) headers[word] = header;
    }
    return headers;
  }();
  return all;
}

/// Whether a complaint is about a name of the standard library without its `std::`, which compilers before the standard
/// had everywhere.
bool lacksStandardNamespace(const std::string& line) {
  if (line.find("did you mean 'std::") != std::string::npos) return true;
  if (line.find(": note: 'std::") != std::string::npos && line.find("' declared here") != std::string::npos)
    return true;
  static const std::set<std::string> types = {"string",   "vector", "list",    "map",      "set",     "deque",
                                              "multimap", "pair",   "queue",   "stack",    "ostream", "istream",
                                              "ofstream", "bitset", "fstream", "ifstream", "multiset"};
  const std::string begin = ": error: '", end = "' does not name a type";
  const auto at = line.find(begin), close = line.find(end);
  return at != std::string::npos && close != std::string::npos && close > at + begin.size() &&
         types.count(line.substr(at + begin.size(), close - at - begin.size())) != 0;
}

/// The header of a stream that a source has but by name.
std::string headerOfIncomplete(const std::string& line) {
  if (line.find("incomplete type") == std::string::npos) return "";
  for (const char* stream : {"stringstream", "istringstream", "ostringstream"})
    if (line.find(std::string("std::") + stream) != std::string::npos) return "sstream";
  for (const char* stream : {"std::fstream", "std::ifstream", "std::ofstream"})
    if (line.find(stream) != std::string::npos) return "fstream";
  return "";
}

bool namesSomethingUnknown(const std::string& line) {
  for (const char* how : {"' was not declared in this scope", "' does not name a type", "' has not been declared",
                          "' is not a member of 'std'"})
    if (line.find(how) != std::string::npos) return true;
  return false;
}

}  // namespace

std::vector<std::string> missingHeaders(const std::string& errors) {
  std::vector<std::string> headers;
  std::istringstream in(errors);
  const std::string mark = " is defined in header '<", unknown = ": error: '";
  const auto add = [&headers](const std::string& header) {
    if (std::find(headers.begin(), headers.end(), header) == headers.end()) headers.push_back(header);
  };
  for (std::string line; std::getline(in, line);) {
    if (const auto at = line.find(unknown); at != std::string::npos && namesSomethingUnknown(line)) {
      const auto name = line.substr(at + unknown.size());
      if (const auto found = systemHeaders().find(name.substr(0, name.find('\''))); found != systemHeaders().end())
        add(found->second);
    }
    if (const std::string header = headerOfIncomplete(line); !header.empty()) add(header);
    if (lacksStandardNamespace(line)) add("btr_standard_names.h");
    if (line.find("must '#include <typeinfo>' before using 'typeid'") != std::string::npos) add("typeinfo");
    const auto at = line.find(mark);
    const auto end = at == std::string::npos ? at : line.find('>', at);
    if (end != std::string::npos) add(line.substr(at + mark.size(), end - at - mark.size()));
  }
  return headers;
}

std::string curedSource(const std::string& preprocessed, const std::string& errors) {
  const std::string named = withoutRepeatedNames(preprocessed, errors);
  if (named != preprocessed) return named;
  const auto begins = lineBegins(preprocessed);
  const std::string bare = withoutLiterals(preprocessed);
  Changes changes;
  std::set<std::pair<std::size_t, std::string>> loops;
  const auto complaints = complaintsOf(errors);
  const auto isTypename = [](const Complaint& each) { return each.text.rfind("need 'typename' before", 0) == 0; };
  // Others may be no more than their consequences.
  const bool typenamesOnly = std::any_of(complaints.begin(), complaints.end(), isTypename);
  for (const Complaint& complaint : complaints) {
    if (typenamesOnly && !isTypename(complaint)) continue;
    const auto line = begins.find({complaint.file, complaint.line});
    if (line == begins.end()) continue;
    const std::size_t at = line->second + static_cast<std::size_t>(complaint.column - 1);
    if (at >= preprocessed.size()) continue;
    if (typenamesOnly) {
      changes[at] = {0, "typename "};
      continue;
    }
    if (complaint.text.find("requires 'template<>' syntax") != std::string::npos) {
      changes[at == 0 ? 0 : declarationBegin(bare, at - 1)] = {0, "template<> "};
      continue;
    }
    const std::string name = quoted(complaint.text, "'");
    if (complaint.text == "'" + name + "' does not name a type") {
      const auto friendly = befriendingClass(bare, at, name);
      if (friendly != std::string::npos) changes[friendly] = {0, "class " + name + "; "};
      continue;
    }
    if (complaint.text.find("was not declared in this scope") == std::string::npos || !wordAt(preprocessed, at, name))
      continue;
    if (const auto loop = forBefore(bare, at, name); loop != std::string::npos)
      loops.insert({loop, name});
    else if (complaint.function.find("member function") != std::string::npos &&
             complaint.function.find('<') != std::string::npos)
      changes[at] = {0, "this->"};
  }
  addOldExtensions(preprocessed, bare, begins, complaints, changes);
  // The text of a literal in a moved declaration is the source's own.
  hoist(preprocessed, loops, changes);
  return changed(preprocessed, changes);
}

std::string withoutRepeatedNames(const std::string& preprocessed, const std::string& errors) {
  const auto places = placesOf(errors);
  std::istringstream in(preprocessed);
  std::ostringstream out;
  Place at{"", 0};
  for (std::string line; std::getline(in, line); ++at.second) {
    std::istringstream words(line);
    std::string hash, file;
    int number = 0;
    if (line.size() > 2 && line[0] == '#' && words >> hash >> number >> file && file.size() > 1) {
      at = {file.substr(1, file.rfind('"') - 1), number - 1};
    } else if (const auto found = places.find(at); found != places.end()) {
      for (const std::string& name : found->second) {
        const auto word = name.empty() ? std::string::npos : lastWord(line, name);
        if (word != std::string::npos) line.erase(word, name.size());
      }
    }
    out << line << '\n';
  }
  return out.str();
}

}  // namespace btr::openr
