#ifndef OLD_H
#define OLD_H
// K&R style and C glue
#ifdef __cplusplus
extern "C" {
#endif
int old_sum(int, int);
void say(char* text);
void scanned();
struct old_point {
  int x, y;
};
typedef struct old_point point;
#ifdef __cplusplus
}
#endif
#endif
