using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>A triangle and a position of all the sorts that break closest-point code.</summary>
/// <param name="Position">The position of the query.</param>
/// <param name="A">The first vertex.</param>
/// <param name="B">The second vertex.</param>
/// <param name="C">The third vertex.</param>
internal readonly record struct AdversarialTriangle(Vector Position, Vector A, Vector B, Vector C)
{
    /// <summary>The largest absolute coordinate, which errors are measured against.</summary>
    public double Magnitude =>
        Math.Max(Math.Max(Position.MaxAbsComponent(), A.MaxAbsComponent()), Math.Max(B.MaxAbsComponent(), C.MaxAbsComponent()));

    /// <summary>Draws a triangle and a position.</summary>
    public static AdversarialTriangle Random(Random random)
    {
        var (a, b, c) = RandomVertices(random);
        var position = RandomPosition(random, a, b, c);
        // Scales are powers of ten from 1e-30 to 1e30, and some triangles are far from the origin.
        var scale = random.Next(2) == 0 ? 1 : Math.Pow(10, random.Next(-30, 31));
        var offset = random.Next(4) == 0 ? Math.Pow(10, random.Next(0, 9)) * RandomInCube(random) : Vector.Zero;
        return new(scale * (position + offset), scale * (a + offset), scale * (b + offset), scale * (c + offset));
    }

    /// <summary>Draws a vector in the cube from −1 to 1.</summary>
    public static Vector RandomInCube(Random random) =>
        new((2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1);

    /// <summary>Draws a position on a vertex, an edge, the triangle or its plane, or near it, or far from it.</summary>
    public static Vector RandomPosition(Random random, Vector a, Vector b, Vector c)
    {
        var (u, v) = random.Barycentrics();
        var inside = a + (u * (b - a)) + (v * (c - a));
        var normal = Vector.Cross(b - a, c - a);
        return random.Next(10) switch
        {
            0 => a,
            1 => b,
            2 => c,
            3 => a + (u * (b - a)),
            4 => inside,
            5 => inside + (Math.Pow(10, random.Next(-16, 2)) * normal),
            6 => a + (((4 * u) - 2) * (b - a)) + (((4 * v) - 2) * (c - a)),
            7 => Math.Pow(10, random.Next(0, 9)) * RandomInCube(random),
            8 => inside + (Math.Pow(10, random.Next(-16, 2)) * RandomInCube(random)),
            _ => 2 * RandomInCube(random),
        };
    }

    private static (Vector A, Vector B, Vector C) RandomVertices(Random random)
    {
        var a = RandomInCube(random);
        var b = RandomInCube(random);
        var c = RandomInCube(random);
        var small = Math.Pow(10, -random.Next(0, 18));
        (a, b, c) = random.Next(10) switch
        {
            0 => (a, b, b + (small * c)),
            1 => (a, b, a + (random.NextDouble() * (b - a)) + (small * c)),
            2 => (a, b, a + (random.Next(-4, 5) / 4.0 * (b - a))),
            3 => (a, a, c),
            4 => (a, a, a),
            5 => (RoundToEighths(a), RoundToEighths(b), RoundToEighths(c)),
            6 => (RoundToEighths(a), RoundToEighths(a) + RoundToEighths(b), RoundToEighths(a) + (random.Next(-3, 4) * RoundToEighths(b))),
            7 => (a.Stretch(new(1, 0, 1)), b.Stretch(new(1, 0, 1)), c.Stretch(new(1, 0, 1))),
            _ => (a, b, c),
        };
        return random.Next(3) switch { 0 => (a, b, c), 1 => (b, c, a), _ => (c, a, b) };
    }

    private static Vector RoundToEighths(Vector v) => new(Math.Round(8 * v.X), Math.Round(8 * v.Y), Math.Round(8 * v.Z));
}
