// Subjects and observers of CONNECT.CFG are brought together.
#include <algorithm>
#include <cstdio>
#include <sstream>

#include "core/openr/runtime/objects/system.h"

namespace btr::openr {

void System::connect() {
  const auto find = [this](const std::string& name, bool subject, OServiceEntry& begin, OServiceEntry& data) {
    for (const auto& object : objects_) {
      const auto& services = subject ? object->subjects : object->observers;
      const auto& entries = subject ? object->readyEntries : object->notifyEntries;
      for (std::size_t i = 0; i < services.size(); ++i) {
        if (services[i].name != name) continue;
        begin = services[i].begin;
        if (i < entries.size()) data = entries[i];
        return true;
      }
    }
    return false;
  };
  const auto part = [](const std::string& name, int wanted) {
    std::istringstream in(name);
    std::string found;
    for (int i = 0; i <= wanted; ++i)
      if (!std::getline(in, found, '.')) return std::string();
    return found;
  };
  // Of the object that `name` begins with: what it has of the kind.
  const auto others = [&](const std::string& name, bool subject) {
    std::string all;
    for (const auto& object : objects_)
      for (const auto& service : subject ? object->subjects : object->observers)
        if (part(service.name, 0) == part(name, 0)) all += (all.empty() ? "; there is " : ", ") + service.name;
    return all;
  };
  const auto endsWith = [](const std::string& name, const char* end) {
    return name.size() > 2 && name.compare(name.size() - 2, 2, end) == 0;
  };
  const auto wantsToConnect = [&](const auto& object) {
    const auto wants = [&](const auto& service) { return part(service.name, 2) != "DoNotConnect"; };
    return !object->native && (std::any_of(object->subjects.begin(), object->subjects.end(), wants) ||
                               std::any_of(object->observers.begin(), object->observers.end(), wants));
  };
  if (!config.connected && std::any_of(objects_.begin(), objects_.end(), wantsToConnect))
    say("",
        "OPEN-R/MW/CONF/CONNECT.CFG is missing: no subject has an observer; a line of it is a subject and an observer");
  for (const auto& [subject, observer] : config.connections) {
    if (endsWith(subject, ".O") && endsWith(observer, ".S")) {
      say("",
          "CONNECT.CFG: the subject " + observer + " is to stand before the observer " + subject + ": not connected");
      continue;
    }
    OServiceEntry control, ready, connectTo, notify;
    const bool hasSubject = find(subject, true, control, ready), hasObserver = find(observer, false, connectTo, notify);
    if (!hasSubject || !hasObserver) {
      say("", "CONNECT.CFG: nobody here has " + (hasSubject ? observer : subject) + ": not connected" +
                  others(hasSubject ? observer : subject, !hasSubject));
      continue;
    }
    if (part(subject, 2) != part(observer, 2)) {
      say("", "CONNECT.CFG: " + subject + " and " + observer + " have different types: not connected");
      continue;
    }
    auto forSubject = std::make_shared<OControlMessage>();
    forSubject->command = objcommADD_OBSERVER;
    forSubject->observer = notify;
    std::snprintf(forSubject->name, sizeof(forSubject->name), "%s", observer.c_str());
    send(control, forSubject);
    auto forObserver = std::make_shared<OConnectMessage>();
    forObserver->command = objcommCONNECT;
    forObserver->subject = ready;
    std::snprintf(forObserver->name, sizeof(forObserver->name), "%s", subject.c_str());
    connections_.push_back({notify, connectTo, forObserver});
  }
}

/// Observers are told once their subjects have answered, and not of those that refuse them.
void System::connectObservers() {
  for (const Connection& each : connections_)
    if (refused_.count({each.message->subject, each.observer}) == 0) send(each.entry, each.message);
  connections_.clear();
}

}  // namespace btr::openr
