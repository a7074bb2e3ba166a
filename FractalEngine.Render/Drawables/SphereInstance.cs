using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Drawables;

/// <summary>A sphere that is drawn beside the objects of the scene.</summary>
/// <param name="Centre">Centre of the sphere, world space.</param>
/// <param name="Radius">Radius of the sphere, scene units.</param>
public readonly record struct SphereInstance(Vector Centre, double Radius)
{
    /// <summary>Colour of all spheres: coral in the palette.</summary>
    public static Colour Colour => ObjectPalette.ColourOf(2);

    /// <summary>The box around the sphere, world space.</summary>
    internal BoundingBox Bounds => new(Centre - (Radius * Vector.One), Centre + (Radius * Vector.One));
}
