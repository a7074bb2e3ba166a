#version 300 es
precision highp float;
// The mean of the frames so far, as the screen shows it.
uniform sampler2D direct, reflected, sky;
uniform float frames;
uniform vec3 display;  // tone, exposure
uniform vec3 lamps;    // light of all lamps on what faces them
uniform vec4 background; // as it is shown, in linear light; w: 0 for the sky instead
out vec4 fragment;

vec3 tone(vec3 x) {
  x *= display.y;
  if (display.x > 2.5) {
    vec3 v = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777) * x;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602) * v;
  }
  if (display.x > 1.5) {
    float luminance = dot(vec3(0.2126, 0.7152, 0.0722), x);
    return (1.0 + luminance / 16.0) / (1.0 + luminance) * x;
  }
  return display.x > 0.5 ? x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14) : x;
}

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
  fragment = vec4(mix(12.92 * shown, 1.055 * pow(shown, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, shown)), 1.0);
}
