#version 330 core

in vec4 lineColour;

out vec4 fragment;

void main()
{
    fragment = lineColour;
}
