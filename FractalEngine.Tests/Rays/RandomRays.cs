using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Draws rays at the triangles of a shape: those that programs cast, and those that are hard to get right.</summary>
internal sealed class RandomRays
{
    private readonly BoundingBox _box;
    private readonly Vector _camera;

    public RandomRays(Random random, RayOracle oracle)
    {
        _box = oracle.Bounds;
        _camera = _box.Centre + (_box.Diagonal * random.Between(0.6, 1.5) * random.Direction());
    }

    /// <summary>Draws a ray of any kind, but not at an edge.</summary>
    public Ray Draw(Random random, RayOracle oracle) => random.Next(4) switch
    {
        0 => new(_camera, PointInBox(random) - _camera),
        1 => new(PointInBox(random), Math.Pow(10, random.Next(-3, 4)) * random.Direction()),
        2 => Shadow(random, oracle),
        _ => Axial(random, oracle),
    };

    /// <summary>Draws a ray at a vertex, an edge, or a point of a triangle, with a target that is hit within rounding.</summary>
    public Ray DrawAtEdge(Random random, RayOracle oracle)
    {
        var triangle = RandomTriangle(random, oracle);
        var target = random.Next(3) switch
        {
            0 => triangle.A,
            1 => 0.5 * (triangle.B + triangle.C),
            _ => triangle.A + (random.NextDouble() * (triangle.C - triangle.A)),
        };
        var origin = random.Next(4) switch
        {
            0 => _camera,
            1 => PointInBox(random),
            2 => target + (random.Between(0.01, 1) * _box.Diagonal * Axis(random)),
            _ => RandomTriangle(random, oracle).B,
        };
        var direction = target - origin;
        return new(origin, direction == Vector.Zero ? random.Direction() : direction);
    }

    /// <summary>Draws a ray whose direction has one or two zeros, in the planes of corners.</summary>
    private Ray Axial(Random random, RayOracle oracle)
    {
        var corner = RandomTriangle(random, oracle).A;
        var point = PointInBox(random);
        var origin = new Vector(
            random.Next(2) == 0 ? corner.X : point.X, random.Next(2) == 0 ? corner.Y : point.Y, random.Next(2) == 0 ? corner.Z : point.Z);
        var direction = random.Next(2) == 0 ? Axis(random) : random.Direction().Stretch(Vector.One - Axis(random).Absolute());
        return new(origin - (random.Next(2) * 2 * _box.Diagonal * direction), direction);
    }

    private static Vector Axis(Random random)
    {
        var sign = random.Next(2) == 0 ? 1.0 : -1.0;
        return random.Next(3) switch
        {
            0 => new(sign, 0, -0.0),
            1 => new(-0.0, sign, 0),
            _ => new(0, -0.0, sign),
        };
    }

    private static Ray Shadow(Random random, RayOracle oracle)
    {
        var triangle = RandomTriangle(random, oracle);
        var (u, v) = random.Barycentrics();
        return new(triangle.A + (u * (triangle.B - triangle.A)) + (v * (triangle.C - triangle.A)), random.Direction());
    }

    private static ExpandedTriangle RandomTriangle(Random random, RayOracle oracle) =>
        oracle.Triangles[random.Next(oracle.Triangles.Length)];

    private Vector PointInBox(Random random) =>
        _box.Minimum + _box.Size.Stretch(new(random.NextDouble(), random.NextDouble(), random.NextDouble()));
}
