// The material of a surface.
uniform vec4 material[8];
// 0: diffuse colour, linear light; opacity
// 1: what the coat mirrors of light that falls straight onto it; roughness
// 2: how much of the ambient light is reflected; 1 to use the material's diffuse colour, 0 to use the object's own
// 3: scale and offset of texture coordinates
// 4: emitted light; share of metal
// 5: what the coat reflects by several facets; the mean part of white light that facets don't send out at once
// 6: the mean part of light that comes through the coat; factor of heights, 0 for normals
// 7: scale and offset of the coordinates of normals or heights
