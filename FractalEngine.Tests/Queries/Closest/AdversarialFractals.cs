using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>Fractals of all the sorts that break searches, with few enough faces to test all of them.</summary>
internal static class AdversarialFractals
{
    private static readonly Transformation Half = Samples.MoveAndScale(0, 0, 0, 0.5);

    private static readonly TransformationSet CornerMaps = CreateSet(
        Half, Samples.MoveAndScale(1, 0, 0, 0.5), Samples.MoveAndScale(0, 1, 0, 0.5), Samples.MoveAndScale(0, 0, 1, 0.5));

    private static readonly TransformationSet FlatCornerMaps = CreateSet(
        Half, Samples.MoveAndScale(0.5, 0, 0, 0.5), Samples.MoveAndScale(0, 0.5, 0, 0.5));

    private static readonly TransformationSet RotatedMaps = CreateSet(
        new(new(0.3, 1, 0), new(20, 50, 10), new(0.5, 0.5, 0.5)),
        new(new(-1, 0, 0.2), new(0, 130, -40), new(0.6, 0.6, 0.6)),
        new(new(0, 0, -1), new(75, 0, 0), new(0.4, 0.4, 0.4)));

    private static readonly TransformationSet SkewedMaps = CreateSet(
        new(new(0.3, 1, 0), new(20, 50, 10), new(0.7, 0.3, 0.5)),
        new(new(-1, 0, 0.2), new(0, 130, -40), new(-0.6, 0.2, 0.6)),
        new(new(0, 0, -1), new(75, 0, 0), new(0.4, -0.5, -0.3)));

    private static readonly Transformation NearlyFullScale = new(Vector.I, new(0, 20, 0), 0.9 * Vector.One);

    private static readonly Mesh Square = CreateMesh(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0);
    private static readonly Mesh Segment = CreateMesh(0, 0, 0, 1, 2, 3, 0.5, 1, 1.5);
    private static readonly Mesh FarTetrahedron = Samples.Tetrahedron.Transform(v => v + (1e6 * Vector.One));

