using System.Numerics;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Queries.Closest;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;
using Xunit.Abstractions;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Tests exact colliders where objects are tiny, huge, far away, mirrored and squeezed, at positions equally close to many instances, and
/// at every depth from 1 to 200. TriangleKernelTests have what triangles alone can break,
/// ExactFractalColliderAdversarialTests what fractals can, and ExactFractalColliderDepthTests depths to a million.
/// </summary>
public class ColliderStabilityTests(ITestOutputHelper output)
{
    // As promised, of the larger of the size and the largest coordinate.
    private const double Tolerance = 1e-12;

    /// <summary>Generators of the shapes that have exact colliders.</summary>
    private static readonly (string Name, Func<Random, Model> Create)[] Shapes =
    [
        ("mesh", random => new MeshModel(CollisionMeshes.TriangleSoup(random.Next(), 40, 0.3)) { SourcePath = "/mesh.obj" }),
        ("similar fractal", random => ModelOf(
            Samples.Repeated(3, RandomSimilarity(random), RandomSimilarity(random), RandomSimilarity(random)))),
        ("skewed fractal", random => ModelOf(
            Samples.Repeated(3, random.Transformation(), random.Transformation(), random.Transformation()))),
        ("fractal of sums", random => ModelOf(RandomFractals.Create(random, Composition.Componentwise))),
    ];

    /// <summary>Names of kinds of placement.</summary>
    public static TheoryData<string> Placements => ["scale", "far", "scale and far", "mirror", "condition 1e6", "condition 1e6 and far"];

    [Theory]
    [MemberData(nameof(Placements))]
    public void TryFindClosest_OnAPlacedObject_IsThatOfExactArithmetic(string placement) => CheckPlaced(placement, 12);

    [Theory]
    [MemberData(nameof(Placements))]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OnAPlacedObjectForLong_IsThatOfExactArithmetic(string placement) => CheckPlaced(placement, 1000);

    /// <summary>Properties of a placement that vary one at a time, and their first and last powers of ten.</summary>
    public static TheoryData<string, int, int> Decades =>
        new() { { "translation in sizes", 0, 9 }, { "scale", -12, 12 }, { "condition", 0, 6 } };

    [Theory]
    [MemberData(nameof(Decades))]
    public void TryFindClosest_OnAnObjectOfEveryPlacement_IsThatOfExactArithmetic(string property, int first, int last) =>
        CheckDecades(property, first, last, 3);

    [Theory]
    [MemberData(nameof(Decades))]
    [Trait("Category", "Soak")]
    public void TryFindClosest_OnAnObjectOfEveryPlacementForLong_IsThatOfExactArithmetic(string property, int first, int last) =>
        CheckDecades(property, first, last, 150);

    /// <summary>
    /// The 48 symmetries of a cube are the sponge's too. Queries at the images of a position must give the same distance, in the middle 48
    /// times at once.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    [InlineData(30)]
    [InlineData(200)]
    [InlineData(null)]
    public void TryFindClosest_AtSymmetricPositions_IsTheSameDistance(int? depth)
    {
        using var report = new StabilityReport(output, (object?)depth ?? "infinite");
        var (collider, context) = (new ExactFractalCollider(CullingViews.Menger(depth)), new QueryContext());
        Seeded.Run(60, random =>
        {
            var position = random.Next(3) switch
            {
                0 => random.Vector(1.5),
                1 => new(random.NextDouble(), 0, 0),
                _ => 0.5 * random.Next(4) * Vector.One,
            };
            var distances = SymmetricPositions(position).Select(image =>
            {
                Assert.True(collider.TryFindClosest(image, double.PositiveInfinity, context, out var closest));
                Assert.True(closest.Normal.IsFinite());
                return closest.Distance;
            }).ToArray();
            var spread = (distances.Max() - distances.Min()) / Math.Sqrt(12);
            report.Require("48 symmetric places of the sponge (of the size)", spread, Tolerance, () => $"{position}");
        });
        // The hole in the middle has edges at a third: 1/3·√2 from the middle of a cube of half 1.
        Assert.True(collider.TryFindClosest(Vector.Zero, double.PositiveInfinity, context, out var centre));
        var error = Math.Abs(centre.Distance - (Math.Sqrt(2) / 3));
        report.Require("distance of the middle of the sponge", error, Tolerance, () => $"{centre}");
    }

