#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include "Idiom.h"
#include "entry.h"
Idiom::Idiom() {}
OStatus Idiom::DoInit(const OSystemEvent& event) {
 NEW_ALL_SUBJECT_AND_OBSERVER; REGISTER_ALL_ENTRY; SET_ALL_READY_AND_NOTIFY_ENTRY;
 return oSUCCESS; }
OStatus Idiom::DoStart(const OSystemEvent& event) {
 go(); machine();
 ENABLE_ALL_SUBJECT; ASSERT_READY_TO_ALL_OBSERVER;
 return oSUCCESS; }
OStatus Idiom::DoStop(const OSystemEvent& event) {
 DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Idiom::DoDestroy(const OSystemEvent& event) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }
using namespace std;
const int answer = 42;
class Node { public: friend class Tree; Node() : next(0), v(1) {} private: Node* next; int v; Tree* owner; };
class Tree { public: Node n; int get() { return n.v; } };
template <class T> class Vec2 { public: T x, y; Vec2(T a = 0, T b = 0) : x(a), y(b) {} friend Vec2 operator+(const Vec2& a, const Vec2& b) { return Vec2(a.x + b.x, a.y + b.y); } T len() const; static int count; };
template <class T> T Vec2<T>::len() const { return sqrt(x * x + y * y); }
int Vec2<double>::count = 3;
template <class T, int N> class Buf : public vector<T> { public: Buf() { resize(N); } T sum() { T s = 0; for (int i = 0; i < size(); i++) s += (*this)[i]; return s + at(0); } typename vector<T>::iterator first() { return begin(); } };
template <class K> struct Tab { typedef map<K, int> M; M m; int total() { int t = 0; for (M::iterator i = m.begin(); i != m.end(); ++i) t += i->second; return t; } M::const_iterator f() const { return m.begin(); } };
template <class T> class Stack : public list<T> { public: void put(const T& t) { push_back(t); } T take() { T t = back(); pop_back(); return t; } };
struct P { int x; double y; };
union U { struct { byte lo, hi; }; word w; };
typedef struct { longword a; word b; byte c; } __attribute__((packed)) Packed;
static int used_later(int);
enum Color { RED, GREEN, BLUE, };
inline int clip(int v, int lo = 0, int hi = 255) { return v < lo ? lo : v > hi ? hi : v; };
namespace util { int twice(int x) { return 2 * x; } };
class Shape { public: virtual int area() = 0; virtual ~Shape() {}; };
class Sq : public Shape { public: int a; Sq(int b) : a(b) {}; virtual int area() { return a * a; }; };
static Sq global_sq(7);
static map<string, Shape*> registry;
struct Reg { Reg(const char* n, Shape* s) { registry[n] = s; } };
static Reg reg("sq", &global_sq);
void show(P* p) { printf("P %d %g\n", p->x, p->y); }
void Idiom::go() {
  Tree t; Vec2<double> a(3, 4), b = a + Vec2<double>(0, 0);
  Buf<int, 4> buf; Tab<string> tab; tab.m["x"] = 5; Stack<int> st; st.put(4); st.put(9);
  P p = { x: 3, y: 2.5 }; show(&p); show(&(P){4, 1.5});
  U u; u.w = 0x1234; 
  printf("%d %d %g %d %d %d %d %x %d\n", answer, t.get(), b.len(), Vec2<double>::count, buf.sum(), tab.total(), st.take(), u.lo, (int)sizeof(Packed));
  asm volatile("sync"); asm("pref 0, 0(%0)" : : "r" (&p));
  printf("%d %d %d %s\n", clip(300), util::twice(4), registry["sq"]->area(), __PRETTY_FUNCTION__);
  Color c = (Color)1; c = Color(c + 1); int ci = c; 
  unsigned char* q = (unsigned char*)&p; 
  for (int i = 0; i < 3; i++) { if (i == 2) break; }
  printf("i %d ci %d %d\n", i, ci, used_later(3));
 
  double z = isnan(0.0) || finite(2.0) ? rint(2.5) : 0; float fz = fabsf(-2.0f); printf("%g %g %d\n", z, fz, abs(-3));
  typeof(z) zz = z; int arr[ci]; arr[0] = 1; 
  switch (ci) { case 2: string s = "in case"; printf("%s %d\n", s.c_str(), strcasecmp("A", "a")); break; }
  char* str = strdup("tok,en"); char* tk = strtok(str, ","); printf("%s\n", tk); bzero(str, 3);
  const char* const names[] = { "a", "b", 0 }; int k = 0; while (names[k]) k++; printf("k %d %s\n", k, k > 1 ? "more" : "less");
  slongword neg = -5; longword big = 0xfffffff0; long robots = -6; char text[40];
  sprintf(text, "%ld|%4ld|%-4ld|%+ld|%lx", neg, neg, robots, neg, big); printf("%s %lu %lf %lld %ld%%\n", text, big, 1.5, 1LL << 40, neg);
  OSYSPRINT(("long %ld %d %s\n", neg, neg, "end"));
  longword lw = -1; if (lw == UNDEF) printf("undef\n"); 
  void (Idiom::*fp)() = &Idiom::go; 
}
static int used_later(int x) { return x + answer; }
