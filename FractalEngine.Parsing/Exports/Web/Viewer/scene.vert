#version 300 es
precision highp float;
// A vertex of an instance. Instances are in the axes of the view in which they were listed, shadow maps in those of the world.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 place;
layout(location = 3) in vec3 vertexColour;
uniform sampler2D instances; // of each, rows of its map, its colour and its tint
uniform ivec3 counts;        // vertices of the mesh, copies of it in the buffers, instances
uniform mat3 toWorld;
uniform vec3 offset; // from the camera to the place from which instances were listed
uniform mat3 toCamera;
uniform vec4 projection; // factors of x and y, and of depth
uniform vec2 jitter;
uniform float isParallel; // 1 for a shadow map
uniform vec4 texturePlace;
uniform vec4 kd; // colour of the material; w: 1 where it takes the place of the object's
out vec3 pixelPosition; // relative to the camera
out vec3 pixelNormal;
out vec3 pixelColour;
out vec2 pixelPlace;

void main() {
  // Copies of small meshes are drawn together, since drivers take long for instances of a few triangles each.
  int number = gl_InstanceID * counts.y + gl_VertexID / counts.x;
  if (number >= counts.z) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  ivec2 at = ivec2(number % 400 * 5, number / 400);
  vec4 row0 = texelFetch(instances, at, 0), row1 = texelFetch(instances, at + ivec2(1, 0), 0);
  vec4 row2 = texelFetch(instances, at + ivec2(2, 0), 0);
  vec4 shade = texelFetch(instances, at + ivec2(3, 0), 0), tint = texelFetch(instances, at + ivec2(4, 0), 0);
  vec4 p = vec4(position, 1.0);
  pixelPosition = toWorld * vec3(dot(row0, p), dot(row1, p), dot(row2, p)) + offset;
  vec3 eye = toCamera * pixelPosition;
  gl_Position = vec4(eye.xy * projection.xy + jitter * eye.z, projection.z * eye.z + projection.w,
    mix(eye.z, 1.0, isParallel));
  // Cofactors keep the normal on the side from which the triangle is seen as a front face, mirrored or not.
  vec3 a = vec3(row0.x, row1.x, row2.x), b = vec3(row0.y, row1.y, row2.y), c = vec3(row0.z, row1.z, row2.z);
  float size = max(max(length(a), length(b)), max(length(c), 1e-30));
  a /= size; b /= size; c /= size;
  pixelNormal = toWorld * (cross(b, c) * normal.x + cross(c, a) * normal.y + cross(a, b) * normal.z);
  pixelColour = tint.rgb + tint.w * mix(shade.rgb, kd.rgb, kd.w) * vertexColour;
  vec2 scaled = place * texturePlace.xy + texturePlace.zw;
  pixelPlace = vec2(scaled.x, 1.0 - scaled.y);
}
