#pragma once
#include <OPENR/ObjcommTypes.h>

#include <vector>

namespace btr::openr {

/// An observer's AssertReady or DeassertReady to one subject; it gives these regions back.
void sendReady(const SubjectID& to, const ObserverID& from, ObjcommCommand command, std::vector<RCRegion*> back);

}  // namespace btr::openr
