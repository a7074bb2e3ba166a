using System.Collections.Immutable;
using System.Text.RegularExpressions;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries;

/// <summary>
/// The table of docs/library.md: each question of a mesh, a fractal and a scene has the same answer alone, with a context and in a batch.
/// </summary>
public partial class QuestionTests
{
    private static readonly Mesh Cube = Shapes.Cube();
    private static readonly Fractal Sponge = AssetFractals.Load("menger", 2);

    // The second object is turned and stretched, the third lies far away.
    private static readonly Scene Declared = new()
    {
        Objects =
        [
            new(Cube) { Placement = Transformation.At(new(0.5, 0, 0), scale: 0.5) },
            new(Sponge) { Placement = new(new(-0.5, 0, 0), new(10, 20, 30), new(0.5, 1, 0.8)) },
            new(Cube) { Placement = Transformation.At(new(900, 0, 0)) },
        ],
    };

    private static readonly ImmutableArray<Vector> Positions = [.. Seeded(vector => 2 * vector)];
    private static readonly ImmutableArray<Ray> Rays = [.. Seeded(vector => new Ray(2 * vector, -vector + new Vector(0.1, 0.2, 0.1)))];
    private static readonly ImmutableArray<BoundingBox> Boxes =
        [.. Seeded(vector => new BoundingBox(2 * vector, (2 * vector) + (0.3 * Vector.One)))];

    public static TheoryData<string> ShapeNames => ["mesh", "fractal", "scene"];

    [Fact]
    public void Page_NamesTypesByTheirNamespaces()
    {
        var lines = Using().Matches(File.ReadAllText(Repository.Full("docs/library.md"))).ToArray();
        Assert.Equal(7, lines.Length);
        Assert.All(lines, static line => Assert.All(
            line.Groups[2].Value.Split(", "),
            name => Assert.True(typeof(Mesh).Assembly.GetType($"{line.Groups[1].Value}.{name}")?.IsPublic, $"{line}: {name}")));
    }

    [Theory]
    [MemberData(nameof(ShapeNames))]
    public void FindClosest_HasOneAnswer(string shape)
    {
        var collider = ColliderOf(shape);
        Check(Positions, position => collider.FindClosest(position), (position, context) => collider.FindClosest(position, context));
        Check(
            Positions, position => collider.TryFindClosest(position, 0.4, out var hit) ? hit : null,
            (position, context) => collider.TryFindClosest(position, 0.4, context, out var closest)
                ? new ClosestHit(
                    closest.Distance, closest.Point, closest.Normal, closest.FaceIndex, [.. context.InstancePath],
                    context.ObjectIndex)
                : null);
    }

    [Theory]
    [MemberData(nameof(ShapeNames))]
    public void FindAllWithin_HasOneAnswer(string shape)
    {
        var collider = ColliderOf(shape);
        Check(
            Positions, position => collider.FindAllWithin(position, 0.4, 10_000).ToArray(),
            (position, context) => collider.FindAllWithin(position, 0.4, 10_000, context).ToArray());
        var random = new Random(3);
        for (var i = 0; i < 20; i++)
        {
            var position = random.Vector(1);
            var hits = collider.FindAllWithin(position, 0.5, 10_000);
            Assert.Equal(collider.TryFindClosest(position, 0.5, out var closest), hits.Length > 0);
            Assert.Equal(closest?.Distance ?? 0, hits.Select(static hit => hit.Distance).FirstOrDefault(), 1e-14);
            Assert.Equal(hits.Select(static hit => hit.Distance).Order(), hits.Select(static hit => hit.Distance));
        }
    }

    [Theory]
    [MemberData(nameof(ShapeNames))]
    public void Overlaps_HasOneAnswer(string shape)
    {
        var collider = ColliderOf(shape);
        Check(Positions, position => collider.Overlaps(position, 0.4), (position, context) => collider.Overlaps(position, 0.4, context));
        Check(Boxes, box => collider.Overlaps(box), (box, context) => collider.Overlaps(box, context));
        Assert.True(collider.Overlaps(Vector.Zero, double.PositiveInfinity));
        Assert.False(collider.Overlaps(BoundingBox.Empty));
    }

    [Theory]
    [MemberData(nameof(ShapeNames))]
    public void FindClosestPair_HasOneAnswer(string shape)
    {
        if (ColliderOf(shape) is SceneCollider scene)
        {
            (int First, int Second)[] pairs = [(0, 1), (2, 1)];
            Check(
                pairs, pair => scene.FindClosestPair(pair.First, pair.Second),
                (pair, context) => scene.FindClosestPair(pair.First, pair.Second, context));
            Assert.Throws<NotSupportedException>(() => scene.FindClosestPair(ColliderOf("mesh"), AffineMap.Identity));
            return;
        }

        var (collider, other) = (ColliderOf(shape), ColliderOf("mesh"));
        Check(
            Positions, position => collider.FindClosestPair(other, AffineMap.Translate(position)),
            (position, context) => collider.FindClosestPair(other, AffineMap.Translate(position), context));
    }

