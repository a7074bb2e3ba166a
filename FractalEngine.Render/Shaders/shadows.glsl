// Which part of a light arrives at a surface: the depth maps of all lights lie in one texture.
const int maxShadowViews = 32; // ShadowFit.MaxViews

struct ShadowView
{
    vec4 across;    // from a point relative to the camera to texels of the atlas, times w
    vec4 down;
    vec4 depth;     // to the depth, times w; greater is closer to the light
    vec4 w;
    vec4 bounds;    // first and last texel that has neighbours in the map
    vec4 offset;    // x: distance towards the light, scene units; y: likewise, per w; zw: squared ratio of depth to texels, without w
};

layout(std140) uniform ShadowBlock
{
    ivec4 shadowRanges[16]; // of each light: its first view, and their number
    ShadowView shadowViews[maxShadowViews];
};

uniform sampler2D shadowMap;

// The unit normal of the triangle itself, on the side of the eye.
vec3 faceNormalTowardsEye(vec3 position, vec3 toEye, vec3 smoothNormal)
{
    vec3 normal = direction(cross(dFdx(position), dFdy(position)));
    normal = dot(normal, normal) > 0.0 ? normal : smoothNormal;
    return dot(normal, toEye) < 0.0 ? -normal : normal;
}

// The lit part of the four texels around a point. Each is compared with the depth that the surface's plane has there, so that a slanted
// surface does not shade itself.
float litPart(ShadowView view, vec3 texel, vec2 slope)
{
    vec2 corner = floor(texel.xy - 0.5);
    vec2 part = texel.xy - 0.5 - corner;
#ifdef GL_ARB_texture_gather
    vec4 stored = textureGather(shadowMap, (corner + 1.0) / vec2(textureSize(shadowMap, 0))).wzxy;
#else
    ivec2 first = ivec2(corner);
    vec4 stored = vec4(
        texelFetch(shadowMap, first, 0).r, texelFetch(shadowMap, first + ivec2(1, 0), 0).r,
        texelFetch(shadowMap, first + ivec2(0, 1), 0).r, texelFetch(shadowMap, first + ivec2(1, 1), 0).r);
#endif
    float depth = texel.z - dot(slope, part);
    vec4 lit = step(stored, vec4(depth, depth + slope.x, depth + slope.y, depth + slope.x + slope.y));
    vec2 rows = mix(lit.xz, lit.yw, part.x);
    return mix(rows.x, rows.y, part.y);
}

// How much the depth changes from texel to texel along a plane.
vec2 depthSlope(ShadowView view, vec3 texel, vec3 normal)
{
#ifndef POINT_SHADOWS
    // The rows are at right angles to each other.
    float along = dot(view.depth.xyz, normal);
    return -view.offset.zw * vec2(dot(view.across.xyz, normal), dot(view.down.xyz, normal)) / along;
#else
    vec3 tangent = normalize(abs(normal.x) > 0.7 ? cross(normal, vec3(0.0, 1.0, 0.0)) : cross(normal, vec3(1.0, 0.0, 0.0)));
    vec3 other = cross(normal, tangent);
    vec3 d1 = vec3(dot(view.across.xyz, tangent), dot(view.down.xyz, tangent), dot(view.depth.xyz, tangent))
        - texel * dot(view.w.xyz, tangent);
    vec3 d2 = vec3(dot(view.across.xyz, other), dot(view.down.xyz, other), dot(view.depth.xyz, other))
        - texel * dot(view.w.xyz, other);
    float determinant = d1.x * d2.y - d1.y * d2.x;
    // A surface along the light has no depth of its own at a texel.
    return abs(determinant) > 1e-20 ? vec2(d1.z * d2.y - d1.y * d2.z, d1.x * d2.z - d1.z * d2.x) / determinant : vec2(0.0);
#endif
}

// From 0 to 1: how much of a light reaches a surface that faces it.
float lightThatArrives(int light, vec3 position, vec3 faceNormal, vec3 toLight)
{
    if (dot(faceNormal, toLight) <= 0.0)
    {
        return 0.0;
    }

    vec3 away = toLight + 0.25 * faceNormal;
    ivec2 range = shadowRanges[light].xy;
    for (int i = range.x; i < range.x + range.y; i++)
    {
        ShadowView view = shadowViews[i];
#ifdef POINT_SHADOWS
        vec4 point = vec4(position + away * (view.offset.x + view.offset.y * dot(view.w, vec4(position, 1.0))), 1.0);
        float w = dot(view.w, point);
        vec3 texel = vec3(dot(view.across, point), dot(view.down, point), dot(view.depth, point)) / w;
#else
        vec4 point = vec4(position + away * view.offset.x, 1.0);
        const float w = 1.0;
        vec3 texel = vec3(dot(view.across, point), dot(view.down, point), dot(view.depth, point));
#endif
        if (w > 0.0 && all(greaterThan(texel.xy, view.bounds.xy)) && all(lessThan(texel.xy, view.bounds.zw)))
        {
            return litPart(view, texel, depthSlope(view, texel, faceNormal));
        }
    }

    return 1.0;
}
