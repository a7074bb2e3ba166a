// What a surface looks like.
uniform vec4 material[4];
// 0: colour, linear light; opacity
// 1: how much of a light the highlight returns; exponent
// 2: how much of the ambient light acts; 1 where the material's colour counts, 0 where the object's own does
// 3: scale and offset of texture coordinates
