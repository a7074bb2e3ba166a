uniform vec3 display;    // tone and exposure
uniform vec4 background; // as it is shown, in linear light; w: 0 for the sky instead

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

// Linear light of the screen as it stores it (IEC 61966-2-1), while things move within a step or two of 256.
vec3 encode(vec3 x) {
#ifdef FINAL
  vec3 a = sqrt(x), b = sqrt(a);
  return max(1.055 * (0.58324 * a + 0.6026 * b - 0.18584 * sqrt(b)) - 0.055, 0.0);
#else
  return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
#endif
}
