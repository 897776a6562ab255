// The robot's compiler knew "a <? b" and "a >? b", the lesser and the greater of two. They are read as
// "a <btr_least> b" and "a <btr_most> b", and mean the same by what stands here.
#ifndef BTR_OPENR_OLD_OPERATORS_H
#define BTR_OPENR_OLD_OPERATORS_H

static const struct btr_least_name {
} btr_least = {};
static const struct btr_most_name {
} btr_most = {};

template <class A>
struct btr_least_of {
  A& value;
};
template <class A>
struct btr_most_of {
  A& value;
};

template <class A>
inline btr_least_of<A> operator<(A& a, const btr_least_name&) {
  const btr_least_of<A> of = {a};
  return of;
}
template <class A>
inline btr_least_of<const A> operator<(const A& a, const btr_least_name&) {
  const btr_least_of<const A> of = {a};
  return of;
}
template <class A>
inline btr_most_of<A> operator<(A& a, const btr_most_name&) {
  const btr_most_of<A> of = {a};
  return of;
}
template <class A>
inline btr_most_of<const A> operator<(const A& a, const btr_most_name&) {
  const btr_most_of<const A> of = {a};
  return of;
}

template <class A, class B>
inline __decltype(true ? *(const A*)0 : *(const B*)0) operator>(const btr_least_of<A>& a, const B& b) {
  return b < a.value ? b : a.value;
}
template <class A, class B>
inline __decltype(true ? *(const A*)0 : *(const B*)0) operator>(const btr_most_of<A>& a, const B& b) {
  return a.value < b ? b : a.value;
}
template <class A, class B>
inline A& operator>=(const btr_least_of<A>& a, const B& b) {
  if (b < a.value) a.value = b;
  return a.value;
}
template <class A, class B>
inline A& operator>=(const btr_most_of<A>& a, const B& b) {
  if (a.value < b) a.value = b;
  return a.value;
}

#endif
