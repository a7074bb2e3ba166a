using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>Fractals of all the sorts that break searches, few enough faces to look at all of them.</summary>
internal static class AttackFractals
{
    private static readonly Transformation Half = Samples.MoveAndScale(0, 0, 0, 0.5);
    private static readonly TransformationSet Corners = Set(Half, Samples.MoveAndScale(1, 0, 0, 0.5), Samples.MoveAndScale(0, 1, 0, 0.5),
        Samples.MoveAndScale(0, 0, 1, 0.5));

    private static readonly TransformationSet Turned = Set(
        new(new(0.3, 1, 0), new(20, 50, 10), new(0.5, 0.5, 0.5)), new(new(-1, 0, 0.2), new(0, 130, -40), new(0.6, 0.6, 0.6)),
        new(new(0, 0, -1), new(75, 0, 0), new(0.4, 0.4, 0.4)));

    private static readonly TransformationSet Skewed = Set(
        new(new(0.3, 1, 0), new(20, 50, 10), new(0.7, 0.3, 0.5)), new(new(-1, 0, 0.2), new(0, 130, -40), new(-0.6, 0.2, 0.6)),
        new(new(0, 0, -1), new(75, 0, 0), new(0.4, -0.5, -0.3)));

    public static IReadOnlyDictionary<string, Func<Fractal>> All { get; } = new Dictionary<string, Func<Fractal>>
    {
        ["flat base"] = () => On(Mesh(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0), Turned),
        ["flat fractal"] =
        () => On(Mesh(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0),
        Set(Half, Samples.MoveAndScale(0.5, 0, 0, 0.5), Samples.MoveAndScale(0, 0.5, 0, 0.5))),
        ["flat fractal, turned"] =
        () => On(Mesh(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0),
        Set(Half, Samples.MoveAndScale(0.5, 0, 0, 0.5), Samples.MoveAndScale(0, 0.5, 0, 0.5)),
        new Transformation(Vector.One, new(30, 40, 50), Vector.One)),
        ["segment"] = () => On(Mesh(0, 0, 0, 1, 2, 3, 0.5, 1, 1.5), Turned),
        ["segment along itself"] =
        () => On(Mesh(0, 0, 0, 1, 2, 3, 0.5, 1, 1.5),
        Set(Samples.MoveAndScale(0, 0, 0, 1 / 3.0), Samples.MoveAndScale(2 / 3.0, 4 / 3.0, 2, 1 / 3.0))),
        ["one face"] = () => On(Samples.Triangle, Turned),
        ["needle"] = () => On(Mesh(0, 0, 0, 1, 0, 0, 0.4, 1e-9, 0), Skewed),
        ["far base"] = () => On(Samples.Tetrahedron.Transform(v => v + (1e6 * Vector.One)), Turned),
        ["far base, identity"] = () => On(Samples.Tetrahedron.Transform(v => v + (1e6 * Vector.One)),
        Set(Transformation.Identity, Samples.MoveAndScale(5e5, 5e5, 5e5, 0.5))),
        ["far base, skewed"] = () => On(Samples.Tetrahedron.Transform(v => v + (1e6 * Vector.One)), Skewed),
        ["tiny base"] = () => On(Samples.Tetrahedron.Transform(v => 1e-20 * v), Corners),
        ["tiny fractal"] = () => Scaled(1e-20, Turned),
        ["tiny skewed fractal"] = () => Scaled(1e-20, Skewed),
        ["huge fractal"] = () => Scaled(1e20, Turned),
        ["huge skewed fractal"] = () => Scaled(1e20, Skewed),
        ["large base"] = () => On(Samples.Tetrahedron.Transform(v => 1000 * v), Corners),
        ["mirrors"] =
        () => On(Samples.Tetrahedron,
        Set(new(Vector.Zero, Vector.Zero, new(-0.5, 0.5, 0.5)), new(Vector.I, Vector.Zero, -0.5 * Vector.One),
        new(Vector.J, new(0, 0, 30), new(0.5, -0.5, -0.5)))),
        ["skewed"] = () => On(Samples.Tetrahedron, Skewed),
        ["shears by chains"] =
        () => Of(
            new Repetition(
                [Corners, Set(new Transformation(Vector.Zero, new(0, 0, 30), new(2, 0.5, 1))),
                Set(new Transformation(Vector.Zero, new(0, 0, -50), new(0.5, 2, 1)))], 4)),
        ["duplicates"] = () => On(Samples.Tetrahedron, Set(Half, Half, Samples.MoveAndScale(1, 0, 0, 0.5), Half)),
        ["identity first"] = () => On(Samples.Tetrahedron, Set([Transformation.Identity, .. Turned.Transformations])),
        ["identity last"] = () => On(Samples.Tetrahedron, Set([.. Turned.Transformations, Transformation.Identity])),
        ["identity twice"] =
        () => On(Samples.Tetrahedron, Set([Transformation.Identity, .. Skewed.Transformations[..2], Transformation.Identity])),
        ["identity alone"] = () => On(Samples.Tetrahedron, Set(Transformation.Identity)),
        ["one map 30 times"] = () => Of(new Repetition([Set(new Transformation(Vector.I, new(0, 20, 0), 0.9 * Vector.One))], 30)),
        ["one skewed map 30 times"] = () => Of(new Repetition([Set(new Transformation(Vector.I, new(0, 20, 50), new(0.9, 0.7, 0.8)))], 30)),
        ["one map and the identity 30 times"] =
        () => Of(Repeat([Set(new Transformation(Vector.I, new(0, 20, 0), 0.9 * Vector.One), Transformation.Identity)], 10)),
        ["300 maps"] = () => Of(new Repetition([Many(300, 0.1)], 1), Many(4, 0.3)),
        ["300 maps and the identity"] = () => Of(new Repetition([Set([.. Many(300, 0.1).Transformations, Transformation.Identity])], 2)),
        ["sets above and below"] = () => Of(Corners, new Repetition([Turned], 3), Skewed, Corners),
        ["nested"] = () => Of(new Repetition([new Repetition([Set(Half, Samples.MoveAndScale(1, 0, 0, 0.7))], 2), Turned], 3)),
        ["nested with the identity"] =
        () => Of(
            new Repetition(
                [new Repetition([Set(Half, Transformation.Identity)], 2), Set([.. Turned.Transformations, Transformation.Identity])], 3)),
        ["one after the other"] = () => Of(new Repetition([Turned], 4), new Repetition([Set(Half, Samples.MoveAndScale(2, 0, 0, 0.3))], 4)),
        ["identities one after the other"] =
        () => Of(Repeat([Set(Transformation.Identity, Half)], 5),
        Repeat([Set(Samples.MoveAndScale(2, 0, 0, 0.3), Transformation.Identity)], 5)),
        ["scale 1"] = () => On(Samples.Tetrahedron, Set(new(Vector.I, new(0, 30, 0), Vector.One), new(Vector.J, new(40, 0, 0), Vector.One)),
        8),
        ["scale 1.3"] =
        () => On(Samples.Tetrahedron, Set(new(Vector.I, new(0, 30, 0), 1.3 * Vector.One), new(Vector.J, new(40, 0, 0), 1.3 * Vector.One)),
        8),
        ["scale 1.3, skewed"] =
        () => On(Samples.Tetrahedron, Set(new(Vector.I, new(0, 30, 0), new(1.3, 0.9, 1)), new(Vector.J, new(40, 0, 0), new(1, 1.2, -0.8))),
        8),
        ["alternating ratios"] =
        () => Of(new Repetition([Corners, Set(Samples.MoveAndScale(0, 0, 0, 0.1), Samples.MoveAndScale(3, 0, 0, 0.2))], 3)),
        ["alternating, one with the identity"] =
        () => Of(
            new Repetition(
                [Set(Half, Transformation.Identity), Set(Samples.MoveAndScale(0, 1, 0, 0.1), Samples.MoveAndScale(3, 0, 0, 0.2))], 4)),
        ["alternating, both with the identity"] =
        () => Of(new Repetition([Set(Half, Transformation.Identity), Set(Transformation.Identity, Samples.MoveAndScale(3, 0, 0, 0.2))], 5)),
        ["ratio 0.99"] =
        () => On(Samples.Tetrahedron,
        Set(new(0.01 * Vector.I, new(0, 5, 0), 0.99 * Vector.One), new(Vector.J, Vector.Zero, 0.99 * Vector.One)), 10),
        ["ratios 0.9 and 0.01"] =
        () => On(Samples.Tetrahedron, Set(new(0.1 * Vector.I, new(0, 5, 9), 0.9 * Vector.One), Samples.MoveAndScale(0, 1, 0, 0.01)), 10),
        ["nearly singular"] =
        () => On(Samples.Tetrahedron,
        Set(new(Vector.I, new(10, 20, 30), new(0.5, 1e-8, 0.5)), new(Vector.J, new(-30, 0, 0), new(0.5, 0.5, 0.5))), 4),
        ["an empty set in one of two ways"] = () => Of(Set(Half, Samples.MoveAndScale(4, 0, 0, 0.5)), new Repetition([Corners], 0), Turned),
    };

