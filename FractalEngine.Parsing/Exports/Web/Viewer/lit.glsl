// How much of a parallel light arrives at a surface. The place of comparison lies a little before the surface.
float litPart(sampler2DShadow map, mat4 toMap, vec3 position, vec3 n, float texel, vec3 toLight) {
  float slant = 1.0 - clamp(dot(n, toLight), 0.0, 1.0);
  vec3 at = (toMap * vec4(position + n * texel * (0.6 + slant) + toLight * texel * 0.5, 1.0)).xyz;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
  return texture(map, at);
}
