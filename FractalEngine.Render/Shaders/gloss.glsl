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

vec3 fresnelOf(Gloss gloss, float cosine)
{
    float rest = clamp(1.0 - cosine, 0.0, 1.0);
    return gloss.specular + rest * rest * (rest * rest) * rest * (1.0 - gloss.specular);
}

#ifdef SURFACE_LIGHTS
// The slopes of the facet that mirrors a direction towards the eye, as a vector in the plane of the surface, by the roughness.
vec3 slopesOf(vec3 toLight, vec3 n, vec3 toEye)
{
    vec3 halfway = toEye + normalize(toLight);
    return (halfway / dot(n, halfway) - n) / material[1].w;
}

// What an edge adds to the facets within a polygon of slopes: their part w of all facets, and the sum of their slopes, w times the mean.
// GGX has the density 1 / (pi (1 + r^2)^2) of slopes. Of that, the triangle from the middle to the edge, whose line has the distance h,
// holds h / sqrt(1 + h^2) / (2 pi) times the difference of two arc tangents. The slopes are a gradient, and sum up along the edge.
vec4 facetsAlong(vec3 from, vec3 to, vec3 n)
{
    vec3 edge = to - from;
    float size = max(length(edge), 1e-12);
    edge /= size;
    float h = dot(n, cross(from, edge));
    float k2 = 1.0 + h * h;
    float angle = atan(size * sqrt(k2), k2 + dot(from, edge) * dot(to, edge));
    return inversesqrt(k2) * angle / (2.0 * pi) * vec4(cross(n, edge), h);
}

// What facets mirror once of a lamp that has a surface of the radiance 1. Facets are seen by the cosine of their angle with the eye, which
// is linear in their slopes, so that the sum above has them all; the rest is taken for the mean facet. Edges are straight between slopes,
// nearly.
vec3 mirroredOf(Light lamp, vec3 position, Gloss gloss, vec3 n, vec3 toEye)
{
    // A bent normal may turn away from the eye.
    toEye += (gloss.cosineEye - dot(n, toEye)) * n;
    Outline outline = outlineOf(lamp, position);
    vec4 facets = vec4(0.0);
    // Half of the points do for a small lamp. What is below the horizon is moved up to it.
    int step = max(dot(outline.right, outline.right), dot(outline.up, outline.up)) < 0.05 ? 2 : 1;
    vec3 last = outlinePoint(outline, 0, step);
    vec3 lastSlopes = slopesOf(last - min(dot(n, last), 0.0) * n, n, toEye);
    for (int i = step; i <= 16; i += step)
    {
        vec3 next = outlinePoint(outline, i, step);
        float lastHeight = dot(n, last);
        float height = dot(n, next);
        if ((lastHeight > 0.0) != (height > 0.0))
        {
            vec3 crossing = slopesOf(mix(last, next, lastHeight / (lastHeight - height)), n, toEye);
            facets += facetsAlong(lastSlopes, crossing, n);
            lastSlopes = crossing;
        }

        vec3 slopes = slopesOf(next - min(height, 0.0) * n, n, toEye);
        facets += facetsAlong(lastSlopes, slopes, n);
        last = next;
        lastSlopes = slopes;
    }

    facets *= facets.w < 0.0 ? -1.0 : 1.0;
    float alpha = material[1].w;
    float seen = max(facets.w + alpha * dot(toEye, facets.xyz) / gloss.cosineEye, 0.0);
    vec3 halfway = normalize(n + alpha / max(facets.w, 1e-6) * facets.xyz);
    float cosineFacet = clamp(dot(toEye, halfway), 0.0, 1.0);
    float cosine = 2.0 * cosineFacet * dot(n, halfway) - gloss.cosineEye;
    return seen * shadowing(gloss.cosineEye, alpha * alpha) * shadowing(max(cosine, 1e-4), alpha * alpha)
        * fresnelOf(gloss, cosineFacet);
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
    float once = alphaSquared / (d * d) * shadowing(gloss.cosineEye, alphaSquared) * shadowing(cosine, alphaSquared)
        / (4.0 * gloss.cosineEye);
    vec3 mirroredOnce = once * fresnelOf(gloss, dot(toLight, halfway));
#ifdef SURFACE_LIGHTS
    if (lamp.colour.w > 2.5)
    {
        mirroredOnce = mirroredOf(lamp, position, gloss, n, toEye) / max(fluxOf(lamp, position, n, toLight), 1e-30);
    }
#endif
    mirrored += incoming * (mirroredOnce + cosine * (1.0 - facets.x - facets.y) / material[5].w * gloss.several);
}

