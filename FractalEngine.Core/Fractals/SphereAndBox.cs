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

    /// <summary>Combines two volumes of the same content: the smaller sphere with the intersection of the boxes.</summary>
    public static SphereAndBox Tighter(in SphereAndBox volume1, in SphereAndBox volume2) => new(
        volume1.Sphere.Radius <= volume2.Sphere.Radius ? volume1.Sphere : volume2.Sphere,
        new(Vector.Max(volume1.Box.Minimum, volume2.Box.Minimum), Vector.Min(volume1.Box.Maximum, volume2.Box.Maximum)));

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

    /// <summary>Computes an upper bound of <c>Dot(direction, v)</c> over the image of the content under a map.</summary>
    public double SupportBound(AffineMap map, Vector direction)
    {
        if (double.IsPositiveInfinity(Sphere.Radius))
        {
            return double.PositiveInfinity;
        }

        var local = map.Linear.Transpose() * direction;
        var sphereSupport = Vector.Dot(local, Sphere.Centre) + (local.Length() * Sphere.Radius);
        var boxSupport = Vector.Dot(local, Box.Centre) + (0.5 * Vector.Dot(local.Absolute(), Box.Size));
        return Math.Min(sphereSupport, boxSupport) + Vector.Dot(direction, map.Translation);
    }
}
