using System.Globalization;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Fractals;

public class FractalAddressTests
{
    // A sub-fractal is left beyond this number of diagonals of its box, as FractalAddress states.
    private const double MaxDistanceInDiagonals = 1.5;

    private static readonly AffineMap SamplePlacement = new Transformation(new(3, -2, 1), new(20, 30, 40), new(2, 1.5, -1)).ToAffineMap();

    /// <summary>Infinite fractals of one set, and the index of a map whose fixed point is approached.</summary>
    public static TheoryData<string, int> Dives =>
        new()
        {
            { "menger", 0 },
            { "menger", 7 },
            { "sierpinski", 0 },
            { "sierpinski", 3 },
            { "tree", 1 },
            { "tree", 3 },
            { "turned", 0 },
            { "skewed", 0 },
        };

    [Theory]
    [MemberData(nameof(Dives))]
    public void Move_InAndOutAgain_EndsWhereItBegan(string name, int mapIndex)
    {
        foreach (var placement in (AffineMap[])[AffineMap.Identity, SamplePlacement])
        {
            // The dive into skewed maps ends where double precision does.
            foreach (var depth in name == "skewed" ? (int[])[5] : [5, 100, 3000])
            {
                CheckDive(name, mapIndex, placement, depth, 1e-9);
            }
        }
    }

    [Theory]
    [InlineData("menger", 0)]
    [InlineData("turned", 0)]
    [Trait("Category", "Soak")]
    public void Move_ThroughAMillionLevels_EndsWhereItBegan(string name, int mapIndex) =>
        CheckDive(name, mapIndex, SamplePlacement, (int)FractalLimits.Depth.Value, 1e-9);

    [Theory]
    [InlineData(100)]
    [InlineData(10_000)]
    public void LogUnit_AtAnyDepth_IsTheSumOfTheScales(int depth)
    {
        var dive = CreateDive("menger", 0, AffineMap.Identity);
        dive.GoToDepth(depth);
        // The tolerance is that of a sum of equal numbers, each rounded.
        Near.Equal(-dive.Address.Depth * Math.Log(3), dive.Address.LogUnit, 1e-12 * depth * Math.Log(3));
        Near.Equal(1, Math.Abs(dive.Address.FrameToCamera.Linear.Determinant()), 1e-9);
    }

    [Fact]
    public void LogUnit_OfUnevenScales_IsTheSumOfTheLogarithmsAlongThePath()
    {
        var fractal = Samples.Repeated(
            null, new(new(-1, 0, 0), new(10, 20, 30), new(0.5, 0.5, 0.5)), new(new(1, 0, 0), Vector.Zero, new(0.3, 0.35, 0.4)),
            new(new(0, 1, 0), Vector.Zero, new(0.6, 0.5, -0.55)));
        Seeded.Run(30, random =>
        {
            var address = new FractalAddress(LodHierarchy.Build(fractal), SamplePlacement, SamplePlacement * random.Vector(3));
            MoveRandomly(random, address, 200);
            var maps = address.Path.Select(mapIndex => fractal.LevelAt(0).Maps[mapIndex].Linear).Prepend(SamplePlacement.Linear).ToArray();
            var expected = address.Depth == 0 ? 0 : maps.Sum(linear => Math.Log(Math.Abs(linear.Determinant())) / 3);
            Near.Equal(expected, address.LogUnit, 1e-9);
        });
    }

    [Fact]
    public void Path_IntoACorner_IsItsMapAtEveryLevel()
    {
        var dive = CreateDive("menger", 7, AffineMap.Identity);
        dive.GoToDepth(50);
        Assert.Equal(50, dive.Address.Depth);
        Assert.Equal(Enumerable.Repeat(7, 50), dive.Address.Path);
    }