    /// <summary>The fractals by names that say what is unusual about them.</summary>
    public static IReadOnlyDictionary<string, Func<Fractal>> All { get; } = new Dictionary<string, Func<Fractal>>
    {
        ["flat base"] = () => RepeatedOn(Square, RotatedMaps),
        ["flat fractal"] = () => RepeatedOn(Square, FlatCornerMaps),
        ["flat fractal, rotated"] = () => RepeatedOn(Square, FlatCornerMaps, new Transformation(Vector.One, new(30, 40, 50), Vector.One)),
        ["segment"] = () => RepeatedOn(Segment, RotatedMaps),
        ["segment along itself"] = () => RepeatedOn(
            Segment, CreateSet(Samples.MoveAndScale(0, 0, 0, 1 / 3.0), Samples.MoveAndScale(2 / 3.0, 4 / 3.0, 2, 1 / 3.0))),
        ["one face"] = () => RepeatedOn(Samples.Triangle, RotatedMaps),
        ["needle"] = () => RepeatedOn(CreateMesh(0, 0, 0, 1, 0, 0, 0.4, 1e-9, 0), SkewedMaps),
        ["far base"] = () => RepeatedOn(FarTetrahedron, RotatedMaps),
        ["far base, identity"] = () => RepeatedOn(
            FarTetrahedron, CreateSet(Transformation.Identity, Samples.MoveAndScale(5e5, 5e5, 5e5, 0.5))),
        ["far base, skewed"] = () => RepeatedOn(FarTetrahedron, SkewedMaps),
        ["tiny base"] = () => RepeatedOn(Samples.Tetrahedron.Transform(v => 1e-20 * v), CornerMaps),
        ["tiny fractal"] = () => CreateScaled(1e-20, RotatedMaps),
        ["tiny skewed fractal"] = () => CreateScaled(1e-20, SkewedMaps),
        ["huge fractal"] = () => CreateScaled(1e20, RotatedMaps),
        ["huge skewed fractal"] = () => CreateScaled(1e20, SkewedMaps),
        ["large base"] = () => RepeatedOn(Samples.Tetrahedron.Transform(v => 1000 * v), CornerMaps),
        ["mirrors"] = () => RepeatedOn(
            Samples.Tetrahedron,
            CreateSet(
                new(Vector.Zero, Vector.Zero, new(-0.5, 0.5, 0.5)),
                new(Vector.I, Vector.Zero, -0.5 * Vector.One),
                new(Vector.J, new(0, 0, 30), new(0.5, -0.5, -0.5)))),
        ["skewed"] = () => RepeatedOn(Samples.Tetrahedron, SkewedMaps),
        ["shears by chains"] = () => Create(new Repetition(
            [
                CornerMaps,
                CreateSet(new Transformation(Vector.Zero, new(0, 0, 30), new(2, 0.5, 1))),
                CreateSet(new Transformation(Vector.Zero, new(0, 0, -50), new(0.5, 2, 1))),
            ],
            4)),
        ["duplicates"] = () => RepeatedOn(Samples.Tetrahedron, CreateSet(Half, Half, Samples.MoveAndScale(1, 0, 0, 0.5), Half)),
        ["identity first"] = () => RepeatedOn(Samples.Tetrahedron, CreateSet([Transformation.Identity, .. RotatedMaps.Transformations])),
        ["identity last"] = () => RepeatedOn(Samples.Tetrahedron, CreateSet([.. RotatedMaps.Transformations, Transformation.Identity])),
        ["identity twice"] = () => RepeatedOn(
            Samples.Tetrahedron, CreateSet([Transformation.Identity, .. SkewedMaps.Transformations[..2], Transformation.Identity])),
        ["identity alone"] = () => RepeatedOn(Samples.Tetrahedron, CreateSet(Transformation.Identity)),
        ["one map 30 times"] = () => Create(new Repetition([CreateSet(NearlyFullScale)], 30)),
        ["one skewed map 30 times"] = () => Create(
            new Repetition([CreateSet(new Transformation(Vector.I, new(0, 20, 50), new(0.9, 0.7, 0.8)))], 30)),
        ["one map and the identity 10 times"] = () => Create(Repeat([CreateSet(NearlyFullScale, Transformation.Identity)], 10)),
        ["300 maps"] = () => Create(new Repetition([RandomMaps(300, 0.1)], 1), RandomMaps(4, 0.3)),
        ["300 maps and the identity"] = () => Create(
            new Repetition([CreateSet([.. RandomMaps(300, 0.1).Transformations, Transformation.Identity])], 2)),
        ["sets above and below"] = () => Create(CornerMaps, new Repetition([RotatedMaps], 3), SkewedMaps, CornerMaps),
        ["nested"] = () => Create(
            new Repetition([new Repetition([CreateSet(Half, Samples.MoveAndScale(1, 0, 0, 0.7))], 2), RotatedMaps], 3)),
        ["nested with the identity"] = () => Create(new Repetition(
            [
                new Repetition([CreateSet(Half, Transformation.Identity)], 2),
                CreateSet([.. RotatedMaps.Transformations, Transformation.Identity]),
            ],
            3)),
        ["one after the other"] = () => Create(
            new Repetition([RotatedMaps], 4), new Repetition([CreateSet(Half, Samples.MoveAndScale(2, 0, 0, 0.3))], 4)),
        ["identities one after the other"] = () => Create(
            Repeat([CreateSet(Transformation.Identity, Half)], 5),
            Repeat([CreateSet(Samples.MoveAndScale(2, 0, 0, 0.3), Transformation.Identity)], 5)),
        ["scale 1"] = () => RepeatedOn(
            Samples.Tetrahedron, CreateSet(new(Vector.I, new(0, 30, 0), Vector.One), new(Vector.J, new(40, 0, 0), Vector.One)), 8),
        ["scale 1.3"] = () => RepeatedOn(
            Samples.Tetrahedron,
            CreateSet(new(Vector.I, new(0, 30, 0), 1.3 * Vector.One), new(Vector.J, new(40, 0, 0), 1.3 * Vector.One)),
            8),
        ["scale 1.3, skewed"] = () => RepeatedOn(
            Samples.Tetrahedron,
            CreateSet(new(Vector.I, new(0, 30, 0), new(1.3, 0.9, 1)), new(Vector.J, new(40, 0, 0), new(1, 1.2, -0.8))),
            8),
        ["alternating ratios"] = () => Create(
            new Repetition([CornerMaps, CreateSet(Samples.MoveAndScale(0, 0, 0, 0.1), Samples.MoveAndScale(3, 0, 0, 0.2))], 3)),
        ["alternating, one with the identity"] = () => Create(new Repetition(
            [
                CreateSet(Half, Transformation.Identity),
                CreateSet(Samples.MoveAndScale(0, 1, 0, 0.1), Samples.MoveAndScale(3, 0, 0, 0.2)),
            ],
            4)),
        ["alternating, both with the identity"] = () => Create(new Repetition(
            [CreateSet(Half, Transformation.Identity), CreateSet(Transformation.Identity, Samples.MoveAndScale(3, 0, 0, 0.2))], 5)),
        ["ratio 0.99"] = () => RepeatedOn(
            Samples.Tetrahedron,
            CreateSet(new(0.01 * Vector.I, new(0, 5, 0), 0.99 * Vector.One), new(Vector.J, Vector.Zero, 0.99 * Vector.One)),
            10),
        ["ratios 0.9 and 0.01"] = () => RepeatedOn(
            Samples.Tetrahedron,
            CreateSet(new(0.1 * Vector.I, new(0, 5, 9), 0.9 * Vector.One), Samples.MoveAndScale(0, 1, 0, 0.01)),
            10),
        ["nearly singular"] = () => RepeatedOn(
            Samples.Tetrahedron,
            CreateSet(new(Vector.I, new(10, 20, 30), new(0.5, 1e-8, 0.5)), new(Vector.J, new(-30, 0, 0), new(0.5, 0.5, 0.5))),
            4),
        ["a repetition of no rounds"] = () => Create(
            CreateSet(Half, Samples.MoveAndScale(4, 0, 0, 0.5)), new Repetition([CornerMaps], 0), RotatedMaps),
    };

