// Which part of a light arrives at a surface: the depth maps of all lights lie in one texture.
const int shadowViewCount = 48; // ShadowBlock.SlotCount

struct ShadowView
{
    // From a point relative to the camera to the map: rows of a map whose results are texels and the stored depth, for a light with a
    // position before the division by the depth. Greater depths are closer to the light.
    vec4 right;
    vec4 up;
    vec4 forward;
    vec4 bounds;    // first and last texel that has neighbours in the map; empty without a map
    vec4 middle;    // xy: middle of the map; w: distance towards the light, scene units, or per depth of a light with a position
    vec4 depth;     // xy: a light with a position stores x + y / forward; zw: squares of the units of depth by those of texels
};

layout(std140) uniform ShadowBlock
{
    // Of each light: its first view beyond those that have its own index, and their number.
    ivec4 shadowRanges[16];
    // Of each light in a cube of views, towards +x, -x, +y, -y, +z, -z. xy: middle of the map; z: texels per unit at depth 1, 0 without a
    // map; w: distance towards the light per depth.
    vec4 shadowSides[96];
    vec4 shadowTexel; // xy: size of a texel of the texture
    ShadowView shadowViews[shadowViewCount];
};

uniform sampler2D shadowMap;

// Of each light: 0 where it is parallel, 1 in a cube of views, 2 in one view from its position.
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
#ifdef AIR
    // Behind everything there is light where nothing is stored.
    depth = max(depth, 0.0);
#endif
    vec4 weights = vec4(1.0 - part.x, part.x, 1.0 - part.x, part.x) * vec4(vec2(1.0 - part.y), vec2(part.y));
    vec4 depths = vec4(depth, depth + slope.x, depth + slope.y, depth + slope.x + slope.y);
    return dot(mix(vec4(0.0), weights, greaterThanEqual(depths, stored)), vec4(1.0));
}

bool isWithin(vec2 texel, vec4 bounds)
{
    return all(greaterThan(texel, bounds.xy)) && all(lessThan(texel, bounds.zw));
}

vec3 transform(ShadowView view, vec3 direction)
{
    return vec3(dot(view.right.xyz, direction), dot(view.up.xyz, direction), dot(view.forward.xyz, direction));
}

// From 0 to 1: how much of the parallel light of a view reaches a surface; -1 beyond its map.
float litPartOfParallel(ShadowView view, vec3 position, vec3 faceNormal, vec3 towardsMap)
{
    vec3 texel = transform(view, position + towardsMap * view.middle.w) + vec3(view.right.w, view.up.w, view.forward.w);
    vec3 normal = transform(view, faceNormal);
    // How much the depth changes from texel to texel along the plane.
    vec2 slope = view.depth.zw * normal.xy / normal.z;
    return isWithin(texel.xy, view.bounds) ? litPart(texel, slope) : -1.0;
}

#ifdef POINT_SHADOWS
// Likewise in a view of a light with a position, in units of the view: a point before the light, and the normal.
float litPartBefore(vec3 point, vec3 normal, vec2 middle, vec4 depth, out vec2 texel)
{
    float inverse = 1.0 / point.z;
    texel = point.xy * inverse + middle;
    // A surface along the light has no depth of its own at a texel.
    float height = dot(normal.xy * depth.zw, point.xy) + normal.z * point.z;
    vec2 slope = depth.y * depth.zw * normal.xy / (abs(height) > 1e-20 ? height : 1e-20);
    return litPart(vec3(texel, depth.x + depth.y * inverse), slope);
}

// Likewise for the one view of a light with a position.
float litPartOfSpot(ShadowView view, vec3 position, vec3 faceNormal, vec3 towardsMap)
{
    vec3 point = transform(view, position) + vec3(view.right.w, view.up.w, view.forward.w);
    vec3 before = point + transform(view, towardsMap) * (view.middle.w * point.z);
    vec2 texel;
    float part = litPartBefore(before, transform(view, faceNormal), view.middle.xy, view.depth, texel);
    return before.z > 0.0 && isWithin(texel, view.bounds) ? part : -1.0;
}

// From axes of the world to right, up and forward of a side of a cube, as ShadowFit has them.
vec3 toSide(vec3 v, bool isX, bool isY, float facing)
{
    return isX ? vec3(-facing * v.z, v.y, facing * v.x)
        : isY ? vec3(-facing * v.x, v.z, facing * v.y)
        : vec3(facing * v.x, v.y, facing * v.z);
}

// Likewise in a cube of views.
float litPartInCube(int light, vec3 position, vec3 faceNormal, vec3 towardsMap)
{
    vec3 fromLight = position - lights[light].position.xyz;
    vec3 size = abs(fromLight);
    bool isX = size.x >= max(size.y, size.z);
    bool isY = !isX && size.y >= size.z;
    float depth = isX ? fromLight.x : isY ? fromLight.y : fromLight.z;
    float facing = depth > 0.0 ? 1.0 : -1.0;
    vec4 side = shadowSides[6 * light + (isX ? 0 : isY ? 2 : 4) + (depth > 0.0 ? 0 : 1)];
    fromLight += towardsMap * (side.w * abs(depth));
    vec3 point = toSide(fromLight, isX, isY, facing);
    vec3 normal = toSide(faceNormal, isX, isY, facing);
    vec2 texel;
    point.xy *= side.z;
    normal.xy *= side.z;
    float inverseSquare = 1.0 / max(side.z * side.z, 1e-30);
    float part = litPartBefore(point, normal, side.xy, vec4(shadowViews[light].depth.xy, vec2(inverseSquare)), texel);
    return side.z > 0.0 ? part : -1.0;
}
#endif

// From 0 to 1: how much of a light reaches a surface that faces it.
float lightThatArrives(int light, vec3 position, vec3 faceNormal, vec3 toLight)
{
    if (dot(faceNormal, toLight) <= 0.0)
    {
        return 0.0;
    }

    vec3 towardsMap = toLight + 0.25 * faceNormal;
#ifdef POINT_SHADOWS
    if (lightKinds[light] == 1)
    {
        return abs(litPartInCube(light, position, faceNormal, towardsMap));
    }

    if (lightKinds[light] == 2)
    {
        return abs(litPartOfSpot(shadowViews[light], position, faceNormal, towardsMap));
    }
#endif
    float part = litPartOfParallel(shadowViews[light], position, faceNormal, towardsMap);
#ifdef SHADOW_SLICES
    ivec2 range = shadowRanges[light].xy;
    for (int i = range.x; part < 0.0 && i < range.x + range.y; i++)
    {
        part = litPartOfParallel(shadowViews[i], position, faceNormal, towardsMap);
    }
#endif

    return abs(part);
}
