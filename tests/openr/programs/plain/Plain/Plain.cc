// The standard library's names without std::, as before the standard; typeid without its header; pages.
#include "Plain.h"

#include <OPENR/core_macro.h>
#include <apsys.h>

#include <algorithm>
#include <iomanip.h>
#include <sstream>

typedef map<string, int>::const_iterator Word;

struct Base {
  virtual ~Base() {}
};
struct Derived : public Base {};

Plain::Plain() {}

OStatus Plain::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}

OStatus Plain::DoStart(const OSystemEvent& event) {
  istringstream in("walk 3 kick 5");
  string word;
  int number;
  while (in >> word >> number) words[word] = number;
  for (Word w = words.begin(); w != words.end(); ++w) cout << setw(6) << left << w->first << w->second << ";";
  cout << " most " << max(words["walk"], words["kick"]) << endl;
  Base* base = new Derived;
  cout << "same type " << (typeid(*base) == typeid(Derived)) << endl;
  unsigned int bytes = 0;
  sError error = GetPageSize(&bytes);
  size_t same = 0;
  GetPageSize(&same);
  cout << "page " << error << " " << bytes << " " << (same == bytes) << endl;
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Plain::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Plain::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}
