#version 300 es
precision highp float;
precision highp sampler2DShadow;
// What is known of the surface at a pixel: the light of lamps that it sends out, what it reflects of other light, and where it is.
const int maxLights = 16;
uniform int lightCount;
uniform vec4 lightColours[maxLights];   // w: 1 for a light with a position
uniform vec4 lightPositions[maxLights]; // relative to the camera, or towards the light; w: range
uniform vec4 lightAxes[maxLights];      // w: cosine where the edge of the cone ends
uniform float lightEdges[maxLights];    // cosine where it begins
uniform vec3 material[2];               // factors of ambient light, emitted light
uniform float opacity;
uniform float seed;
uniform sampler2D image;
uniform bool isTextured;
uniform mat4 keyMap;                    // from a point relative to the camera to the shadow map of the first light
uniform sampler2DShadow keyShadow;
uniform float texel;                    // of the map, in units
uniform vec4 fog;                       // w: density
in vec3 pixelPosition;
in vec3 pixelNormal;
in vec3 pixelColour;
in vec2 pixelPlace;
#ifdef FINAL
uniform vec3 above, below, curvature;   // ambient light
out vec4 fragment;                      // as the screen shows it, without shadows of the sky
#include tone.glsl
#else
layout(location = 0) out vec4 direct;   // w: 1
layout(location = 1) out vec4 reflected; // w: distance
layout(location = 2) out vec4 facing;   // unit normal; w: part of ambient light that is reflected
#endif
#include lit.glsl

void main() {
  // What is transparent is left out in a part of the frames, at each pixel in others (J. Jimenez, "Next Generation Post Processing in
  // Call of Duty: Advanced Warfare", 2014).
  if (opacity < 1.0 && fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))) + seed) >= opacity) discard;
  vec3 n = normalize(gl_FrontFacing ? pixelNormal : -pixelNormal);
  vec3 surface = pixelColour;
  if (isTextured) {
    vec4 shown = texture(image, pixelPlace);
    if (shown.a < 0.5) discard;
    surface *= shown.rgb;
  }
  vec3 light = vec3(0.0);
  for (int i = 0; i < lightCount; i++) {
    vec3 toLight = lightPositions[i].xyz;
    float strength = 1.0;
    if (lightColours[i].w > 0.5) {
      toLight -= pixelPosition;
      float distance = max(length(toLight), 1e-20), d = max(distance / lightPositions[i].w, 1e-4);
      toLight /= distance;
      float window = clamp(1.0 - d * d * d * d, 0.0, 1.0);
      strength = 0.01 / (d * d) * window * window * smoothstep(lightAxes[i].w, lightEdges[i], -dot(toLight, lightAxes[i].xyz));
    }
    float cosine = dot(n, toLight);
    if (cosine > 0.0 && strength > 0.0) {
      strength *= i == 0 ? litPart(keyShadow, keyMap, pixelPosition, n, texel, toLight) : 1.0;
      light += cosine * strength * lightColours[i].rgb;
    }
  }
  float clear = fog.w > 0.0 ? exp(-fog.w * length(pixelPosition)) : 1.0;
#ifdef FINAL
  light += material[0] * (mix(below, above, 0.5 + 0.5 * n.y) + n.y * n.y * curvature);
  fragment = vec4(encode(clamp(tone(mix(fog.rgb, surface * light + material[1], clear)), 0.0, 1.0)), 1.0);
#else
  direct = vec4(clear * (surface * light + material[1]) + (1.0 - clear) * fog.rgb, 1.0);
  reflected = vec4(clear * surface, length(pixelPosition));
  facing = vec4(n, dot(material[0], vec3(0.3333)));
#endif
}
