// Of a former try: does not compile, and nobody asks for it.
#include "no_such_header.h"
