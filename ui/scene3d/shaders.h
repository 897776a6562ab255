#pragma once

/// GLSL 1.20 programs of the 3D view: light per pixel from one sun, a hemisphere of sky and ground, and soft shadow
/// edges. Colours come in as pictures carry them (sRGB), are lit linearly, and go out as sRGB.
namespace btr::ui::shaders {

extern const char* const kMainVertex;
extern const char* const kMainFragment;  ///< calls shadowCoordinates and DynamicShadow of one of the next three pairs
extern const char* const kShadowVertex;
extern const char* const kShadowFragment;
extern const char* const kNoShadowVertex;
extern const char* const kNoShadowFragment;
extern const char* const kSunMapVertex;  ///< of a SunMap
extern const char* const kSunMapFragment;
extern const char* const kCastVertex;  ///< into a SunMap
extern const char* const kCastFragment;
extern const char* const kSkyVertex;
extern const char* const kSkyFragment;

}  // namespace btr::ui::shaders
