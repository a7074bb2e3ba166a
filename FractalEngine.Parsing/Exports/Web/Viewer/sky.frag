#version 300 es
precision highp float;
uniform mat3 fromCamera;
uniform vec2 slopes;
uniform vec3 zenith, horizon, ground;
in vec2 corner;
layout(location = 0) out vec4 direct;
layout(location = 1) out vec4 reflected;
layout(location = 2) out vec4 facing;
void main() {
  float y = normalize(fromCamera * vec3(corner * slopes, 1.0)).y;
  direct = vec4(y >= 0.0 ? mix(horizon, zenith, y) : mix(horizon, ground, sqrt(-y)), 0.0);
  reflected = vec4(0.0);
  facing = vec4(0.0);
}
