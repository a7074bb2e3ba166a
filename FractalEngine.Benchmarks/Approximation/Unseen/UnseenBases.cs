using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Makes the base meshes of unseen fractals: each of one to three connected components, about one unit large.</summary>
internal static class UnseenBases
{
    /// <summary>All kinds of bases, in the order of their values.</summary>
    public static ImmutableArray<BaseKind> Kinds { get; } = [.. Enum.GetValues<BaseKind>()];

    /// <summary>Makes a base of a kind, with proportions by chance.</summary>
    /// <returns>Its connected components; vertices are welded within each.</returns>
    public static ImmutableArray<Mesh> Create(BaseKind kind, SeededRandom random) => kind switch
    {
        BaseKind.Wedge => [AngularBases.Wedge(random)],
        BaseKind.Prism => [AngularBases.Prism(random)],
        BaseKind.Tetrahedron => [AngularBases.Tetrahedron(random)],
        BaseKind.Box => [AngularBases.Box(random)],
        BaseKind.Octahedron => [AngularBases.Octahedron(random)],
        BaseKind.Angle => [AngularBases.Angle(random)],
        BaseKind.Star => [AngularBases.Star(random)],
        BaseKind.Thistle => [AngularBases.Thistle(random)],
        BaseKind.Cross => [AngularBases.Cross(random)],
        BaseKind.Trunk => [AngularBases.Trunk(random)],
        BaseKind.Ball => [RoundBases.Ball(random)],
        BaseKind.Ring => [RoundBases.Ring(random)],
        BaseKind.Dome => [RoundBases.Dome(random)],
        BaseKind.Gutter => [RoundBases.Gutter(random)],
        BaseKind.Leaf => [RoundBases.Leaf(random)],
        BaseKind.Plate => [RoundBases.Plate(random)],
        BaseKind.Triangle => [RoundBases.Triangle(random)],
        BaseKind.TwoParts => TwoParts(random),
        BaseKind.ThreeParts => ThreeParts(random),
        _ => throw new ArgumentOutOfRangeException(nameof(kind), kind, "no kind of base"),
    };

    private static ImmutableArray<Mesh> TwoParts(SeededRandom random)
    {
        var stick = AngularBases.Box(random.Written(0.05, 0.15), 0.7, random.Written(0.05, 0.15));
        var size = random.Between(0.15, 0.25);
        return [stick, Place(AngularBases.Octahedron(random), size, new(random.Between(-0.1, 0.1), 0.72, 0), Matrix.Identity)];
    }

    private static ImmutableArray<Mesh> ThreeParts(SeededRandom random) =>
    [
        Place(AngularBases.Tetrahedron(random), 0.4, new(-0.5, 0, 0), random.NiceRotation()),
        Place(AngularBases.Wedge(random), 0.3, new(0.5, random.Between(0, 0.3), 0), random.GenericRotation()),
        Place(AngularBases.Box(random), 0.2, new(0, random.Between(0.6, 0.9), random.Between(0.4, 0.6)), random.GenericRotation()),
    ];

    private static Mesh Place(Mesh mesh, double size, Vector position, Matrix rotation) =>
        MeshTools.Move(mesh, new(size * rotation, position));
}
