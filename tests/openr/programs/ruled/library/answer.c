/* C of old. */
int answer() { return 42; }
