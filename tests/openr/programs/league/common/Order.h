#ifndef ORDER_H
#define ORDER_H
#include <OPENR/OPENR.h>
struct Order {
  long id;
  float pan;
  double when;
  char text[16];
};
class Config {
 public:
  static Config& instance();
  float get(const char* key, float dflt = 0.0);
  bool load(const char*);

 private:
  Config() {}
};
double now_s();
#endif
