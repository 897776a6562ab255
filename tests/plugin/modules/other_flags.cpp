// Built several times, each with an option that a plugin may not have (tests/CMakeLists.txt).
#include "tests/plugin/modules/empty_effect.h"

BTR_EFFECT(EmptyEffect, MODULE_NAME)