    [Theory]
    [InlineData("menger")]
    [InlineData("sierpinski")]
    [InlineData("tree")]
    [InlineData("turned")]
    [InlineData("skewed")]
    [InlineData("menger-4")]
    public void WorldPosition_NotDeep_IsThatOfTheCamera(string name)
    {
        var hierarchy = LodHierarchy.Build(name == "menger-4" ? CullingViews.Menger(4) : CreateInfinite(name));
        var box = hierarchy.NodeAt(hierarchy.LevelCount).Box;
        var size = (SamplePlacement * box.Centre).Length() + box.Transform(SamplePlacement).Diagonal;
        Seeded.Run(100, random =>
        {
            var position = SamplePlacement * (box.Centre + random.Vector(box.Diagonal));
            var address = new FractalAddress(hierarchy, SamplePlacement, position);
            address.Move(Vector.Zero);
            Near.Equal(position, address.WorldPosition(SamplePlacement), 1e-12 * size);
            for (var i = 0; i < 10; i++)
            {
                var step = 0.5 * (address.FrameToCamera * (box.Centre + random.Vector(box.Diagonal)));
                position += Math.Exp(address.LogUnit) * step;
                address.Move(step);
                Near.Equal(position, address.WorldPosition(SamplePlacement), 1e-12 * size);
            }
        });
    }

    [Fact]
    public void WorldPosition_InAFractalThatHardlyShrinks_IsThatOfTheCamera()
    {
        // After 300 levels sub-fractals have a 10,000th of the size, which is still far within double precision.
        var map = Samples.MoveAndScale(0.03, 0, 0, 0.97);
        var hierarchy = LodHierarchy.Build(Samples.Repeated(null, map, Samples.MoveAndScale(3, 0, 0, 0.1)));
        var address = new FractalAddress(hierarchy, AffineMap.Identity, new(5, 5, 5));
        var position = new Vector(5, 5, 5);
        var fixedPoint = new Vector(1, 0, 0);
        for (var i = 0; i < 60 && address.Depth < 400; i++)
        {
            var step = 0.3 * (fixedPoint - position);
            position += step;
            address.Move(Math.Exp(-address.LogUnit) * step);
            Near.Equal(position, address.WorldPosition(AffineMap.Identity), 1e-9);
        }

        Assert.True(address.Depth > 200, $"only {address.Depth} levels");
    }

    /// <summary>Fractals of the assets with finite depths; −1 keeps the depth of the file.</summary>
    public static TheoryData<string, int> FiniteFractals =>
        new()
        {
            { "appendix-b", 2 },
            { "menger", 3 },
            { "sierpinski", 4 },
            { "tetrahedron", 5 },
            { "tree", 5 },
            { "tree-leaves", 5 },
            { "romanesco", 2 },
            { "fern", 1 },
            { "snowflake", -1 },
            { "shell", -1 },
        };

