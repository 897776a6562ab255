#ifndef def_h_DEFINED
#define def_h_DEFINED
const char* const objectName = "Relay";
const int numOfSubject = 1, numOfObserver = 1;
const char* const subjectService[] = {"Relay.Out.char.S"};
const char* const observerService[] = {"Relay.In.char.O"};
const int sbjOut = 0;
const int obsIn = 0;
#endif
