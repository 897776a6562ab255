#include "ui/scene3d/shaders.h"

namespace btr::ui::shaders {

const char* const kMainVertex = R"(#version 120
varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec2 ground;
void shadowCoordinates(vec4 position);
void main() {
  vec4 position = gl_ModelViewMatrix * gl_Vertex;
  eyePosition = position.xyz;
  eyeNormal = gl_NormalMatrix * gl_Normal;
  ground = gl_Vertex.xy;
  gl_FrontColor = gl_Color;
  gl_BackColor = gl_Color;
  shadowCoordinates(position);
  gl_Position = ftransform();
}
)";

// MEASURED gives plain carpets (their grain costs half of the time of a software driver, which computes both sides of
// an if), linear light, and in alpha the number of the object (`identity`; 0: translucent, alpha is opacity). opacity:
// of surfaces, 1; gloss: strength of the highlight; unlit: 1 shows the colour as it is; fade: distance from the world's
// z axis at which a ground sinks into the horizon (0: never); weave: strength of the carpet's grain.
const char* const kMainFragment = R"(#version 120
uniform vec3 skyTop;
uniform vec3 skyHorizon;
uniform vec2 viewport;
uniform vec3 up;
uniform float gloss;
uniform float unlit;
uniform float fade;
uniform float weave;
uniform float identity;
uniform float opacity;
varying vec3 eyePosition;
varying vec3 eyeNormal;
varying vec2 ground;
float DynamicShadow();
#ifndef MEASURED
float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
float grain(vec2 p) {
  vec2 cell = floor(p);
  vec2 f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(cell), hash(cell + vec2(1.0, 0.0)), f.x),
             mix(hash(cell + vec2(0.0, 1.0)), hash(cell + vec2(1.0, 1.0)), f.x), f.y);
}
vec4 told(vec4 colour) { return colour; }
#else
vec4 told(vec4 colour) { return vec4(colour.rgb * colour.rgb, identity > 0.5 ? identity : colour.a); }
#endif
void main() {
  if (unlit > 0.5) {
    gl_FragColor = told(gl_Color);
    return;
  }
  // Squares and square roots stand for the exponent 2.2: cheaper where software draws.
  vec3 albedo = gl_Color.rgb * gl_Color.rgb;
#ifndef MEASURED
  if (weave > 0.0) {
    float pixel = max(length(dFdx(ground)), length(dFdy(ground)));
    float near = clamp(0.004 / pixel - 0.6, 0.0, 1.0);
    float fine = near > 0.0 ? near * (grain(ground * 260.0) - 0.5) : 0.0;
    albedo *= 1.0 + weave * (1.3 * fine + 0.35 * (grain(ground * 9.0) - 0.5));
  }
#endif
  vec3 normal = normalize(eyeNormal);
  vec3 toEye = normalize(-eyePosition);
  if (dot(normal, toEye) < 0.0) normal = -normal;
  vec3 toSun = normalize(gl_LightSource[0].position.xyz);
  float sun = dot(normal, toSun);
  float lit = sun > 0.0 ? DynamicShadow() * smoothstep(0.0, 0.12, sun) : 0.0;
  vec3 sky = mix(vec3(0.24, 0.24, 0.23), vec3(0.44, 0.46, 0.49), 0.5 + 0.5 * dot(normal, up));
  float facing = max(0.0, dot(normal, toEye));
  vec3 linear = albedo * (sky + 0.12 * facing + lit * max(sun, 0.0) * vec3(0.74, 0.71, 0.66));
  if (gloss > 0.0) {
    float shine = max(0.0, dot(normal, normalize(toSun + toEye)));
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    float rim = (1.0 - facing) * (1.0 - facing);
    linear += gloss * (lit * shine + 0.22 * rim * rim * sky);
  }
  // A soft shoulder keeps form in white plastic under full sun.
  vec3 over = max(linear - 0.65, 0.0);
  linear = min(linear, 0.65) + 0.45 * over / (over + 0.45);
  vec3 colour = sqrt(linear);
  if (fade > 0.0) {
    float height = gl_FragCoord.y / viewport.y;
    vec3 background = mix(skyHorizon, skyTop, smoothstep(0.35, 1.0, height));
    colour = mix(colour, background, smoothstep(0.25 * fade, fade, length(ground)));
  }
  gl_FragColor = told(vec4(colour, gl_Color.a * opacity));
}
)";

const char* const kShadowVertex = R"(#version 120
void shadowCoordinates(vec4 position) {
  gl_TexCoord[1] = vec4(dot(position, gl_EyePlaneS[1]), dot(position, gl_EyePlaneT[1]),
                        dot(position, gl_EyePlaneR[1]), dot(position, gl_EyePlaneQ[1]));
}
)";

// Four taps, each a bilinear comparison, soften the edge over about three texels.
const char* const kShadowFragment = R"(#version 120
uniform sampler2DShadow shadowTexture;
uniform float shadowTexel;
float DynamicShadow() {
  vec3 centre = gl_TexCoord[1].xyz / gl_TexCoord[1].w;
  vec2 d = 0.75 * vec2(shadowTexel, -shadowTexel);
  return 0.25 * (shadow2D(shadowTexture, centre + vec3(d.xx, 0.0)).r + shadow2D(shadowTexture, centre + vec3(d.xy, 0.0)).r +
                 shadow2D(shadowTexture, centre + vec3(d.yx, 0.0)).r + shadow2D(shadowTexture, centre + vec3(d.yy, 0.0)).r);
}
)";

const char* const kNoShadowVertex = R"(#version 120
void shadowCoordinates(vec4 position) {}
)";

const char* const kNoShadowFragment = R"(#version 120
float DynamicShadow() { return 1.0; }
)";

const char* const kSunMapVertex = R"(#version 120
uniform mat4 toSunMap;
varying vec3 inSunMap;
void shadowCoordinates(vec4 position) { inSunMap = (toSunMap * position).xyz; }
)";

// Two taps, each a bilinear comparison: four take a quarter longer for the whole picture.
const char* const kSunMapFragment = R"(#version 120
uniform sampler2DShadow sunMap;
uniform float sunTexel;
varying vec3 inSunMap;
float DynamicShadow() {
  vec3 d = vec3(0.6 * sunTexel, 0.6 * sunTexel, 0.0);
  return 0.5 * (shadow2D(sunMap, inSunMap + d).r + shadow2D(sunMap, inSunMap - d).r);
}
)";

const char* const kCastVertex = R"(#version 120
void main() { gl_Position = ftransform(); }
)";

const char* const kCastFragment = R"(#version 120
void main() {}
)";

const char* const kSkyVertex = R"(#version 120
varying float height;
void main() {
  height = 0.5 * gl_Vertex.y + 0.5;
  gl_Position = vec4(gl_Vertex.xy, 1.0, 1.0);
}
)";

const char* const kSkyFragment = R"(#version 120
uniform vec3 skyTop;
uniform vec3 skyHorizon;
varying float height;
void main() {
  vec3 colour = mix(skyHorizon, skyTop, smoothstep(0.35, 1.0, height));
#ifdef MEASURED
  gl_FragColor = vec4(colour * colour, 0.0);
#else
  gl_FragColor = vec4(colour, 1.0);
#endif
}
)";

}  // namespace btr::ui::shaders