#ifdef PROBE
uniform samplerCube probe;       // Frame.ReflectionProbe: linear light times coverage, and coverage
uniform samplerCube probeDepths; // along the axis of each side

// How many times as far from the probe a place is as what the probe sees in its direction.
float farness(vec3 place)
{
    float inverseDepth = mix(probePlace.w, probeDepth.x, textureLod(probeDepths, place, 0.0).r);
    vec3 a = abs(place);
    return inverseDepth * max(a.x, max(a.y, a.z));
}

const float behind = 1.01; // by more than rounding
const float thick = 1.2;   // farther than most objects reach behind what is seen of them

// How far a ray is from its origin where it is seen from the probe by an angle to that.
float wayAt(float angle, float end, float size)
{
    return size * sin(angle) / max(sin(end - angle), 1e-4);
}

// What objects are mirrored, and how much of the light from all around they hide. The ray is followed to where it passes just behind what
// the probe sees, by steps of equal angles from there, then by halves. (L. Szirmay-Kalos and others, Computer Graphics Forum 24, 2005, go
// by distances instead, which misses what stands alone before a far background.)
vec4 mirroredObjects(vec3 position, vec3 r)
{
    vec3 origin = position - probePlace.xyz;
    float size = max(length(origin), 1e-30);
    float end = acos(clamp(dot(origin, r) / size, -1.0, 1.0));
    float way = wayAt(end, end, size);
    bool isHidden = true;
    for (int i = 1; i <= 24; i++)
    {
        float high = end * float(i) / 24.0;
        bool wasHidden = isHidden;
        isHidden = farness(origin + wayAt(high, end, size) * r) > behind;
        if (wasHidden || !isHidden)
        {
            continue;
        }

        float low = high - end / 24.0;
        for (int j = 0; j < 7; j++)
        {
            float middle = 0.5 * (low + high);
            bool isBeyond = farness(origin + wayAt(middle, end, size) * r) > behind;
            low = isBeyond ? low : middle;
            high = isBeyond ? middle : high;
        }

        way = wayAt(high, end, size);
        if (farness(origin + way * r) < thick)
        {
            break;
        }

        // The ray passes far behind what stands alone, and shows what the probe sees beside that.
        way = wayAt(end * (float(i) - 1.5) / 24.0, end, size);
    }

    vec3 hit = origin + way * r;
    // A texel of the level is about as wide as the lobe of the facets.
    float width = 4.0 * material[1].w * way / max(length(hit), 1e-30);
    return textureLod(probe, hit, max(log2(width * float(textureSize(probe, 0).x) / 1.5708), 0.0));
}
#endif

// What is mirrored of the light from all around, where nothing hides it, and of objects that a probe sees.
vec3 mirroredSurroundings(vec3 position, Gloss gloss, vec3 n, vec3 toEye, vec3 ambient)
{
    vec3 r = 2.0 * dot(n, toEye) * n - toEye;
    vec2 place = vec2(atan(r.z, r.x) / (2.0 * pi) + 0.5, acos(clamp(r.y, -1.0, 1.0)) / pi);
    vec3 seen = textureLod(surroundings, place, log2(material[1].w / minRoughness)).rgb;
#ifdef PROBE
    if (probeDepth.x > 0.0)
    {
        vec4 objects = mirroredObjects(position, r);
        seen = objects.rgb + (1.0 - objects.a) * seen;
    }
#endif
    return (gloss.facets.x * gloss.specular + gloss.facets.y) * seen + gloss.several * ambient;
}
