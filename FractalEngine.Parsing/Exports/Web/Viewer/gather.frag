#version 300 es
precision highp float;
precision highp sampler2DShadow;
// Adds a frame to the sum of those before, with the shadows of one direction of the sky.
uniform sampler2D direct, reflected, facing;
uniform mat3 fromCamera;
uniform vec2 slopes;
uniform vec3 above, below, curvature;   // ambient light
uniform mat4 skyMap;                    // from a point relative to the camera to the shadow map of the direction
uniform sampler2DShadow skyShadow;
uniform float texel;
uniform vec4 skyDirection;              // w: 1 where there is a map
uniform vec3 skyRadiance;
in vec2 corner;
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 sky;      // w: the part of it that is seen

#include lit.glsl

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  first = texelFetch(direct, at, 0);
  second = texelFetch(reflected, at, 0);
  vec4 surface = texelFetch(facing, at, 0);
  sky = vec4(0.0);
  if (first.a == 0.0) return;
  vec3 n = surface.xyz, ambient = surface.w * max(mix(below, above, 0.5 + 0.5 * n.y) + n.y * n.y * curvature, 0.0);
  float part = 1.0, cosine = dot(n, skyDirection.xyz);
  if (skyDirection.w > 0.5 && cosine > 0.0) {
    // Of a direction, among many even ones: what it brings is missing where it is hidden, and all else is there.
    vec3 position = second.w * normalize(fromCamera * vec3(corner * slopes, 1.0));
    float hidden = 1.0 - litPart(skyShadow, skyMap, position, n, texel, skyDirection.xyz);
    part -= 4.0 * cosine * hidden * dot(skyRadiance, vec3(1.0)) / max(dot(ambient, vec3(1.0)), 1e-6);
  }
  sky = vec4(ambient, part);
}
