using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Base meshes with few flat sides; each stands on the origin, and is about as high as wide.</summary>
internal static class AngularBases
{
    /// <summary>Makes a convex solid of six corners and eight faces, without symmetry.</summary>
    public static Mesh Wedge(SeededRandom random)
    {
        var builder = new ShapeBuilder();
        var lower = builder.Vertices(Corners(random, 0, 0.5));
        var upper = builder.Vertices(Corners(random, random.Between(0.7, 1), random.Between(0.2, 0.45)));
        builder.Strip(lower, upper, isClosed: true);
        builder.Face(lower[0], lower[2], lower[1]);
        builder.Face(upper[0], upper[1], upper[2]);
        return builder.ToSolid();
    }

    /// <summary>Makes a regular prism.</summary>
    public static Mesh Prism(SeededRandom random)
    {
        var (sides, radius) = (random.Pick(3, 5, 6, 8), random.Written(0.2, 0.5));
        return ShapeBuilder.Extrude(ShapeBuilder.Around(sides, _ => radius), random.Pick(1, random.Written(0.4, 1)));
    }

    /// <summary>Makes a tetrahedron, regular in two of five cases.</summary>
    public static Mesh Tetrahedron(SeededRandom random)
    {
        Vector[] corners = [new(0.5, 0, 0.5), new(-0.5, 0, -0.5), new(-0.5, 1, 0.5), new(0.5, 1, -0.5)];
        if (random.Chance(0.6))
        {
            corners = [.. corners.Select(corner => corner + random.InBox(0.25))];
        }

        var builder = new ShapeBuilder();
        builder.Vertices(corners);
        builder.Face(0, 1, 2);
        builder.Face(0, 3, 1);
        builder.Face(0, 2, 3);
        builder.Face(1, 3, 2);
        return builder.ToSolid();
    }

    /// <summary>Makes a cube in one of three cases, else a box.</summary>
    public static Mesh Box(SeededRandom random) => random.Chance(1.0 / 3) ? Box(1, 1, 1)
        : Box(random.Written(0.15, 1), random.Written(0.3, 1), random.Written(0.1, 1));

    /// <summary>Makes a box of given sides that stands on the origin.</summary>
    public static Mesh Box(double x, double y, double z) =>
        ShapeBuilder.Extrude([(-x / 2, -z / 2), (x / 2, -z / 2), (x / 2, z / 2), (-x / 2, z / 2)], y);

    /// <summary>Makes an octahedron, with an apex aside in half of the cases.</summary>
    public static Mesh Octahedron(SeededRandom random)
    {
        var (width, waist) = (random.Written(0.25, 0.5), random.Written(0.3, 0.6));
        var builder = new ShapeBuilder();
        var ring = builder.Vertices(ShapeBuilder.Around(4, _ => width).Select(corner => new Vector(corner.X, waist, corner.Z)));
        builder.Cone(builder.Vertex(new(0, 0, 0)), ring, reversed: true);
        var aside = random.Chance(0.5) ? random.Between(0.1, 0.3) : 0;
        builder.Cone(builder.Vertex(new(aside, 1, 0.5 * aside)), ring);
        return builder.ToSolid();
    }

    /// <summary>Makes a solid whose outline is an L, so that it is not convex.</summary>
    public static Mesh Angle(SeededRandom random)
    {
        var (length, width, arm) = (random.Written(0.6, 1), random.Written(0.6, 1), random.Written(0.15, 0.4));
        // The first corner is the one inside; it sees all others.
        return ShapeBuilder.Extrude(
            [(arm, arm), (arm, width), (0, width), (0, 0), (length, 0), (length, arm)], random.Written(0.2, 0.8));
    }

    /// <summary>Makes a thick star.</summary>
    public static Mesh Star(SeededRandom random)
    {
        var (points, inner) = (random.Integer(4, 7), random.Written(0.15, 0.3));
        return ShapeBuilder.Extrude(
            ShapeBuilder.Around(2 * points, i => i % 2 == 0 ? 0.5 : inner),
            random.Written(0.1, 0.4), random.Pick(1, 0.7), hasCentres: true);
    }

    /// <summary>Makes two pyramids on a star, with points of different lengths.</summary>
    public static Mesh Thistle(SeededRandom random)
    {
        var (points, inner) = (random.Integer(3, 6), random.Written(0.12, 0.25));
        var outline = ShapeBuilder.Around(2 * points, i => i % 2 == 0 ? random.Between(0.35, 0.6) : inner);
        var (waist, builder) = (random.Written(0.2, 0.5), new ShapeBuilder());
        var ring = builder.Vertices(outline.Select(corner => new Vector(corner.X, waist, corner.Z)));
        builder.Cone(builder.Vertex(Vector.Zero), ring, reversed: true);
        builder.Cone(builder.Vertex(new(0, 1, 0)), ring);
        return builder.ToSolid();
    }

    /// <summary>Makes a solid whose outline is a cross.</summary>
    public static Mesh Cross(SeededRandom random)
    {
        var (right, left, near, far) =
            (random.Written(0.3, 0.6), random.Written(0.3, 0.6), random.Written(0.3, 0.6), random.Written(0.3, 0.6));
        var half = random.Written(0.08, 0.2);
        return ShapeBuilder.Extrude(
            [
                (right, -half), (right, half), (half, half), (half, far), (-half, far), (-half, half),
                (-left, half), (-left, -half), (-half, -half), (-half, -near), (half, -near), (half, -half),
            ],
            random.Written(0.2, 0.6), hasCentres: true);
    }

    /// <summary>Makes a tapered trunk of height 1.</summary>
    public static Mesh Trunk(SeededRandom random)
    {
        var (sides, radius) = (random.Integer(5, 7), random.Written(0.06, 0.2));
        return ShapeBuilder.Extrude(ShapeBuilder.Around(sides, _ => radius), 1, random.Written(0.4, 0.9));
    }

    private static IEnumerable<Vector> Corners(SeededRandom random, double height, double radius) =>
        ShapeBuilder.Around(3, _ => radius * random.Between(0.7, 1.2))
            .Select(corner => new Vector(corner.X, height + random.Between(-0.1, 0.1), corner.Z + random.Between(-0.1, 0.1)));
}
