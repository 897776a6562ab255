#include "Widths.h"

class Writer {
 public:
  Writer(char* text) : to(text) { *to = 0; }
  Writer& operator<<(int) {
    strcat(to, "int ");
    return *this;
  }
  Writer& operator<<(long) {
    strcat(to, "long ");
    return *this;
  }

 private:
  char* to;
};
void overloads(char* text, Percept& percept) {
  long number = 3;
  Writer writer(text);
  writer << 3 << number;
  percept.time = 5;
  percept.x = 100;
  percept.y = -200;
  percept.confidence = 0.5f;
}
