#include "Filer.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <fstream>
#include <iostream>
#include <string>

using namespace std;

Filer::Filer() { printf("constructed\n"); }

OStatus Filer::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;

  return oSUCCESS;
}

OStatus Filer::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  files();
  console();
  return oSUCCESS;
}

OStatus Filer::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Filer::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

static const char* answer(bool there) { return there ? "there" : "not there"; }

void Filer::files() {
  FILE* out = fopen("/MS/data.txt", "w");
  fprintf(out, "first line\n");
  fclose(out);
  ifstream in("/ms/DATA.txt");
  string line;
  getline(in, line);
  cout << "C++ reads " << line << endl;
  cout << "mkdir " << mkdir("/MS/SUB", 0777) << " rename " << rename("/MS/DATA.TXT", "/MS/SUB/NEW.TXT") << endl;
  struct stat info;
  cout << "stat " << stat("/MS/sub/new.txt", &info) << " " << info.st_size << endl;
  DIR* folder = opendir("/MS/SUB");
  for (struct dirent* entry = readdir(folder); entry != 0; entry = readdir(folder))
    if (entry->d_name[0] != '.') cout << "entry " << entry->d_name << endl;
  closedir(folder);
  const char* outside[] = {"/etc/passwd", "/MS/../secret.txt",   "/MS/SUB/../../secret.txt",
                           "secret.txt",  "/MS/LINK/secret.txt", "/MSX/a",
                           "/MS/LINK"};
  for (int i = 0; i < 7; i++) {
    FILE* file = fopen(outside[i], "r");
    ofstream written(outside[i]);
    cout << outside[i] << " " << answer(file != 0) << ", written " << written.is_open() << ", opened "
         << (open(outside[i], O_RDONLY) >= 0) << ", removed " << (unlink(outside[i]) == 0) << ", folder "
         << (opendir(outside[i]) != 0) << endl;
  }
  cout << "programs " << system("ls") << " " << (fork() < 0) << endl;
}

void Filer::console() {
  const time_t start = time(0);
  cout << "name? ";
  char line[80];
  gets(line);
  cout << "hello " << line << endl;
  int number = 0;
  scanf("%d", &number);
  string word;
  cin >> word;
  cout << number << " " << word << endl;
  sleep(2);
  cout << "slept " << time(0) - start << endl;
  printf("partly");
  exit(3);
  printf("never");
}
