using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Tracing;

/// <summary>A point of a surface that a ray has hit. Both normals are unit vectors on the side that the ray comes from.</summary>
/// <param name="Position">World space.</param>
/// <param name="FaceNormal">The normal of the triangle.</param>
/// <param name="Normal">For shading: interpolated, with bumps.</param>
/// <param name="Diffuse">The part of light that is scattered, linear light.</param>
/// <param name="Specular">The part of light that is mirrored where it falls straight onto the surface.</param>
/// <param name="Roughness">α of the distribution of GGX.</param>
/// <param name="Emission">Radiance of the surface itself.</param>
/// <param name="Opacity">From 0 to 1.</param>
/// <param name="FaceIndex">Index of the face in its mesh; −1 for a point of a section.</param>
internal readonly record struct TracedSurface(
    Vector Position, Vector FaceNormal, Vector Normal, Vector Diffuse, Vector Specular, double Roughness, Vector Emission, double Opacity,
    int FaceIndex = -1)
{
    /// <summary>True where part of the light is mirrored.</summary>
    public bool IsGlossy => Specular != Vector.Zero;
}