    [Theory]
    [MemberData(nameof(ShapeNames))]
    public void FindNearest_HasOneAnswer(string shape)
    {
        var caster = CasterOf(shape);
        Check(Rays, ray => caster.FindNearest(ray), (ray, context) => caster.FindNearest(ray, context));
        Check<Ray, RayHit?>(
            Rays, ray => caster.TryFindNearest(ray, out var hit, 0.1, 3) ? hit : null,
            (ray, context) => caster.TryFindNearest(ray, context, out var hit, 0.1, 3)
                ? hit with { InstancePath = [.. context.InstancePath], ObjectIndex = context.ObjectIndex }
                : null);
    }

    [Theory]
    [MemberData(nameof(ShapeNames))]
    public void HitsAny_HasOneAnswer(string shape)
    {
        var caster = CasterOf(shape);
        Check(Rays, ray => caster.HitsAny(ray, maxDistance: 0.4), (ray, context) => caster.HitsAny(ray, context, maxDistance: 0.4));
        Assert.Equal(
            Rays.Select(ray => caster.TryFindNearest(ray, out _, maxDistance: 0.4)),
            Rays.Select(ray => caster.HitsAny(ray, maxDistance: 0.4)));
    }

    /// <summary>Regions of a scene are those of its objects, whatever their placements.</summary>
    [Fact]
    public void Regions_OfAScene_AreThoseOfItsObjectsInWorldSpace()
    {
        var collider = Collider.For(Declared);
        Mesh[] flattened =
        [
            .. Declared.Objects.Select(static declared => new PlacedModel(declared)).Select(static placed =>
                (placed.Model is FractalModel { Fractal: var fractal } ? fractal.Flatten(100_000) : placed.Model.Mesh)
                    .Flatten([placed.ObjectToWorld])),
        ];
        foreach (var position in Positions)
        {
            var expected = flattened.SelectMany((mesh, index) => new SimpleCollider(mesh).FindAllWithin(position, 0.4, 100_000)
                .Select(hit => (index, hit.Distance))).OrderBy(static hit => hit.Distance).ToArray();
            var actual = collider.FindAllWithin(position, 0.4, 100_000);
            Assert.Equal(expected.Length, actual.Length);
            Assert.All(expected.Zip(actual), pair => Assert.Equal(pair.First.Distance, pair.Second.Distance, 1e-13));
            Assert.Equal(expected.Select(static hit => hit.index).Order(), actual.Select(static hit => hit.ObjectIndex).Order());
        }

        foreach (var box in Boxes)
        {
            Assert.Equal(flattened.Any(mesh => new SimpleCollider(mesh).Overlaps(box)), collider.Overlaps(box));
        }

        var limit = Assert.Throws<FractalLimitException>(
            () => collider.FindAllWithin(Vector.Zero, 1000, 20));
        Assert.EndsWith("faces lie within 1000: expected at most 20", limit.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Regions_OfAnApproximateScene_AreRefused()
    {
        var collider = Collider.For(new Scene { Objects = [new(Cube)] }, ColliderKind.BoundingBox);
        Assert.False(collider.IsExact);
        Assert.Throws<NotSupportedException>(() => collider.FindAllWithin(Vector.Zero, 1, 10));
        Assert.Throws<NotSupportedException>(() => collider.Overlaps(Vector.Zero, 1));
        Assert.Throws<NotSupportedException>(() => collider.Overlaps(BoundingBox.Empty));
    }

    private static void Check<TInput, TAnswer>(
        IReadOnlyList<TInput> inputs, Func<TInput, TAnswer> askAlone, Func<TInput, QueryContext, TAnswer> ask)
    {
        var context = new QueryContext();
        TAnswer[] alone = [.. inputs.Select(askAlone)];
        Assert.Equal(alone, inputs.Select(input => ask(input, context)));
        Assert.True(context.Statistics.FaceTests + context.Statistics.BoundTests > 0);
        var totals = new QueryContext();
        Assert.Equal(alone, BatchQuery.Run(inputs, ask, totals, threads: 2));
        Assert.Equal(
            (context.Statistics.FaceTests, context.Statistics.BoundTests), (totals.Statistics.FaceTests, totals.Statistics.BoundTests));
        // Where all answers were the same, so would be those of other questions.
        Assert.True(alone.Distinct().Count() > 1);
    }

    private static Collider ColliderOf(string shape) => shape switch
    {
        "mesh" => Collider.For(Cube),
        "fractal" => Collider.For(Sponge),
        _ => Collider.For(Declared),
    };

    private static RayCaster CasterOf(string shape) => shape switch
    {
        "mesh" => RayCaster.For(Cube),
        "fractal" => RayCaster.For(Sponge),
        _ => RayCaster.For(LoadedScene.Of(Declared)),
    };

    private static IEnumerable<T> Seeded<T>(Func<Vector, T> create)
    {
        var random = new Random(11);
        return Enumerable.Range(0, 60).Select(_ => create(random.Vector(0.5)));
    }

    [GeneratedRegex(@"^using (FractalEngine[.\w]*); +// ([\w, ]+)$", RegexOptions.Multiline)]
    private static partial Regex Using();
}
