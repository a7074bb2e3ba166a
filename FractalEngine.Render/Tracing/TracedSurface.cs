using FractalEngine.Core.Maths;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>A point of a surface that a ray has hit. Both normals are unit vectors on the side that the ray comes from.</summary>
/// <param name="Position">World space.</param>
/// <param name="FaceNormal">The normal of the triangle.</param>
/// <param name="Normal">For shading: interpolated, with bumps.</param>
/// <param name="Colour">The part of light that is reflected, linear light.</param>
/// <param name="Gloss">What mirrors; null for a matt surface.</param>
/// <param name="Emission">Radiance of the surface itself.</param>
/// <param name="Opacity">From 0 to 1.</param>
internal readonly record struct TracedSurface(
    Vector Position, Vector FaceNormal, Vector Normal, Vector Colour, Gloss? Gloss, Vector Emission, double Opacity)
{
    /// <summary>About the part of light that the surface returns.</summary>
    public Vector Albedo => Glass is not null ? Vector.One
        : Gloss is null ? Colour : Vector.Min(Colour + Gloss.Specular(Colour), Vector.One);

    /// <summary>Index of the face in its mesh; −1 for a point of a section.</summary>
    public int FaceIndex { get; init; } = -1;

    /// <summary>The light whose surface it is; null for none.</summary>
    public TracedLamp? Lamp { get; init; }

    /// <summary>The material within, where the surface is that of a solid which refracts light; null for none.</summary>
    public Glass? Glass { get; init; }

    /// <summary>Whether the ray comes from within that solid.</summary>
    public bool IsInside { get; init; }
}
