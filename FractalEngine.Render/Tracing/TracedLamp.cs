using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>The surface of a light, in the space of the traced scene: rays meet it, and points choose directions that lead to it.</summary>
/// <param name="emitter">A light with a surface and a position.</param>
/// <param name="eye">Origin of the traced scene's space, world space.</param>
/// <param name="unit">Unit of that space, in scene units.</param>
internal abstract class TracedLamp(Emitter emitter, Vector eye, double unit)
{
    /// <summary>The light whose surface it is.</summary>
    public Emitter Emitter => emitter;

    /// <summary>The centre, in the space of the traced scene.</summary>
    protected Vector Centre { get; } = (emitter.Position!.Value - eye) / unit;

    /// <summary>The radiance that a point is lit with, linear light.</summary>
    public Vector RadianceAt(Vector position) =>
        emitter.PartWithinRange(unit * (Centre - position).Length()) * emitter.SurfaceRadiance;

    /// <summary>Finds where a ray meets the bright side of the surface.</summary>
    /// <param name="ray">With a unit direction.</param>
    /// <returns>The distance; infinite where it misses.</returns>
    public abstract double DistanceAlong(in Ray ray);

    /// <summary>Chooses a direction from a point towards the surface.</summary>
    /// <param name="position">The point.</param>
    /// <param name="point">A point of the unit square.</param>
    /// <param name="toLight">Unit direction.</param>
    /// <param name="distance">Distance of the surface there.</param>
    /// <returns>False where the point does not see the bright side, whatever stands between.</returns>
    public abstract bool TrySample(Vector position, (double U, double V) point, out Vector toLight, out double distance);

    /// <summary>Computes how likely <see cref="TrySample"/> chooses a direction that leads to the surface, per solid angle.</summary>
    /// <param name="position">The point.</param>
    /// <param name="toLight">Unit direction.</param>
    /// <param name="distance">Distance of the surface there.</param>
    public abstract double Density(Vector position, Vector toLight, double distance);
}
