using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>What a body is made of, as convex parts in the frame of its model.</summary>
internal sealed class ConvexUnion(ImmutableArray<ConvexPart> parts)
{
    public static ConvexUnion Of(params IEnumerable<Mesh> meshes) =>
        new([.. meshes.Select(static mesh => new ConvexPart(mesh, AffineMap.Identity))]);

    public static ConvexUnion Of(Mesh mesh, IEnumerable<AffineMap> maps) => new([.. maps.Select(map => new ConvexPart(mesh, map))]);

    /// <summary>The parts where they are, of a body or of a static object that was not moved.</summary>
    public PlacedPart[] Place(Body? body = null) => Place(body is null ? static point => point : point => RigidMeshes.PointOf(body, point));

    /// <summary>The parts where a function puts their points.</summary>
    public PlacedPart[] Place(Func<Vector, Vector> place) => [.. parts.Select(part => new PlacedPart(part, place))];

    /// <summary>What is wrong between two placed unions: null where neither reaches into the other.</summary>
    /// <param name="first">Parts of one.</param>
    /// <param name="second">Parts of the other.</param>
    /// <param name="tolerance">How deep a vertex may be.</param>
    public static string? FindFault(PlacedPart[] first, PlacedPart[] second, double tolerance)
    {
        var (bounds1, bounds2) = (BoundsOf(first), BoundsOf(second));
        if (!Overlap(bounds1, bounds2))
        {
            return null;
        }

        var near = second.Where(part => Overlap(part.Bounds, bounds1)).ToArray();
        foreach (var part1 in first.Where(part => Overlap(part.Bounds, bounds2)))
        {
            foreach (var part2 in near)
            {
                if (!Overlap(part1.Bounds, part2.Bounds))
                {
                    continue;
                }

                var depth = Math.Max(part1.MaxDepthOf(part2), part2.MaxDepthOf(part1));
                if (depth > tolerance)
                {
                    return FormattableString.Invariant($"a vertex is {depth:R} deep inside");
                }

                if (part1.IsCrossedBy(part2) || part2.IsCrossedBy(part1))
                {
                    return FormattableString.Invariant($"an edge passes through a face, vertices are {depth:R} deep");
                }
            }
        }

        return null;
    }

    private static BoundingBox BoundsOf(PlacedPart[] placed) => new(
        placed.Aggregate(placed[0].Bounds.Minimum, static (least, part) => Vector.Min(least, part.Bounds.Minimum)),
        placed.Aggregate(placed[0].Bounds.Maximum, static (most, part) => Vector.Max(most, part.Bounds.Maximum)));

    private static bool Overlap(BoundingBox box1, BoundingBox box2) =>
        box1.Minimum.X <= box2.Maximum.X && box2.Minimum.X <= box1.Maximum.X
        && box1.Minimum.Y <= box2.Maximum.Y && box2.Minimum.Y <= box1.Maximum.Y
        && box1.Minimum.Z <= box2.Maximum.Z && box2.Minimum.Z <= box1.Maximum.Z;
}
