// The system's <time.h>, and the same for programs in which a long has 32 bits, as the robot's time_t had.
#ifndef BTR_TIME_H
#define BTR_TIME_H
#include_next <time.h>
#ifdef __cplusplus
// As templates: time(NULL) and a pointer to a time_t are the system's.
template <class T>
inline time_t time(T* now) {
  const time_t time_ = ::time((time_t*)0);
  if (now) *now = (T)time_;
  return time_;
}
template <class T>
inline char* ctime(const T* then) {
  const time_t time_ = *then;
  return ::ctime(&time_);
}
template <class T>
inline struct tm* gmtime(const T* then) {
  const time_t time_ = *then;
  return ::gmtime(&time_);
}
template <class T>
inline struct tm* localtime(const T* then) {
  const time_t time_ = *then;
  return ::localtime(&time_);
}
#endif
#endif
