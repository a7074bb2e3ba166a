#version 330 core
// The colour of the side that is seen. A front face is wound clockwise on the screen: the world is left-handed.

in vec3 frontColour;
in vec3 backColour;

out vec4 fragment;

void main()
{
    fragment = vec4(gl_FrontFacing ? frontColour : backColour, 1.0);
}
