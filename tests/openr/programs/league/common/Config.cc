#include <OPENR/core_macro.h>
#include "Order.h"
#include <map>
#include <string>
#include <fstream>
#include <MCOOP.h>
using namespace std;
static map<string, float> values;
Config& Config::instance() { static Config c; return c; }
bool Config::load(const char* name) {
  ifstream in(name);
  if (!in) return false;
  string k; float v;
  while (in >> k >> v) values[k] = v;
  return true;
}
float Config::get(const char* key, float d) { map<string,float>::const_iterator i = values.find(key); return i == values.end() ? d : i->second; }
double now_s() { SystemTime t; GetSystemTime(&t); return t.seconds + t.useconds / 1e6; }
