#include "core/openr/builder/stub_generator.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>

#include "core/openr/builder/comments.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

bool isIdentifier(const std::string& text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text[0]))) return false;
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return c < 128 && (std::isalnum(c) || c == '_'); });
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::string part;
  std::istringstream in(text);
  while (std::getline(in, part, at)) parts.push_back(trimmed(part));
  if (!text.empty() && text.back() == at) parts.push_back("");
  return parts;
}

class StubReader {
 public:
  StubReader(const std::string& text, const std::string& file) : in_(withoutComments(text)), file_(file) {}

  StubConfig read() {
    std::string line;
    while (std::getline(in_, line)) {
      ++line_;
      if (trimmed(line).empty()) continue;
      const auto colon = line.find(':');
      if (colon == std::string::npos) refuseLine(trimmed(line));
      take(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
    }
    check();
    return std::move(config_);
  }

 private:
  void take(const std::string& key, const std::string& value) {
    if (key == "ObjectName") {
      if (!isIdentifier(value)) refuse("ObjectName", value, "the name of a class is");
      config_.object = value;
    } else if (key == "NumOfOSubject" || key == "NumOfSubject") {
      subjects_ = count(key, value);
    } else if (key == "NumOfOObserver" || key == "NumOfObserver") {
      observers_ = count(key, value);
    } else if (key == "Service") {
      takeService(value);
    } else if (key == "Extra") {
      config_.extras.push_back(method("Extra", value));
      if (config_.extras.back().empty()) refuse("Extra", value, "a method as Name() is");
    } else {
      refuseLine(key);
    }
  }

  void takeService(const std::string& value) {
    const auto open = value.find('"'), close = value.find('"', open + 1);
    if (open != 0 || close == std::string::npos)
      refuse("Service", value, "\"Object.Sub.Type.S\", Method(), Method() is");
    StubService service{value.substr(1, close - 1), "", ""};
    const auto parts = split(service.name, '.');
    const bool subject = parts.size() == 4 && parts[3] == "S";
    if (parts.size() != 4 || (!subject && parts[3] != "O"))
      refuse("Service", service.name, "four parts with points between, the last S or O, are");
    if (!isIdentifier(parts[1])) refuse("Service", service.name, "a second part of letters, digits and _ is");
    const auto methods = split(trimmed(value.substr(close + 1)), ',');
    if (methods.size() != 3 || !methods[0].empty())
      refuse("Service", value, "the name and two methods with commas between are");
    service.first = method("Service", methods[1]);
    service.second = method("Service", methods[2]);
    auto& of = subject ? config_.subjects : config_.observers;
    for (const StubService& other : of)
      if (other.sub() == service.sub()) refuse("Service", service.name, "a second part that no other one has is");
    of.push_back(service);
  }

  /// The name in "Name()"; empty for "null".
  std::string method(const std::string& key, const std::string& text) {
    if (text == "null") return "";
    const auto open = text.find('(');
    if (open == std::string::npos || trimmed(text.substr(open + 1)) != ")" ||
        !isIdentifier(trimmed(text.substr(0, open))))
      refuse(key, text, "null or a method as Name() is");
    return trimmed(text.substr(0, open));
  }

  std::size_t count(const std::string& key, const std::string& value) {
    if (value.empty() || value.size() > 3 || !std::all_of(value.begin(), value.end(), ::isdigit) ||
        std::stoi(value) < 1)
      refuse(key, value, "1 to 999 is");
    return static_cast<std::size_t>(std::stoi(value));
  }

  void check() {
    if (config_.object.empty())
      throw InputError(file_ + ": ObjectName is missing; a line \"ObjectName : NAME\" is needed");
    checkCount("NumOfOSubject", subjects_, config_.subjects.size(), "S");
    checkCount("NumOfOObserver", observers_, config_.observers.size(), "O");
  }

  void checkCount(const std::string& key, std::optional<std::size_t> said, std::size_t found, const std::string& kind) {
    if (!said)
      throw InputError(file_ + ": " + key + " is missing; the number of services that end with ." + kind +
                       " is needed");
    if (*said != found)
      throw InputError(file_ + ": " + key, std::to_string(*said),
                       std::to_string(found) + " is: so many services end with ." + kind);
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed) {
    throw InputError(here() + ": " + key, "\"" + value + "\"", allowed);
  }
  [[noreturn]] void refuseLine(const std::string& begin) {
    throw InputError(
        here(), "\"" + begin + "\"",
        "ObjectName, NumOfOSubject, NumOfOObserver, Service or Extra, a colon and its value, or a comment, "
        "is");
  }
  std::string here() const { return file_ + ":" + std::to_string(line_); }

  std::istringstream in_;
  std::string file_;
  int line_ = 0;
  StubConfig config_;
  std::optional<std::size_t> subjects_, observers_;
};

std::string guarded(const std::string& name, const std::string& text) {
  return "#ifndef " + name + "\n#define " + name + "\n\n" + text + "\n#endif\n";
}

std::string services(const std::string& array, const std::string& prefix, const std::vector<StubService>& of) {
  std::string text = "static const char* const " + array + "[] = {";
  for (const StubService& service : of) text += "\n  \"" + service.name + "\",";
  text += "\n};\n";
  for (std::size_t i = 0; i < of.size(); ++i)
    text += "static const int " + prefix + of[i].sub() + " = " + std::to_string(i) + ";\n";
  return text;
}

std::string definitions(const StubConfig& config) {
  return guarded("def_h_DEFINED", "static const char* const objectName = \"" + config.object + "\";\n" +
                                      "static const int numOfSubject = " + std::to_string(config.subjects.size()) +
                                      ";\n" +
                                      "static const int numOfObserver = " + std::to_string(config.observers.size()) +
                                      ";\n" + services("subjectService", "sbj", config.subjects) +
                                      services("observerService", "obs", config.observers));
}

/// Numbers from `next` on.
std::string selectors(const std::string& array, std::size_t count, std::size_t& next) {
  std::string text = "static const Selector " + array + "[] = {";
  for (std::size_t i = 0; i < count; ++i) text += std::string(i == 0 ? "" : ", ") + std::to_string(next++);
  return text + "};\n";
}

std::string entries(const StubConfig& config) {
  std::size_t next = 0;
  std::string text = "#include <Types.h>\n#include \"def.h\"\n\nstatic const int numOfHook = 4;\n";
  text += selectors("Entry_Hook", 4, next);
  text += selectors("Entry_Control", config.subjects.size(), next);
  text += selectors("Entry_Ready", config.subjects.size(), next);
  text += selectors("Entry_Connect", config.observers.size(), next);
  text += selectors("Entry_Notify", config.observers.size(), next);
  text += "static const int numOfBasicEntries = " + std::to_string(next) + ";\n";
  if (!config.extras.empty()) text += selectors("Extra_Entry", config.extras.size(), next);
  for (std::size_t i = 0; i < config.extras.size(); ++i)
    text += "static const int entry" + config.extras[i] + " = " + std::to_string(i) + ";\n";
  return guarded("entry_h_DEFINED", text);
}

struct StubFunction {
  std::string name, method, body;
};

/// In the order of their selectors.
std::vector<StubFunction> functions(const StubConfig& config) {
  std::vector<StubFunction> all;
  for (const char* hook : {"Init", "Start", "Stop", "Destroy"})
    all.push_back({hook, std::string("Do") + hook,
                   "  OReasonMessage* m = (OReasonMessage*)message;\n  Self." + std::string(hook) +
                       "(OSystemEvent(m->reason, m->param, m->paramSize));\n"});
  const auto each = [&](const std::vector<StubService>& of, const char* kind, bool second, auto body) {
    for (std::size_t i = 0; i < of.size(); ++i) {
      const std::string& method = second ? of[i].second : of[i].first;
      all.push_back({kind + std::to_string(i), method.empty() ? kind + (" of " + of[i].sub()) : method,
                     body(std::to_string(i), method)});
    }
  };
  each(config.subjects, "Control", false, [](const std::string& i, const std::string& method) {
    return "  OControlMessage* m = (OControlMessage*)message;\n  OStatus status = " +
           (method.empty() ? "oSUCCESS"
                           : "Self." + method + "(OControlEvent(" + i + ", m->observer, m->name, m->command))") +
           ";\n  Self.subject[" + i + "]->ControlHandler(*m, status);\n";
  });
  each(config.subjects, "Ready", true, [](const std::string& i, const std::string& method) {
    return "  OReadyMessage* m = (OReadyMessage*)message;\n  Self.subject[" + i + "]->ReadyHandler(*m);\n" +
           (method.empty() ? "" : "  Self." + method + "(OReadyEvent(" + i + ", m->observer, m->command));\n");
  });
  each(config.observers, "Connect", false, [](const std::string& i, const std::string& method) {
    return "  OConnectMessage* m = (OConnectMessage*)message;\n  OStatus status = " +
           (method.empty() ? "oSUCCESS" : "Self." + method + "(OConnectEvent(" + i + ", m->name, m->command))") +
           ";\n  Self.observer[" + i + "]->ConnectHandler(*m, status);\n";
  });
  each(config.observers, "Notify", true, [](const std::string& i, const std::string& method) {
    return "  ONotifyMessage* m = (ONotifyMessage*)message;\n  ONotifyEvent event;\n  event.SetIndex(" + i +
           ");\n  Self.observer[" + i + "]->NotifyHandler(*m, &event);\n" +
           (method.empty() ? "" : "  Self." + method + "(event);\n");
  });
  for (const std::string& extra : config.extras) all.push_back({extra, extra, "  Self." + extra + "(message);\n"});
  return all;
}

std::string declarations(const StubConfig& config) {
  std::string text = "extern \"C\" {\n";
  for (const StubFunction& function : functions(config)) text += "void _" + function.name + "(void* message);\n";
  return guarded(config.object + "Stub_h_DEFINED", text + "}\n");
}

std::string stub(const StubConfig& config) {
  const auto all = functions(config);
  std::string text =
      "#include <MCOOP.h>\n#include <OPENR/OObject.h>\n#include <OPENR/OObserver.h>\n#include <OPENR/OSubject.h>\n"
      "#include <ObjectEntryTable.h>\n#include <apsys.h>\n#include \"" +
      config.object + ".h\"\n#include \"entry.h\"\n#include \"" + config.object + "Stub.h\"\n\n" + config.object +
      " Self;\n\n";
  for (const StubFunction& function : all)
    text += "extern \"C\" void _" + function.name + "(void* message) {\n" + function.body + "}\n\n";
  text += "ObjectEntry ObjectEntryTable[] = {\n";
  for (std::size_t i = 0; i < all.size(); ++i)
    text += "  {" + std::to_string(i) + ", (Entry)::_" + all[i].name + "},\n";
  text += "  {UNDEF, (Entry)ENTRY_UNDEF}\n};\n\n";
  text += "// Who and where, for lines on the console and when something goes wrong.\nextern \"C\" {\n";
  text += "extern const char btr_openr_object[] = \"" + config.object + "\";\n";
  text += "extern const char* const btr_openr_methods[] = {\n";
  for (const StubFunction& function : all) text += "  \"" + function.method + "\",\n";
  return text + "  0\n};\n}\n";
}

}  // namespace

std::string StubService::sub() const {
  const auto parts = split(name, '.');
  return parts.size() > 1 ? parts[1] : "";
}

StubConfig stubConfigFrom(const std::string& text, const std::string& file) { return StubReader(text, file).read(); }

std::map<std::string, std::string> stubFiles(const StubConfig& config) {
  return {{"def.h", definitions(config)},
          {"entry.h", entries(config)},
          {config.object + "Stub.h", declarations(config)},
          {config.object + "Stub.cc", stub(config)}};
}

}  // namespace btr::openr
