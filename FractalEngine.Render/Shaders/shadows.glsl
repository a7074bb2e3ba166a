// Which part of a light arrives at a surface: the depth maps of all lights lie in one texture.
const int shadowViewCount = 48; // ShadowBlock.SlotCount

struct ShadowView
{
    vec4 right;     // axes of the light, and what is added so that a point relative to the camera is relative to the light's eye
    vec4 up;
    vec4 forward;   // w: likewise, or for parallel light so that the depth in the map is in proportion
    vec4 scale;     // xy: texels per unit (at depth 1 of a light with a position); zw: middle of the map
    vec4 bounds;    // first and last texel that has neighbours in the map; empty without a map
    vec4 depth;     // xy: depth in the map is x * forward, or x + y / forward; greater is closer to the light. z: 1 for a light with a
                    // position. w: distance towards the light, scene units, or per forward
};

layout(std140) uniform ShadowBlock
{
    // Of each light: its first view beyond those that have its own index, and their number.
    ivec4 shadowRanges[16];
    // Of each light with a position: its views towards +x, -x, +y, -y, and then +z, -z.
    ivec4 shadowSides[32];
    vec4 shadowTexel; // xy: size of a texel of the texture
    ShadowView shadowViews[shadowViewCount];
};

uniform sampler2D shadowMap;

// Of each light: 1 where it has a cube of views around it.
const int lightKinds[] = LIGHT_KINDS;

// The unit normal of the triangle itself, on the side of the eye.
vec3 faceNormalTowardsEye(vec3 position, vec3 toEye, vec3 smoothNormal)
{
    vec3 normal = direction(cross(dFdx(position), dFdy(position)));
    normal = dot(normal, normal) > 0.0 ? normal : smoothNormal;
    return dot(normal, toEye) < 0.0 ? -normal : normal;
}

// The lit part of the four texels around a point. Each is compared with the depth that the surface's plane has there, so that a slanted
// surface does not shade itself.
float litPart(vec3 texel, vec2 slope)
{
    vec2 corner = floor(texel.xy - 0.5);
    vec2 part = texel.xy - 0.5 - corner;
#ifdef GL_ARB_texture_gather
    vec4 stored = textureGather(shadowMap, (corner + 1.0) * shadowTexel.xy).wzxy;
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

// From 0 to 1: how much of the light of a view reaches a surface; -1 beyond its map.
float litPart(ShadowView view, vec3 position, vec3 faceNormal)
{
    // In the axes of the light.
    vec3 point = vec3(dot(view.right.xyz, position), dot(view.up.xyz, position), dot(view.forward.xyz, position))
        + vec3(view.right.w, view.up.w, view.forward.w);
    vec3 normal = vec3(dot(view.right.xyz, faceNormal), dot(view.up.xyz, faceNormal), dot(view.forward.xyz, faceNormal));
#ifdef POINT_SHADOWS
    bool isPerspective = view.depth.z > 0.0;
    vec3 towardsLight = isPerspective ? -point * inversesqrt(dot(point, point)) : vec3(0.0, 0.0, -1.0);
    point += (towardsLight + 0.25 * normal) * (view.depth.w * (isPerspective ? point.z : 1.0));
    float inverse = isPerspective ? 1.0 / point.z : 1.0;
    vec3 texel = vec3(point.xy * inverse * view.scale.xy + view.scale.zw,
        isPerspective ? view.depth.x + view.depth.y * inverse : view.depth.x * point.z);
    // How much the depth changes from texel to texel along the plane. A surface along the light has no depth of its own at a texel.
    float height = isPerspective ? dot(normal, point) : normal.z;
    vec2 slope = (isPerspective ? view.depth.y : -view.depth.x) * normal.xy
        / ((abs(height) > 1e-20 ? height : 1e-20) * view.scale.xy);
    bool isBefore = inverse > 0.0;
#else
    point += (vec3(0.0, 0.0, -1.0) + 0.25 * normal) * view.depth.w;
    vec3 texel = vec3(point.xy * view.scale.xy + view.scale.zw, view.depth.x * point.z);
    // How much the depth changes from texel to texel along the plane.
    vec2 slope = -view.depth.x * normal.xy / (normal.z * view.scale.xy);
    const bool isBefore = true;
#endif
    return isBefore && all(greaterThan(texel.xy, view.bounds.xy)) && all(lessThan(texel.xy, view.bounds.zw))
        ? litPart(texel, slope)
        : -1.0;
}

#ifdef POINT_SHADOWS
// The view of a light with a position that shows a point: the side of a cube around the light.
int sideOf(int light, vec3 fromLight)
{
    vec3 size = abs(fromLight);
    return size.x >= max(size.y, size.z) ? (fromLight.x > 0.0 ? shadowSides[2 * light].x : shadowSides[2 * light].y)
        : size.y >= size.z ? (fromLight.y > 0.0 ? shadowSides[2 * light].z : shadowSides[2 * light].w)
        : (fromLight.z > 0.0 ? shadowSides[2 * light + 1].x : shadowSides[2 * light + 1].y);
}
#endif

// From 0 to 1: how much of a light reaches a surface that faces it.
float lightThatArrives(int light, vec3 position, vec3 faceNormal, vec3 toLight)
{
    if (dot(faceNormal, toLight) <= 0.0)
    {
        return 0.0;
    }

#ifdef POINT_SHADOWS
    if (lightKinds[light] != 0)
    {
        vec3 fromLight = position - lights[light].position.xyz;
        vec3 size = abs(fromLight);
        fromLight += (toLight + 0.25 * faceNormal) * (shadowViews[light].depth.w * max(size.x, max(size.y, size.z)));
        return abs(litPart(shadowViews[sideOf(light, fromLight)], position, faceNormal));
    }
#endif
    float part = litPart(shadowViews[light], position, faceNormal);
#ifdef SHADOW_SLICES
    ivec2 range = shadowRanges[light].xy;
    for (int i = range.x; part < 0.0 && i < range.x + range.y; i++)
    {
        part = litPart(shadowViews[i], position, faceNormal);
    }
#endif

    return abs(part);
}
