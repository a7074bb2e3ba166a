// From the light of the scene to that of the screen: haze, exposure and the tone curve. Behind lighting.glsl.

// The light that arrives from a surface through the haze.
vec3 throughHaze(vec3 light, float distance)
{
    return mix(fogColour.rgb, light, exp(-display.z * distance));
}

// Columns of the maps to and from the colours of S. Hill's fit.
const mat3 toAces = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
const mat3 fromAces = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
const vec3 luminanceOfSrgb = vec3(0.2126, 0.7152, 0.0722);

// Exposed light behind the tone curve that the scene asks for: display.y is 0 for none, 1 for the filmic one, 2 for Reinhard's and 3 for
// that of the Academy. Render.Lights.DisplayTransform has the same numbers, and whose they are.
vec3 toScreen(vec3 light)
{
    // Squares of larger ones would leave the range of a float.
    vec3 x = min(display.x * light, vec3(1e18));
    if (display.y > 2.5)
    {
        vec3 v = toAces * x;
        return clamp(fromAces * ((v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081)), 0.0, 1.0);
    }
    if (display.y > 1.5)
    {
        float luminance = dot(luminanceOfSrgb, x);
        return clamp((1.0 + luminance / 16.0) / (1.0 + luminance) * x, 0.0, 1.0);
    }
    vec3 filmic = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    return display.y > 0.5 ? filmic : x;
}

// The light of the scene that is shown as given light of the screen, from 0 to 1.
vec3 toScene(vec3 shown)
{
    if (display.y > 2.5)
    {
        vec3 y = inverse(fromAces) * shown;
        vec3 a = 1.0 - 0.983729 * y;
        vec3 b = 0.0245786 - 0.4329510 * y;
        return inverse(toAces) * ((sqrt(b * b + 4.0 * a * (0.000090537 + 0.238081 * y)) - b) / (2.0 * a)) / display.x;
    }
    if (display.y > 1.5)
    {
        float luminance = dot(luminanceOfSrgb, shown);
        float rest = 1.0 - luminance;
        return 2.0 / (rest + sqrt(rest * rest + luminance / 4.0)) * shown / display.x;
    }
    vec3 a = 2.51 - 2.43 * shown;
    vec3 b = 0.59 * shown - 0.03;
    return (display.y > 0.5 ? (b + sqrt(b * b + 0.56 * a * shown)) / (2.0 * a) : shown) / display.x;
}
