// What a glossy surface does with light, as Render.Lights.Gloss and Tracing.Reflection have it. Behind material.glsl and
// lighting.glsl.

uniform sampler2D facetAlbedo;  // Render.Lights.FacetAlbedo
uniform sampler2D surroundings; // Render.Lights.Surroundings, mirrored by rougher facets level by level

const float facetSteps = 31.0;    // FacetAlbedo.TableSize - 1
const float minRoughness = 0.02;  // FacetAlbedo.MinRoughness
const float pi = 3.14159265;

// A surface as the eye sees it.
struct Gloss
{
    vec3 scattered;  // of light that has come through the coat
    vec3 specular;   // mirrored by a facet that the light falls straight onto
    vec3 several;    // reflected by several facets, of light that is not sent out at once
    vec2 facets;     // of FacetAlbedo
    float cosineEye;
};

vec2 facetsSeenFrom(float cosine)
{
    vec2 position = vec2(sqrt(clamp(cosine, 0.0, 1.0)), (sqrt(material[1].w) - sqrt(minRoughness)) / (1.0 - sqrt(minRoughness)));
    return textureLod(facetAlbedo, (position * facetSteps + 0.5) / (facetSteps + 1.0), 0.0).rg;
}

vec3 throughCoat(vec2 facets)
{
    return 1.0 - (facets.x * material[1].rgb + facets.y + (1.0 - facets.x - facets.y) * material[5].rgb);
}

Gloss glossOf(vec3 colour, vec3 n, vec3 toEye)
{
    Gloss gloss;
    float metalness = material[4].w;
    gloss.cosineEye = max(dot(n, toEye), 1e-4);
    gloss.facets = facetsSeenFrom(gloss.cosineEye);
    gloss.scattered = (1.0 - metalness) * colour * throughCoat(gloss.facets);
    gloss.specular = mix(material[1].rgb, colour, metalness);
    vec3 facet = colour + (1.0 - colour) / 21.0;
    vec3 ofMetal = facet * facet * (1.0 - material[5].w) / (1.0 - facet * material[5].w);
    gloss.several = (1.0 - gloss.facets.x - gloss.facets.y) * mix(material[5].rgb, ofMetal, metalness);
    return gloss;
}

float shadowing(float cosine, float alphaSquared)
{
    return 2.0 * cosine / (cosine + sqrt(alphaSquared + (1.0 - alphaSquared) * cosine * cosine));
}

#ifdef SURFACE_LIGHTS
// The slopes of the facet that mirrors a direction towards the eye, as a vector in the plane of the surface, by the roughness.
vec3 slopesOf(vec3 toLight, vec3 n, vec3 toEye)
{
    vec3 halfway = toEye + normalize(toLight);
    return (halfway / dot(n, halfway) - n) / material[1].w;
}

// What an edge adds to a part of GGX. The slopes of its facets have the density 1 / (pi (1 + r^2)^2), of which a triangle from the middle
// to the edge, whose line has the distance h, holds h / sqrt(1 + h^2) / (2 pi) times the difference of two arc tangents.
float partOfFacets(vec3 from, vec3 to, vec3 n)
{
    vec3 edge = to - from;
    float size = max(length(edge), 1e-12);
    float h = dot(n, cross(from, to)) / size;
    float k2 = 1.0 + h * h;
    float k = sqrt(k2);
    return h / k * atan(size * k, k2 + dot(from, edge) / size * (dot(to, edge) / size)) / (2.0 * pi);
}

// The part of the facets that mirrors the surface of a lamp towards the eye. Its edges are straight lines between slopes, nearly.
float partThatMirrors(Light lamp, vec3 position, vec3 n, vec3 toEye)
{
    Outline outline = outlineOf(lamp, position);
    float sum = 0.0;
    vec3 setting = vec3(0.0);
    vec3 rising = vec3(0.0);
    for (int i = 0; i < 8; i++)
    {
        vec2 p = outlinePoints[i];
        vec2 q = outlinePoints[(i + 1) & 7];
        // An octagon of the area of a circle.
        p *= outline.isRound ? 1.0539 / length(p) : 1.0;
        q *= outline.isRound ? 1.0539 / length(q) : 1.0;
        vec3 from = outline.centre + p.x * outline.right + p.y * outline.up;
        vec3 to = outline.centre + q.x * outline.right + q.y * outline.up;
        if (cutAtHorizon(n, from, to, setting, rising))
        {
            sum += partOfFacets(slopesOf(from, n, toEye), slopesOf(to, n, toEye), n);
        }
    }

    if (dot(setting, setting) > 0.0 && dot(rising, rising) > 0.0)
    {
        sum += partOfFacets(slopesOf(setting, n, toEye), slopesOf(rising, n, toEye), n);
    }

    return clamp(abs(sum), 0.0, 1.0);
}
#endif

// Adds the light of a lamp that falls onto the surface by a cosine: what comes through the coat, and what is mirrored.
void addGloss(
    Light lamp, vec3 position, Gloss gloss, vec3 n, vec3 toEye, vec3 toLight, float cosine, vec3 incoming, inout vec3 light,
    inout vec3 mirrored)
{
    vec2 facets = facetsSeenFrom(cosine);
    light += cosine * incoming * throughCoat(facets) / material[6].rgb;
    vec3 halfway = direction(toEye + toLight);
    float alphaSquared = material[1].w * material[1].w;
    // Of the sine: near 1, squares of cosines have no digits left.
    vec3 sine = cross(n, halfway);
    float cosineHalf = dot(n, halfway);
    float d = cosineHalf * cosineHalf * alphaSquared + dot(sine, sine);
    float rest = clamp(1.0 - dot(toLight, halfway), 0.0, 1.0);
    vec3 fresnel = gloss.specular + rest * rest * (rest * rest) * rest * (1.0 - gloss.specular);
    float once = alphaSquared / (d * d) * shadowing(gloss.cosineEye, alphaSquared) * shadowing(cosine, alphaSquared)
        / (4.0 * gloss.cosineEye);
    vec3 mirroredOnce = once * fresnel;
#ifdef SURFACE_LIGHTS
    if (lamp.colour.w > 2.5)
    {
        float part = partThatMirrors(lamp, position, n, toEye);
        // A small lamp is mirrored as its middle is; what fills all that facets mirror, as the sky is.
        float factor = shadowing(gloss.cosineEye, alphaSquared) * shadowing(cosine, alphaSquared) * dot(toLight, halfway)
            / (cosineHalf * gloss.cosineEye);
        vec3 of = mix(factor * fresnel, gloss.facets.x * gloss.specular + gloss.facets.y, part);
        mirroredOnce = part * of / max(fluxOf(lamp, position, n, toLight), 1e-30);
    }
#endif
    mirrored += incoming * (mirroredOnce + cosine * (1.0 - facets.x - facets.y) / material[5].w * gloss.several);
}

// What is mirrored of the light from all around, where nothing hides it.
vec3 mirroredSurroundings(Gloss gloss, vec3 n, vec3 toEye, vec3 ambient)
{
    vec3 r = 2.0 * dot(n, toEye) * n - toEye;
    vec2 place = vec2(atan(r.z, r.x) / (2.0 * pi) + 0.5, acos(clamp(r.y, -1.0, 1.0)) / pi);
    vec3 seen = textureLod(surroundings, place, log2(material[1].w / minRoughness)).rgb;
    return (gloss.facets.x * gloss.specular + gloss.facets.y) * seen + gloss.several * ambient;
}
