#include <string.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OUnits.h>
#include <MCOOP.h>
#include "Dialect.h"
#include "entry.h"

extern int stl_test();
static Frame globalFrame;
static char* const messages[] = { "one", "two", "three" };

Dialect::Dialect() : mode(IDLE), secret(5) { for (int i = 0; i < SIZE; i++) bytes[i] = i; }

OStatus Dialect::DoInit(const OSystemEvent& event)
{
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}
OStatus Dialect::DoStart(const OSystemEvent& event)
{
  char* p = "literal";
  say("hello");
  say(p);
  scanned();
  OSYSPRINT(("sum %d frame %d\n", old_sum(1, 2), globalFrame.n));
  int i;
  for (i = 0; i < 3; i++) cout << messages[i] << " ";
  cout << hex << 255 << dec << setw(5) << 3 << endl;
  unsigned int addr = (unsigned int)this;
  OSYSDEBUG(("never %d\n", i));
  OSYSLOG1((osyslogERROR, "%s : %s %d", "Dialect::DoStart()", "FAILED", oFAIL));
  OSYSLOG1((osyslogWARNING, "warn"));
  stl_test();
  cerr << "on cerr" << endl;
  ofstream f("/MS/LOG.TXT"); f << "text " << 3.5 << "\n"; f.close();
  ifstream g("/MS/LOG.TXT", ios::in); char w[20]; g >> w; cout << w << endl;
  bool b = mode; secret = b ? RUN : IDLE; mode = (Mode)RUN; 
  int n = 3.7; byte c = 300; 
  const char q = '\377';
  OSYSPRINT(("%d %d %d %f %d\n", n, c, q < 0, RATE, strlen(p)));
  void* vp = (void*)3; int back = (int)vp; long l = (long)vp; 
  switch (mode) { case RUN: int z; z = 3; break; default: ; }
  int size = 4; double arr[size]; memset(arr, 0, sizeof(arr));
  int (*fn)(int,int) = old_sum; 
  if (mode = RUN) cout << "assign in if " << back << " " << fn(2,3) << endl;
  char str[10]; sprintf(str, "%03d", 7); cout << str << "\n" << flush;
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}
OStatus Dialect::DoStop(const OSystemEvent&) { DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Dialect::DoDestroy(const OSystemEvent&) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }
void Dialect::Notified(const ONotifyEvent& event) { observer[event.ObsIndex()]->AssertReady(event.SenderID()); }
void Dialect::Timer(void* msg) {}