    /// <summary>
    /// Queries vertices, edges and middles of the tetrahedron fractal, whose maps halve. Each position on an instance's face lies on the
    /// fractal, to the last place.
    /// </summary>
    [Fact]
    public void TryFindClosest_AtEveryDepthTo200_IsOnTheInstanceThatThePathNames()
    {
        using var report = new StabilityReport(output);
        var context = new QueryContext();
        for (var depth = 1; depth <= 200; depth++)
        {
            var fractal = CornerTetrahedra(depth, 1);
            var collider = new ExactFractalCollider(fractal);
            Seeded.RunOne(depth, random =>
            {
                for (var i = 0; i < 10; i++)
                {
                    var path = Enumerable.Range(0, depth).Select(_ => random.Next(4)).ToArray();
                    var (a, b, c) = fractal.BaseMesh.Face(random.Next(4));
                    var local = i % 3 == 0 ? a : i % 3 == 1 ? 0.5 * (a + b) : (0.25 * a) + (0.5 * b) + (0.25 * c);
                    var position = ExactPosition(path, local, 1);
                    Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
                    report.Require(
                        "distance of what lies on an instance (of the size)", closest.Distance / fractal.Bounds.Diagonal, Tolerance,
                        () => $"depth {depth}, path {string.Join(' ', path)}, at {local}");
                }
            });
        }
    }

    [Fact]
    public void TryFindClosest_AtEveryDepthTo200_HasNothingCloser()
    {
        using var report = new StabilityReport(output);
        var (context, compared) = (new QueryContext(), 0);
        for (var depth = 1; depth <= 200; depth++)
        {
            // Quarters lie apart, so that spheres are enough to tell which instances may be close.
            var fractal = CornerTetrahedra(depth, 2);
            var (checker, oracle) = (new ExactColliderChecker($"depth {depth}", fractal), new BranchAndBoundOracle(fractal));
            Seeded.RunOne(depth, random =>
            {
                for (var i = 0; i < 3; i++)
                {
                    // Beside the sub-fractal of a path, by as much as that measures.
                    var path = Enumerable.Range(0, random.Next(1, Math.Min(depth, 40) + 1)).Select(_ => random.Next(4)).ToArray();
                    compared += IsClosest(report, checker, oracle, ExactPosition(path, random.Vector(3), 2), context) ? 1 : 0;
                }
            });
        }

        // Spheres overlap more than their contents do, so that some positions take too long.
        Assert.InRange(compared, 400, 600);
    }

    /// <summary>
    /// Compares the world position of a path and a position in its frame with exact arithmetic. Maps halve, so that doubles hold them
    /// exactly.
    /// </summary>
    [Fact]
    public void WorldPosition_OfAPathAndAPositionInItsFrame_IsThatOfExactArithmetic()
    {
        using var report = new StabilityReport(output);
        var fractal = CornerTetrahedra(null, 1);
        var hierarchy = LodHierarchy.Build(fractal);
        var checker = new ExactColliderChecker("halves", fractal);
        var oracle = new BranchAndBoundOracle(fractal);
        var context = new QueryContext();
        var maxDepth = 0;
        var (queried, compared) = (0, 0);
        Seeded.Run(10, random =>
        {
            var address = new FractalAddress(hierarchy, AffineMap.Identity, new(3, 4, 5));
            while (address.Depth < 200)
            {
                // Towards a vertex of some child, for a part of the path.
                var child = fractal.LevelAt(0).Maps[random.Next(4)];
                address.Move(0.7 * (address.FrameToCamera * (child * fractal.BaseMesh.Vertex(random.Next(4)))));
                var local = address.FrameToCamera.Inverse() * Vector.Zero;
                var (position, expected) = (address.WorldPosition(AffineMap.Identity), ExactPosition([.. address.Path], local, 1));
                var size = FractalPositions.Magnitude(fractal, position);
                report.Require(
                    "world position of a path and a place in its frame (of the size)", Near.Difference(expected, position) / size,
                    Tolerance, () => $"depth {address.Depth}, {local}");
                maxDepth = Math.Max(maxDepth, address.Depth);
                if (random.Next(10) == 0)
                {
                    queried++;
                    compared += IsClosest(report, checker, oracle, position, context) ? 1 : 0;
                }
            }
        });
        report.Record("depth", maxDepth);
        Assert.True(queried > 50, $"only {queried} positions were queried");
        Seeded.AssertMost(compared, queried, minShare: 0.75);
    }