    private static TransformationSet CreateSet(params Transformation[] maps) => new([.. maps]);

    private static TransformationSet RandomMaps(int count, double scale)
    {
        var random = new Random(5);
        var maps = Enumerable.Range(0, count).Select(_ => new Transformation(random.Vector(), random.Degrees(), scale * Vector.One));
        return CreateSet([.. maps]);
    }

    private static Repetition Repeat(ImmutableArray<FractalStep> body, int count) => new(body, count);

    private static Fractal Create(params FractalStep[] steps) => new(new([.. steps]), Samples.Tetrahedron);

    private static Fractal RepeatedOn(Mesh mesh, TransformationSet set, int depth = 5) =>
        new(new([new Repetition([set], depth)]), mesh);

    private static Fractal RepeatedOn(Mesh mesh, TransformationSet set, Transformation outer) =>
        new(new([CreateSet(outer), new Repetition([set], 5)]), mesh);

    /// <summary>A fractal of some maps on the tetrahedron, in another size.</summary>
    private static Fractal CreateScaled(double scale, TransformationSet set) => RepeatedOn(
        Samples.Tetrahedron.Transform(v => scale * v),
        CreateSet([.. set.Transformations.Select(t => t with { Position = scale * t.Position })]));

    private static Mesh CreateMesh(params double[] positions) =>
        new([.. positions], positions.Length == 12 ? [0, 1, 2, 0, 2, 3] : [0, 1, 2]);
}
