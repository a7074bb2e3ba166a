#version 330 core
// The surfaces of lamps, made from the vertex index: a grid over a quad, or over the part of a ball that the eye sees.

#include "lighting.glsl"

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;     // 1 / (half height * aspect), 1 / half height
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w

const ivec2 cells = ivec2(6, 96); // LampsPass.VertexCount
const vec2 corners[6] = vec2[](vec2(0.0), vec2(1.0, 0.0), vec2(1.0), vec2(0.0), vec2(1.0), vec2(0.0, 1.0));

out vec3 pixelPosition;     // relative to the camera
flat out vec3 radiance;

void main()
{
    Light light = lights[gl_InstanceID];
    int cell = gl_VertexID / 6;
    vec2 place = (vec2(cell / cells.y, cell % cells.y) + corners[gl_VertexID % 6]) / vec2(cells);
    vec3 centre = light.position.xyz;
    vec3 toEye = towardsEye(centre, cameraAxes[2], depthScale);
    radiance = light.colour.rgb;
    bool isSeen = light.colour.w > 2.5;
    if (light.colour.w < 3.5)
    {
        float radius = light.axis.w;
        float sine = depthScale.z != 0.0 ? radius / length(centre) : 0.0;
        isSeen = isSeen && sine < 1.0;
        float angle = place.x * acos(min(sine, 1.0));
        float around = 6.28318531 * place.y;
        vec3 right = normalize(abs(toEye.y) < 0.9 ? vec3(toEye.z, 0.0, -toEye.x) : vec3(0.0, -toEye.z, toEye.y));
        vec3 ring = cos(around) * right + sin(around) * cross(right, toEye);
        pixelPosition = centre + radius * (cos(angle) * toEye + sin(angle) * ring);
    }
    else
    {
        isSeen = dot(cross(light.axis.xyz, light.edge.xyz), toEye) > 0.0;
        pixelPosition = centre + (2.0 * place.x - 1.0) * light.axis.xyz + (2.0 * place.y - 1.0) * light.edge.xyz;
    }

    vec3 viewPosition = vec3(dot(cameraAxes[0], pixelPosition), dot(cameraAxes[1], pixelPosition), dot(cameraAxes[2], pixelPosition));
    // What is not seen lies beyond the frame.
    gl_Position = isSeen
        ? vec4(viewPosition.xy * viewScale, depthScale.x * viewPosition.z + depthScale.y, depthScale.z * viewPosition.z + depthScale.w)
        : vec4(2.0, 2.0, 2.0, 1.0);
}
