#version 300 es
precision highp float;
// The mean of the frames so far, as the screen shows it.
uniform sampler2D direct, reflected, sky;
uniform float frames;
uniform vec3 lamps;    // light of all lamps on what faces them
out vec4 fragment;
#include tone.glsl

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 first = texelFetch(direct, at, 0), third = texelFetch(sky, at, 0);
  vec3 light = first.rgb / frames, albedo = texelFetch(reflected, at, 0).rgb / frames;
  float covered = first.a / frames;
  if (covered > 0.0) {
    // In a hole, what hides the sky shines back what it gets: the sky that is seen, and a part of the lamps' light.
    float part = clamp(third.a / frames / covered, 0.0, 1.0);
    vec3 ambient = third.rgb / frames / covered, returned = (1.0 - part) * min(albedo / covered, 0.95);
    light += albedo * (part * ambient + returned * 0.2 * part * lamps) / (1.0 - returned);
  }
  vec3 shown = clamp(tone(light), 0.0, 1.0);
  if (background.w > 0.5) shown = mix(background.rgb, clamp(tone(light / max(covered, 1e-3)), 0.0, 1.0), covered);
  fragment = vec4(encode(shown), 1.0);
}
