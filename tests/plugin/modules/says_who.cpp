#include "tests/plugin/modules/empty_effect.h"

BTR_EFFECT(EmptyEffect, "says_who", .version = "1.2", .author = "J. Doe, Zürich", .licence = "MIT")
