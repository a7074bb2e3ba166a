#version 300 es
precision highp float;
uniform mat3 fromCamera;
uniform vec2 slopes;
uniform vec3 zenith, horizon, ground;
in vec2 corner;
#ifdef FINAL
out vec4 fragment;
#include tone.glsl
#else
layout(location = 0) out vec4 direct;
layout(location = 1) out vec4 reflected;
layout(location = 2) out vec4 facing;
#endif

void main() {
  float y = normalize(fromCamera * vec3(corner * slopes, 1.0)).y;
  vec3 light = y >= 0.0 ? mix(horizon, zenith, y) : mix(horizon, ground, sqrt(-y));
#ifdef FINAL
  fragment = vec4(encode(background.w > 0.5 ? background.rgb : clamp(tone(light), 0.0, 1.0)), 1.0);
#else
  direct = vec4(light, 0.0);
  reflected = vec4(0.0);
  facing = vec4(0.0);
#endif
}
