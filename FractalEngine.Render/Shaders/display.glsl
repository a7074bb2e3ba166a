// From the light of the scene to that of the screen: haze, exposure and the tone curve. Behind lighting.glsl.

// The light that arrives from a surface through the haze.
vec3 throughHaze(vec3 light, float distance)
{
    return mix(fogColour.rgb, light, exp(-display.z * distance));
}

// Exposed light behind the curve of K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016, where the scene asks for it.
vec3 toScreen(vec3 light)
{
    // Squares of larger ones would leave the range of a float.
    vec3 x = min(display.x * light, vec3(1e18));
    vec3 filmic = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    return display.y > 0.5 ? filmic : x;
}

// The light of the scene that is shown as given light of the screen, from 0 to 1.
vec3 toScene(vec3 shown)
{
    vec3 a = 2.51 - 2.43 * shown;
    vec3 b = 0.59 * shown - 0.03;
    return (display.y > 0.5 ? (b + sqrt(b * b + 0.56 * a * shown)) / (2.0 * a) : shown) / display.x;
}
