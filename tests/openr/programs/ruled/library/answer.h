extern "C" int answer(void);
