#include <map>
#include <hash_map>
#include <slist.h>
#include <vector>
#include <string>
#include <algorithm>
#include <functional>
#include <strstream>
#include <sstream>
#include <ext/hash_set>
#include <stdio.h>
#include <math.h>
#include <values.h>
#include <limits.h>
#include <float.h>
using namespace std;
template<class T> class Ring {
 public:
  typedef vector<T> store;
  Ring() : head(0) {}
  void add(const T& t) { data.push_back(t); }
  T total() { T t = 0; store::iterator it; for (it = data.begin(); it != data.end(); it++) t += *it; return t; }
  int head;
  store data;
};
template<class T> struct Base { T v; int n; void reset() { n = 0; } };
template<class T> struct Derived : public Base<T> { void go() { v = 3; n = 4; reset(); n++; } };
class eqstr { public: bool operator()(const char* a, const char* b) const { return strcmp(a,b)==0; } };
int stl_test() {
  map<string,int> m; m["a"] = 1; m["b"]=2;
  __gnu_cxx::hash_map<int,int> h; h[3] = 4;
  Ring<double> r; r.add(1); r.add(2.5);
  Derived<double> d; d.go();
  vector<int> v; v.push_back(3); v.push_back(1);
  sort(v.begin(), v.end());
  int sum = 0;
  for (map<string,int>::iterator i = m.begin(); i != m.end(); ++i) sum += i->second;
  for (int k = 0; k < 3; k++) sum += k;
  for (int k = 0; k < 3; k++) sum += k;
  ostrstream o; o << "x " << sum << ends; 
  char buf[32]; ostrstream fixed(buf, sizeof buf); fixed << 12 << ends;
  char* s = o.str();
  printf("stl %s %s %d %g %g %g %d\n", s, buf, v[0], r.total(), d.v, MAXFLOAT > 1 ? 1.0 : 0, min(3, 4));
  o.freeze(0);
  int x = isnan(1.0) ? 1 : 0;
  return sum + x;
}
