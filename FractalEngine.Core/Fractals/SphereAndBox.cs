using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>A bounding volume: the intersection of a sphere and an axis-aligned box.</summary>
internal readonly record struct SphereAndBox(BoundingSphere Sphere, BoundingBox Box)
{
    /// <summary>The volume that holds all of space.</summary>
    public static SphereAndBox Unbounded { get; } = new(
        new(Vector.Zero, double.PositiveInfinity),
        new(double.NegativeInfinity * Vector.One, double.PositiveInfinity * Vector.One));

    /// <summary>Computes the volume of all vertices of a mesh; the sphere is centred in the box.</summary>
    public static SphereAndBox FromMesh(Mesh mesh)
    {
        var centre = mesh.Bounds.Centre;
        var radius = 0.0;
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            radius = Math.Max(radius, (mesh.Vertex(vertex) - centre).Length());
        }

        return new(new(centre, radius), mesh.Bounds);
    }

    /// <summary>Tells whether the box lies within the range of a double.</summary>
    public bool IsFinite() => Box.Size.IsFinite() && Box.Minimum.IsFinite();

    /// <summary>Computes a volume that holds the images of the content under all of several maps.</summary>
    public SphereAndBox UnionOfTransformed(ReadOnlySpan<AffineMap> maps)
    {
        var box = BoundingBox.Empty;
        var sphereBox = BoundingBox.Empty;
        foreach (var map in maps)
        {
            box = BoundingBox.Union(box, Box.Transform(map));
            var sphere = Sphere.Transform(map);
            sphereBox = sphereBox.Including(sphere.Centre - (sphere.Radius * Vector.One))
                .Including(sphere.Centre + (sphere.Radius * Vector.One));
        }

        box = new(Vector.Max(box.Minimum, sphereBox.Minimum), Vector.Min(box.Maximum, sphereBox.Maximum));
        var radius = 0.0;
        foreach (var map in maps)
        {
            var sphere = Sphere.Transform(map);
            radius = Math.Max(radius, (sphere.Centre - box.Centre).Length() + sphere.Radius);
        }

        return new(new(box.Centre, radius), box);
    }
}
