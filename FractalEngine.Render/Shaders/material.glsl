// The material of a surface.
uniform vec4 material[5];
// 0: diffuse colour, linear light; opacity
// 1: specular colour; exponent
// 2: how much of the ambient light is reflected; 1 to use the material's diffuse colour, 0 to use the object's own
// 3: scale and offset of texture coordinates
// 4: emitted light
