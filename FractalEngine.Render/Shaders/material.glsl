// The material of a surface.
#ifdef GRADED
// Of a gradient: by sixteenths of it, the roughness, what the coat reflects by several facets, the mean part of white light that facets
// don't send out at once, and that of light that comes through the coat.
uniform vec4 gradedSteps[17];
uniform vec4 gradedEnds;  // share of metal at both ends, then glow at both
uniform float gradedCoat; // what the coat mirrors of light that falls straight onto it

vec4 material[8];

// Sets the material of a place in the gradient, from 0 to 1.
void grade(float place)
{
    float at = 16.0 * clamp(place, 0.0, 1.0);
    int last = int(min(at, 15.0));
    vec4 numbers = mix(gradedSteps[last], gradedSteps[last + 1], at - float(last));
    material[0] = vec4(1.0);
    material[1] = vec4(vec3(gradedCoat), numbers.x);
    material[2] = vec4(1.0, 1.0, 1.0, 0.0);
    material[3] = vec4(1.0, 1.0, 0.0, 0.0);
    material[4] = vec4(0.0, 0.0, 0.0, mix(gradedEnds.x, gradedEnds.y, place));
    material[5] = vec4(vec3(numbers.y), numbers.z);
    material[6] = vec4(vec3(numbers.w), 0.0);
    material[7] = vec4(0.0);
}
#else
uniform vec4 material[8];
#endif
// 0: diffuse colour, linear light; opacity
// 1: what the coat mirrors of light that falls straight onto it; roughness
// 2: how much of the ambient light is reflected; 1 to use the material's diffuse colour, 0 to use the object's own
// 3: scale and offset of texture coordinates
// 4: emitted light; share of metal
// 5: what the coat reflects by several facets; the mean part of white light that facets don't send out at once
// 6: the mean part of light that comes through the coat; factor of heights, 0 for normals
// 7: scale and offset of the coordinates of normals or heights