    [Theory]
    [MemberData(nameof(FiniteFractals))]
    public void CollectRoots_OfAllAncestors_AreTheWholeFractal(string name, int depth)
    {
        var fractal = depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth);
        Seeded.Run(2, random => Assert.True(CheckRoots(random, fractal, SamplePlacement)));
    }

    [Theory]
    [MemberData(nameof(FiniteFractals))]
    [Trait("Category", "Soak")]
    public void CollectRoots_OfMoreAncestors_AreTheWholeFractal(string name, int depth)
    {
        var fractal = depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth);
        Seeded.Run(10, random => Assert.True(CheckRoots(random, fractal, SamplePlacement)));
    }

    [Fact]
    public void CollectRoots_OfRandomFractals_AreTheWholeFractal() => Seeded.RunMost(150, random =>
    {
        var fractal = RandomFractals.Create(random, random.Next(3) == 0 ? Composition.Componentwise : Composition.Affine);
        return CheckRoots(random, fractal, random.Next(2) == 0 ? AffineMap.Identity : SamplePlacement);
    });

    [Fact]
    public void CollectRoots_OfFewAncestors_AreThoseOfTheInnermost()
    {
        var dive = CreateDive("menger", 0, AffineMap.Identity);
        dive.GoToDepth(12);
        for (var maxAncestors = 0; maxAncestors <= 15; maxAncestors++)
        {
            var roots = dive.Address.CollectRoots(maxAncestors);
            Assert.Equal(1 + (19 * Math.Min(maxAncestors, dive.Address.Depth)), roots.Length);
            Assert.Contains(roots, root => root.FrameToCamera == dive.Address.FrameToCamera);
            Assert.All(roots, root => Assert.True(root.FrameToCamera.IsFinite()));
        }
    }

    [Theory]
    [InlineData("menger", 1)]
    [InlineData("sierpinski", 2)]
    [InlineData("tree", 3)]
    [InlineData("turned", 4)]
    [InlineData("skewed", 5)]
    [InlineData("fern", 6)]
    public void Move_ALongRandomWalk_StaysNearAndDoesNotDrift(string name, int seed) =>
        Seeded.RunOne(seed, random => CheckRandomWalk(random, LodHierarchy.Build(CreateInfinite(name)), 5_000));

    [Theory]
    [InlineData("menger", 1)]
    [InlineData("sierpinski", 2)]
    [InlineData("tree", 3)]
    [InlineData("turned", 4)]
    [InlineData("skewed", 5)]
    [InlineData("fern", 6)]
    [Trait("Category", "Soak")]
    public void Move_AHundredThousandSteps_StaysNearAndDoesNotDrift(string name, int seed) =>
        Seeded.RunOne(seed, random => CheckRandomWalk(random, LodHierarchy.Build(CreateInfinite(name)), 100_000));

    [Theory]
    [InlineData("menger")]
    [InlineData("sierpinski")]
    [InlineData("turned")]
    [InlineData("apart")]
    public void ClosestSurfaceDistance_NotDeep_IsThatOfExactSearch(string name)
    {
        var fractal = CreateInfinite(name);
        var hierarchy = LodHierarchy.Build(fractal);
        var box = hierarchy.NodeAt(hierarchy.LevelCount).Box;
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var failures = new List<string>();
        Seeded.Run(300, random =>
        {
            var position = box.Centre + (random.Next(2) == 0 ? 1 : 0.6) * box.Size.Stretch(random.Vector());
            for (var i = 0; i < 4; i++)
            {
                Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
                var exact = (closest.Point - position).Length();
                var address = new FractalAddress(hierarchy, AffineMap.Identity, position);
                address.Move(Vector.Zero);
                var unit = Math.Exp(address.LogUnit);
                var minimum = 1e-3 * unit * NodeOf(hierarchy, address).Box.Transform(address.FrameToCamera).Diagonal;
                var found = unit * address.ClosestSurfaceDistance();
                // The distance is right to a tenth, and never less than a thousandth of the sub-fractal's size.
                if (!(found >= 0.85 * exact && found <= Math.Max(1.15 * exact, 1.01 * minimum)))
                {
                    failures.Add(FormatInvariant(
                        $"at {position}, depth {address.Depth}: {found} for {exact}, with a minimum of {minimum}"));
                }

                // The next query is closer to the surface.
                position += 0.7 * (closest.Point - position);
            }
        });
        Assert.True(failures.Count == 0, $"{failures.Count} of 1200: {string.Join("\n", failures.Take(5))}");
    }

    [Fact]
    public void Move_IntoAFiniteFractal_StopsAboveTheBase()
    {
        foreach (var depth in (int[])[0, 1, 2, 3, 6])
        {
            var address = new FractalAddress(LodHierarchy.Build(CullingViews.Menger(depth)), AffineMap.Identity, new(-3, -3, -3));
            var position = new Vector(-3, -3, -3);
            for (var i = 0; i < 100; i++)
            {
                var step = 0.5 * (-Vector.One - position);
                address.Move(Math.Exp(-address.LogUnit) * step);
                position += step;
            }

            Assert.Equal(Math.Max(0, depth - 1), address.Depth);
            Near.Equal(position, address.WorldPosition(AffineMap.Identity), 1e-12);
        }
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Move_AtTheDeepestLevel_GoesNoDeeper()
    {
        var dive = CreateDive("menger", 0, AffineMap.Identity);
        dive.GoToDepth((int)FractalLimits.Depth.Value);
        for (var i = 0; i < 1000; i++)
        {
            dive.Move(0.5 * dive.LocateTarget(Vector.Zero));
            Assert.Equal((int)FractalLimits.Depth.Value, dive.Address.Depth);
            Assert.True(dive.Address.FrameToCamera.IsFinite());
        }

        Assert.True(double.IsFinite(dive.Address.ClosestSurfaceDistance()));
        Assert.True(dive.Address.WorldPosition(AffineMap.Identity).IsFinite());
    }

    [Theory]
    [InlineData("skewed")]
    [InlineData("old fern")]
    [InlineData("thin")]
    public void Move_WhereMapsSkewWithoutBound_StopsEntering(string name)
    {
        var fractal = CreateInfinite(name);
        var hierarchy = LodHierarchy.Build(fractal);
        var root = hierarchy.NodeAt(hierarchy.LevelCount);
        var depths = new List<int>();
        for (var child = 0; child < root.ChildMaps.Length; child++)
        {
            if (hierarchy.NodeAt(ChildLevels(hierarchy, hierarchy.LevelCount, child)).ChildMaps.Length == 0
                || root.ChildLevelSteps[child] != LevelStep.Down(1))
            {
                continue;
            }

            var address = new FractalAddress(hierarchy, SamplePlacement, SamplePlacement * new Vector(3, 4, 5));
            var map = root.ChildMaps[child].ToAffineMap();
            var target = SamplePlacement * ((Matrix.Identity + (-1 * map.Linear)).Inverse() * map.Translation);
            for (var i = 0; i < 300; i++)
            {
                address.Move(0.3 * Math.Exp(-address.LogUnit) * (target - address.WorldPosition(SamplePlacement)));
                AssertFinite(address);
            }

            depths.Add(address.Depth);
        }

        Assert.True(depths.Max() is > 0 and < 300, $"depths {string.Join(", ", depths)}");
    }

    [Fact]
    public void StorageBytes_AtDepth_AreSomeBytesALevel()
    {
        const int Depth = 50_000;
        var dive = CreateDive("menger", 0, AffineMap.Identity);
        while (dive.Address.Depth < Depth)
        {
            dive.Address.Move(0.5 * dive.LocateTarget(Vector.Zero));
        }

        // 16 bytes a level, and capacity for at most twice as many.
        Assert.InRange(dive.Address.StorageBytes, 16 * Depth, (32 * Depth) + 1000);
    }

    [Fact]
    public void Move_FromDeepToFarAway_LeavesAtOnce()
    {
        var dive = CreateDive("menger", 0, AffineMap.Identity);
        dive.GoToDepth(500);
        dive.Address.Move(1e300 * new Vector(-1, -2, -3));
        AssertFinite(dive.Address);
        Assert.True(dive.Address.Depth < 500);
        Assert.True(dive.Address.LogUnit <= 0);
    }

    [Theory]
    [InlineData(1e-90)]
    [InlineData(1e90)]
    public void Address_OfATinyOrHugeObject_IsAsOfAnyOther(double scale)
    {
        var placement = Samples.MoveAndScale(0, 0, 0, scale).ToAffineMap();
        var dive = CreateDive("menger", 0, placement);
        dive.GoToDepth(20);
        AssertFinite(dive.Address);
        Near.Equal(Math.Log(scale) - (dive.Address.Depth * Math.Log(3)), dive.Address.LogUnit, 1e-9);
        dive.ReturnToStart();
        Assert.Equal((0, 0.0), (dive.Address.Depth, dive.Address.LogUnit));
        Near.Equal(0, (dive.Address.WorldPosition(placement) - dive.Start).Length() / dive.Start.Length(), 1e-9);
    }

    /// <summary>Creates an infinite fractal of one set.</summary>
    internal static Fractal CreateInfinite(string name) => name switch
    {
        "menger" => CullingViews.Menger(null),
        "sierpinski" => Samples.Repeated(
            null,
            Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5), Samples.MoveAndScale(0, 0.5, 0, 0.5),
            Samples.MoveAndScale(0, 0, 1.5, 0.5)),
        "turned" => Samples.Repeated(
            null,
            new(new(-1, 0, 0), new(10, 20, 30), 0.45 * Vector.One),
            new(new(1, 0, 0), new(50, 0, 70), new(0.5, 0.5, -0.5)),
            new(new(0, 1.5, 0), Vector.Zero, 0.4 * Vector.One)),
        // Cubes that do not touch.
        "apart" => new(Samples.Repeated(null, CornerMaps(0.8, 0.2)).Description, CullingViews.Cube),
        "skewed" => Samples.Repeated(
            null,
            new(new(-1, 0, 0), new(0, 0, 30), new(0.5, 0.35, 0.45)),
            new(new(1, 0, 0), new(50, 0, 70), new(0.5, 0.4, 0.5)),
            new(new(0, 1, 0), Vector.Zero, new(0.4, 0.4, 0.35))),
        "thin" => Samples.Repeated(
            null,
            new(new(-1, 0, 0), Vector.Zero, new(0.5, 0.5, 0.001)),
            new(new(1, 0, 0), Vector.Zero, new(0.1, 0.5, 0.5))),
        // Its outermost set is a map that is entered again and again, where the new form has sixteen powers.
        "old fern" => OldFern(),
        _ => AssetFractals.Load(name, null),
    };

    private static Fractal OldFern()
    {
        var fern = OldForms.Load("fern");
        var steps = fern.Description.Steps;
        return new(new(steps.SetItem(0, ((Repetition)steps[0]).WithCount(null))), fern.BaseMesh);
    }

    internal static FractalDive CreateDive(string name, int mapIndex, AffineMap placement)
    {
        var direction = name != "menger" ? new(-1, -0.7, -0.9) : mapIndex == 0 ? -Vector.One : new Vector(-1, 1, 0.8);
        return new(LodHierarchy.Build(CreateInfinite(name)), mapIndex, placement, direction);
    }

    private static Transformation[] CornerMaps(double offset, double scale) =>
    [
        .. from x in (double[])[-offset, offset]
           from y in (double[])[-offset, offset]
           from z in (double[])[-offset, offset]
           select Samples.MoveAndScale(x, y, z, scale),
    ];

    private static void CheckDive(string name, int mapIndex, AffineMap placement, int depth, double tolerance)
    {
        var dive = CreateDive(name, mapIndex, placement);
        var frameToCamera = dive.Address.FrameToCamera;
        var size = dive.Start.Length() + placement.Linear.MaxAbsEntry();
        Assert.Equal((0, 0.0), (dive.Address.Depth, dive.Address.LogUnit));
        dive.GoToDepth(depth);
        AssertFinite(dive.Address);
        dive.ReturnToStart();
        Assert.Equal(0, dive.Address.Depth);
        Assert.Empty(dive.Address.Path);
        Assert.Equal(0.0, dive.Address.LogUnit);
        Near.Equal(0, Near.Difference(frameToCamera, dive.Address.FrameToCamera) / size, tolerance);
    }

    /// <summary>Checks that the sub-fractals of all ancestors are the whole fractal.</summary>
    /// <returns>False for a fractal without instances, of which nothing can be checked.</returns>
    private static bool CheckRoots(Random random, Fractal fractal, AffineMap placement)
    {
        var hierarchy = LodHierarchy.Build(fractal);
        var top = hierarchy.NodeAt(hierarchy.LevelCount);
        if (top.IsEmpty)
        {
            return false;
        }

        var position = placement * (top.Box.Centre + top.Box.Size.Stretch(random.Vector()));
        var address = new FractalAddress(hierarchy, placement, position);
        address.Move(Vector.Zero);
        // The camera moves deeper five times, to a point of the sub-fractal's box.
        for (var i = 0; i < 5; i++)
        {
            var box = NodeOf(hierarchy, address).Box;
            var step = 0.9 * (address.FrameToCamera * (box.Centre + (0.5 * box.Size.Stretch(random.Vector()))));
            position += Math.Exp(address.LogUnit) * step;
            address.Move(step);
        }

        var unit = Math.Exp(address.LogUnit);
        var found = new List<AffineMap>();
        foreach (var root in address.CollectRoots(int.MaxValue))
        {
            var rootToCamera = new AffineMap(unit * root.FrameToCamera.Linear, unit * root.FrameToCamera.Translation);
            AddInstances(found, hierarchy, root.RemainingLevels, rootToCamera);
        }

        // The hierarchy itself may repeat instances that overlap beyond the end of a repetition (docs/colliders.md).
        var expected = new List<AffineMap>();
        var objectToCamera = AffineMap.Translate(-position) * placement;
        AddInstances(expected, hierarchy, hierarchy.LevelCount, objectToCamera);
        CullingViews.AssertEachVisibleOnce([.. expected], found);
        var distinct = FractalGenerator.Expand(fractal, 2_000_000).Select(instance => objectToCamera * instance).ToArray();
        Assert.All(CullingViews.CountMatches(distinct, found), count => Assert.True(count >= 1));
        return true;
    }

    private static void AddInstances(List<AffineMap> found, LodHierarchy hierarchy, long levels, AffineMap map)
    {
        var node = hierarchy.NodeAt(levels);
        if (node.ChildMaps.Length == 0)
        {
            if (!node.IsEmpty)
            {
                found.Add(map);
            }

            return;
        }

        for (var child = 0; child < node.ChildMaps.Length; child++)
        {
            var childLevels = node.ChildLevelSteps[child].RemainingLevels(levels);
            AddInstances(found, hierarchy, childLevels, map * node.ChildMaps[child].ToAffineMap());
        }
    }

    /// <summary>Walks into sub-fractals and out again, and compares shallow positions with the sum of the steps.</summary>
    private static void CheckRandomWalk(Random random, LodHierarchy hierarchy, int steps)
    {
        var position = SamplePlacement * new Vector(2, 1, -2);
        var size = hierarchy.NodeAt(hierarchy.LevelCount).Box.Transform(SamplePlacement).Diagonal;
        var address = new FractalAddress(hierarchy, SamplePlacement, position);
        address.Move(Vector.Zero);
        var maxDepth = 0;
        var comparedCount = 0;
        var isGoingIn = true;
        for (var i = 0; i < steps; i++)
        {
            var node = NodeOf(hierarchy, address);
            // The camera goes in for some levels, then out again.
            isGoingIn = isGoingIn ? address.Depth < 30 && random.Next(200) > 0 : address.Depth == 0 || random.Next(500) == 0;
            // Outwards it moves away from the sub-fractal, to some side.
            var step = isGoingIn
                ? random.Between(0.1, 0.6) * (address.FrameToCamera * (node.Box.Centre + (0.5 * node.Box.Size.Stretch(random.Vector()))))
                : random.Between(0.2, 2) * node.Box.Transform(address.FrameToCamera).Diagonal
                    * ((0.7 * random.Direction()) - (address.FrameToCamera * node.Box.Centre).UnitVector());
            position += Math.Exp(address.LogUnit) * step;
            address.Move(step);
            AssertFinite(address);
            node = NodeOf(hierarchy, address);
            var camera = address.FrameToCamera.Inverse() * Vector.Zero;
            Ensure.That(
                address.Depth == 0 || Math.Sqrt(node.Box.DistanceSquared(camera)) <= 1.001 * MaxDistanceInDiagonals * node.Box.Diagonal,
                $"step {i}: too far away at depth {address.Depth}");
            maxDepth = Math.Max(maxDepth, address.Depth);
            if (address.Depth <= 6)
            {
                comparedCount++;
                Near.Equal(position, address.WorldPosition(SamplePlacement), 1e-9 * size);
            }

            if (position.Length() > 20 * size)
            {
                var back = Math.Exp(-address.LogUnit) * -position;
                position += Math.Exp(address.LogUnit) * back;
                address.Move(back);
            }
        }

        Assert.True(
            maxDepth >= 6 && comparedCount >= steps / 100, FormatInvariant($"depth at most {maxDepth}, compared {comparedCount} times"));
    }

    private static void MoveRandomly(Random random, FractalAddress address, int steps)
    {
        for (var i = 0; i < steps; i++)
        {
            address.Move(random.Between(0, 0.5) * (address.FrameToCamera * random.Vector()));
        }
    }

    private static LodNode NodeOf(LodHierarchy hierarchy, FractalAddress address)
    {
        var levels = hierarchy.LevelCount;
        foreach (var mapIndex in address.Path)
        {
            levels = ChildLevels(hierarchy, levels, mapIndex);
        }

        return hierarchy.NodeAt(levels);
    }

    private static long ChildLevels(LodHierarchy hierarchy, long levels, int mapIndex) =>
        hierarchy.NodeAt(levels).ChildLevelSteps[mapIndex].RemainingLevels(levels);

    private static void AssertFinite(FractalAddress address) => Ensure.That(
        address.FrameToCamera.IsFinite() && double.IsFinite(address.LogUnit) && address.FrameToCamera.Linear.Determinant() != 0,
        $"at depth {address.Depth}: {address.FrameToCamera}, {address.LogUnit}");

    private static string FormatInvariant(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);
}