    public static TransformationSet Set(params Transformation[] maps) => new([.. maps]);

    private static TransformationSet Many(int count, double scale) => new Random(5) switch
    {
        var random =>
            Set([.. Enumerable.Range(0, count).Select(_ => new Transformation(random.Vector(), random.Degrees(), scale * Vector.One))]),
    };

    private static Repetition Repeat(ImmutableArray<FractalStep> body, int count) => new(body, count);

    private static Fractal Of(params FractalStep[] steps) => new(new([.. steps]), Samples.Tetrahedron);

    private static Fractal On(Mesh mesh, TransformationSet set) => On(mesh, set, 5);

    private static Fractal On(Mesh mesh, TransformationSet set, int depth) => new(new([new Repetition([set], depth)]), mesh);

    private static Fractal On(Mesh mesh, TransformationSet set, Transformation above) =>
        new(new([Set(above), new Repetition([set], 5)]), mesh);

    /// <summary>The same fractal in another size.</summary>
    private static Fractal Scaled(double scale, TransformationSet set) => On(
        Samples.Tetrahedron.Transform(v => scale * v), Set([.. set.Transformations.Select(t => t with { Position = scale * t.Position })]));

    private static Mesh Mesh(params double[] positions) =>
        new([.. positions], positions.Length == 12 ? [0, 1, 2, 0, 2, 3] : [0, 1, 2]);
}