    private void CheckPlaced(string placement, int seeds, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, placement, test);
        var checkedCount = 0;
        Parallel.For(1, seeds + 1, seed => Seeded.RunOne(seed, random =>
        {
            foreach (var (name, create) in Shapes)
            {
                var quantity = $"distance from placed objects (of the magnitude): {name}";
                if (CheckQueries(report, random, quantity, create(random), RandomPlacement(random, placement), null))
                {
                    Interlocked.Increment(ref checkedCount);
                }
            }
        }));
        Seeded.AssertMost(checkedCount, seeds * Shapes.Length);
    }

    private void CheckDecades(string property, int first, int last, int seeds, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, property, test);
        var cases = (last - first + 1) * seeds;
        var checkedCount = 0;
        Parallel.For(0, cases, i => Seeded.RunOne(i, random =>
        {
            var decade = RoundNumbers.PowerOfTen(first + (i / seeds));
            foreach (var (name, create) in Shapes)
            {
                var quantity = $"distance by the {property} (of the magnitude): {name}";
                if (CheckQueries(report, random, quantity, create(random), RandomPlacementBy(random, property, decade), decade))
                {
                    Interlocked.Increment(ref checkedCount);
                }
            }
        }));
        Seeded.AssertMost(checkedCount, cases * Shapes.Length);
    }

    /// <summary>
    /// Records the worse of two errors: of the distance, and of the distance to the point that is named. Returns false for a fractal
    /// without instances.
    /// </summary>
    private static bool CheckQueries(StabilityReport report, Random random, string quantity, Model model, Transformation placement,
        double? at)
    {
        if (model.Mesh.FaceCount == 0 || (model is FractalModel { Fractal.InstanceCount: var count } && count == 0))
        {
            return false;
        }

        var faces = model is FractalModel { Fractal: var fractal }
            ? ExactWorldTriangles.Of(fractal, placement)
            : ExactWorldTriangles.Of(model.Mesh, placement);
        var collider = new SceneCollider(new Scene { Objects = [new(model) { Placement = placement }] });
        var context = new QueryContext();
        for (var query = 0; query < 10; query++)
        {
            var position = faces.RandomPosition(random);
            var (expected, size) = (faces.Distance(position), faces.Magnitude(position));
            Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest, out _));
            Assert.True(closest.Normal.IsFinite() && closest.Point.IsFinite(), $"{quantity}: {placement} at {position}: {closest}");
            var error = Math.Max(Math.Abs(closest.Distance - expected), Math.Abs((closest.Point - position).Length() - expected)) / size;
            report.Require(quantity, error, Tolerance, () => $"{placement} at {position}: {closest}, not {expected:R}", at);
        }

        return true;
    }

    /// <summary>
    /// Checks that the result is a point of the fractal, and that nothing is closer. Returns false where the oracle takes too long.
    /// </summary>
    private static bool IsClosest(StabilityReport report, ExactColliderChecker checker, BranchAndBoundOracle oracle, Vector position,
        QueryContext context)
    {
        Assert.True(checker.Collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
        checker.CheckResult(position, context, closest);
        if (oracle.FindClosestDistance(position, 20_000, closest.Distance) is not { } expected)
        {
            return false;
        }

        var excess = (closest.Distance - expected) / FractalPositions.Magnitude(checker.Fractal, position);
        report.Require("farther than by branch and bound with balls (of the size)", excess, Tolerance, () => $"{position}");
        return true;
    }

    private static Transformation RandomPlacement(Random random, string placement)
    {
        var (scale, far) = (Math.Pow(10, random.Between(-12, 12)), Math.Pow(10, random.Between(0, 9)));
        return placement switch
        {
            "scale" => new(scale * random.Vector(), random.Degrees(), scale * Vector.One),
            "far" => new(far * random.Direction(), random.Degrees(), Vector.One),
            "scale and far" => new(scale * far * random.Direction(), random.Degrees(), scale * Vector.One),
            "mirror" => new(scale * far * random.Direction(), random.Degrees(), scale * new Vector(-1, random.Next(2) == 0 ? 1 : -1, 1)),
            "condition 1e6" => new(scale * random.Vector(), random.Degrees(), scale * new Vector(1e-3, random.Next(2) == 0 ? 1 : -1, 1e-6)),
            _ => new(scale * far * random.Direction(), random.Degrees(), scale * new Vector(1e-6, 1e-3, 1)),
        };
    }

    private static Transformation RandomPlacementBy(Random random, string property, double decade) => property switch
    {
        // Shapes measure some units.
        "translation in sizes" => new(decade * random.Direction(), random.Degrees(), Vector.One),
        "scale" => new(decade * random.Vector(), random.Degrees(), decade * Vector.One),
        "condition" => new(random.Vector(), random.Degrees(), new Vector(1, Math.Pow(decade, -random.NextDouble()), 1 / decade)),
        _ => throw new ArgumentOutOfRangeException(nameof(property), property, null),
    };

    private static FractalModel ModelOf(Fractal fractal) => new(fractal) { SourcePath = "/fractal.fdo" };

    private static Transformation RandomSimilarity(Random random) =>
        new(random.Vector(2), random.Degrees(), random.Between(0.3, 0.7) * (random.Next(2) == 0 ? Vector.One : new(-1, 1, 1)));

    /// <summary>
    /// Creates the fractal of a tetrahedron with four children in its corners, of half the size or a quarter or less. Coordinates are whole
    /// numbers times powers of two, so that a map rounds nothing.
    /// </summary>
    private static Fractal CornerTetrahedra(int? depth, int halvings)
    {
        var ratio = Math.ScaleB(1, -halvings);
        var corners = Enumerable.Range(0, 4).Select(corner => (1 - ratio) * Samples.Tetrahedron.Vertex(corner));
        return Samples.Repeated(depth, [.. corners.Select(corner => Samples.MoveAndScale(corner.X, corner.Y, corner.Z, ratio))]);
    }

    /// <summary>
    /// Computes the position in the world, rounded once: (1 − r)·corner + r·((1 − r)·corner + …), with a power of two as the common
    /// denominator.
    /// </summary>
    private static Vector ExactPosition(int[] path, Vector local, int halvings)
    {
        // 2⁻¹⁰⁷⁴ is the smallest power that a double has: every coordinate is a whole number of it.
        var exponent = -1074 - (halvings * path.Length);
        return new(Along(v => v.X), Along(v => v.Y), Along(v => v.Z));

        double Along(Func<Vector, double> coordinate)
        {
            var sum = ScaledInteger.Of(coordinate(local), exponent + (halvings * path.Length));
            for (var i = 0; i < path.Length; i++)
            {
                var corner = (1 - Math.ScaleB(1, -halvings)) * coordinate(Samples.Tetrahedron.Vertex(path[i]));
                // Corners are small numbers: nothing but zeros is shifted out.
                sum += ScaledInteger.Of(corner, exponent) >> (halvings * i);
            }

            // 120 bits are left for the last rounding.
            var shift = (int)Math.Max(0, BigInteger.Abs(sum).GetBitLength() - 120);
            return Math.ScaleB((double)(sum >> shift), exponent + shift);
        }
    }

    private static IEnumerable<Vector> SymmetricPositions(Vector v) =>
        from order in (Vector[])[v, new(v.Y, v.Z, v.X), new(v.Z, v.X, v.Y), new(v.Y, v.X, v.Z), new(v.X, v.Z, v.Y), new(v.Z, v.Y, v.X)]
        from signs in Enumerable.Range(0, 8)
        select order.Stretch(new((signs & 1) == 0 ? 1 : -1, (signs & 2) == 0 ? 1 : -1, (signs & 4) == 0 ? 1 : -1));
}
