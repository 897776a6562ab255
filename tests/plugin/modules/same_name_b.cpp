#include "tests/plugin/modules/empty_effect.h"

BTR_EFFECT(EmptyEffect, "same_name")
