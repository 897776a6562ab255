// The standard library's names without std::, as before the standard; typeid without its header; pages.
#include "Plain.h"

#include <OPENR/core_macro.h>
#include <apsys.h>
#include <ieeefp.h>
#include <machine/endian.h>

#include <algorithm>
#include <iomanip.h>
#include <sstream>

typedef map<string, int>::const_iterator Word;

struct Base {
  virtual ~Base() {}
};
struct Derived : public Base {};

// A new and a delete of its own, as programs had them that look for what nobody frees.
void* operator new(size_t bytes) throw(std::bad_alloc) {
  size_t* memory = (size_t*)malloc(bytes + 16);
  memory[1] = 0xfeed;
  return memory + 2;
}
void operator delete(void* given) throw() {
  if (given == 0) return;
  size_t* memory = (size_t*)given - 2;
  if (memory[1] != 0xfeed) abort();
  memory[1] = 0;
  free(memory);
}

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
  ostringstream out;
  for (int i = 0; i < 30; i++) out << i << ", ";
  cout << out.str().substr(0, 20) << " and so on, " << out.str().size() << " letters" << endl;
  Base* base = new Derived;
  cout << "same type " << (typeid(*base) == typeid(Derived)) << endl;
  unsigned int bytes = 0;
  sError error = GetPageSize(&bytes);
  size_t same = 0;
  GetPageSize(&same);
  // Addresses kept in an int.
  static int table[4];
  int local = 7, *grown = (int*)malloc(3000000);
  const int self = (int)this, here = (int)&local, there = (int)table, far = (int)grown;
  char* even = (char*)(((unsigned int)grown + 63) & ~63);
  cout << "kept " << ((Plain*)self == this) << ((int*)here == &local) << ((int*)there == table)
       << ((int*)far == grown) << (even - (char*)grown < 64) << endl;
  free(grown);
  char name[] = "Neck";
  cout << strupr(name) << " " << finite(M_TWOPI) << (BYTE_ORDER == LITTLE_ENDIAN) << endl;
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
