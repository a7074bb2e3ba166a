using System.Globalization;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility;

namespace FractalEngine.Tests.Fractals;

public class FractalAddressTests
{
    // As FractalAddress states it: a sub-fractal is left beyond so many diagonals of its box.
    private const double Left = 1.5;

    private static readonly AffineMap Aside = new Transformation(new(3, -2, 1), new(20, 30, 40), new(2, 1.5, -1)).ToAffineMap();

    /// <summary>Infinite fractals of one set, a copy of each, and from where its fixed point is approached.</summary>
    public static TheoryData<string, int> Dives =>
        new() { { "menger", 0 }, { "menger", 7 }, { "sierpinski", 0 }, { "sierpinski", 3 }, { "tree", 1 }, { "tree", 3 }, { "turned", 0 },
        { "skewed", 0 } };

    [Theory]
    [MemberData(nameof(Dives))]
    public void Move_InAndOutAgain_EndsWhereItBegan(string name, int copy)
    {
        foreach (var placement in (AffineMap[])[AffineMap.Identity, Aside])
        {
            // Skewed maps stop where double precision does.
            foreach (var depth in name == "skewed" ? (int[])[5] : [5, 100, 10_000])
            {
                CheckDive(name, copy, placement, depth, 1e-9);
            }
        }
    }

    [Theory]
    [InlineData("menger", 0)]
    [InlineData("turned", 0)]
    [Trait("Category", "Soak")]
    public void Move_ThroughAMillionLevels_EndsWhereItBegan(string name, int copy) =>
        CheckDive(name, copy, Aside, FractalLimits.MaxDepth, 1e-9);

    [Theory]
    [InlineData(100)]
    [InlineData(10_000)]
    public void LogUnit_AtAnyDepth_IsTheSumOfTheScales(int depth)
    {
        var dive = Dive("menger", 0, AffineMap.Identity);
        dive.GoTo(depth);
        // A sum of so many numbers of the same kind, each rounded.
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
            var address = new FractalAddress(LodHierarchy.Build(fractal), Aside, Aside * random.Vector(3));
            Wander(random, address, 200);
            var maps = address.Path.Select(copy => fractal.LevelAt(0).Maps[copy].Linear).Prepend(Aside.Linear).ToArray();
            var expected = address.Depth == 0 ? 0 : maps.Sum(linear => Math.Log(Math.Abs(linear.Determinant())) / 3);
            Near.Equal(expected, address.LogUnit, 1e-9);
        });
    }

    [Fact]
    public void Path_IntoACorner_IsItsCopyAtEveryLevel()
    {
        var dive = Dive("menger", 7, AffineMap.Identity);
        dive.GoTo(50);
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
        var table = LodHierarchy.Build(name == "menger-4" ? DetailViews.Menger(4) : Infinite(name));
        var size = (Aside * table.NodeAt(table.LevelCount).Box.Centre).Length()
            + table.NodeAt(table.LevelCount).Box.Transform(Aside).Diagonal;
        Seeded.Run(100, random =>
        {
            var position = Aside * (table.NodeAt(table.LevelCount).Box.Centre + random.Vector(table.NodeAt(table.LevelCount).Box.Diagonal));
            var address = new FractalAddress(table, Aside, position);
            address.Move(Vector.Zero);
            Near.Equal(position, address.WorldPosition(Aside), 1e-12 * size);
            for (var i = 0; i < 10; i++)
            {
                var step = 0.5
                    * (address.FrameToCamera
                        * (table.NodeAt(table.LevelCount).Box.Centre + random.Vector(table.NodeAt(table.LevelCount).Box.Diagonal)));
                position += Math.Exp(address.LogUnit) * step;
                address.Move(step);
                Near.Equal(position, address.WorldPosition(Aside), 1e-12 * size);
            }
        });
    }

    [Fact]
    public void WorldPosition_InAFractalThatHardlyShrinks_IsThatOfTheCamera()
    {
        // After 300 levels a 10,000th of the size: as a double tells it, that is a long way.
        var map = Samples.MoveAndScale(0.03, 0, 0, 0.97);
        var table = LodHierarchy.Build(Samples.Repeated(null, map, Samples.MoveAndScale(3, 0, 0, 0.1)));
        var address = new FractalAddress(table, AffineMap.Identity, new(5, 5, 5));
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

    public static TheoryData<string, int> Finite =>
        new() { { "appendix-b", 2 }, { "menger", 3 }, { "sierpinski", 4 }, { "tetrahedron", 5 }, { "tree", 5 }, { "tree-leaves", 5 },
        { "romanesco", 2 }, { "fern", 1 }, { "snowflake", -1 }, { "shell", -1 } };

    [Theory]
    [MemberData(nameof(Finite))]
    public void Roots_OfAllAncestors_AreTheWholeFractal(string name, int depth)
    {
        var fractal = depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth);
        Seeded.Run(name == "snowflake" ? 2 : 5, random => CheckRoots(random, fractal, Aside));
    }

    [Fact]
    public void Roots_OfRandomFractals_AreTheWholeFractal() => Seeded.Run(150, random =>
    {
        var fractal = RandomFractals.Draw(random, random.Next(3) == 0 ? Composition.Componentwise : Composition.Affine);
        CheckRoots(random, fractal, random.Next(2) == 0 ? AffineMap.Identity : Aside);
    });

    [Fact]
    public void Roots_OfFewAncestors_AreThoseOfTheInnermost()
    {
        var dive = Dive("menger", 0, AffineMap.Identity);
        dive.GoTo(12);
        for (var ancestors = 0; ancestors <= 15; ancestors++)
        {
            var roots = dive.Address.CollectRoots(ancestors);
            Assert.Equal(1 + (19 * Math.Min(ancestors, dive.Address.Depth)), roots.Length);
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
    public void Move_ALongRandomWalk_KeepsNearAndDoesNotDrift(string name, int seed) =>
        Seeded.RunOne(seed, random => CheckWalk(random, LodHierarchy.Build(Infinite(name)), 15_000));

    [Theory]
    [InlineData("menger", 1)]
    [InlineData("sierpinski", 2)]
    [InlineData("tree", 3)]
    [InlineData("turned", 4)]
    [Trait("Category", "Soak")]
    public void Move_AHundredThousandSteps_KeepsNearAndDoesNotDrift(string name, int seed) =>
        Seeded.RunOne(seed, random => CheckWalk(random, LodHierarchy.Build(Infinite(name)), 100_000));

    [Theory]
    [InlineData("menger")]
    [InlineData("sierpinski")]
    [InlineData("turned")]
    [InlineData("apart")]
    public void NearestDistance_NotDeep_IsThatOfExactSearch(string name)
    {
        var fractal = Infinite(name);
        var (table, collider) = (LodHierarchy.Build(fractal), new ExactFractalCollider(fractal));
        var (box, record) = (table.NodeAt(table.LevelCount).Box, new QueryContext());
        var worst = new List<string>();
        Seeded.Run(300, random =>
        {
            var position = box.Centre + (random.Next(2) == 0 ? 1 : 0.6) * box.Size.Stretch(random.Vector());
            for (var i = 0; i < 4; i++)
            {
                Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, record, out var closest));
                var exact = (closest.Point - position).Length();
                var address = new FractalAddress(table, AffineMap.Identity, position);
                address.Move(Vector.Zero);
                var (unit, size) = (Math.Exp(address.LogUnit), State(table, address).Box.Transform(address.FrameToCamera).Diagonal);
                var found = unit * address.ClosestSurfaceDistance();
                // To a tenth, and never less than a thousandth of what is around.
                if (!(found >= 0.85 * exact && found <= Math.Max(1.15 * exact, 1.01e-3 * unit * size)))
                {
                    worst.Add(
                        Text($"at {position}, depth {address.Depth}: {found} for {exact}, a thousandth of what is around {1e-3 * unit * size}"));
                }

                // Nearer to the surface.
                position += 0.7 * (closest.Point - position);
            }
        });
        Assert.True(worst.Count == 0, $"{worst.Count} of 1200: {string.Join("\n", worst.Take(5))}");
    }

    [Fact]
    public void Move_IntoAFiniteFractal_StopsAboveTheBase()
    {
        foreach (var depth in (int[])[0, 1, 2, 3, 6])
        {
            var address = new FractalAddress(LodHierarchy.Build(DetailViews.Menger(depth)), AffineMap.Identity, new(-3, -3, -3));
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
        var dive = Dive("menger", 0, AffineMap.Identity);
        dive.GoTo(FractalLimits.MaxDepth);
        for (var i = 0; i < 1000; i++)
        {
            dive.Move(0.5 * dive.Target(Vector.Zero));
            Assert.Equal(FractalLimits.MaxDepth, dive.Address.Depth);
            Assert.True(dive.Address.FrameToCamera.IsFinite());
        }

        Assert.True(double.IsFinite(dive.Address.ClosestSurfaceDistance()));
        Assert.True(dive.Address.WorldPosition(AffineMap.Identity).IsFinite());
    }

    [Theory]
    [InlineData("skewed")]
    [InlineData("fern")]
    [InlineData("thin")]
    public void Move_WhereMapsSkewWithoutBound_StopsEntering(string name)
    {
        var fractal = Infinite(name);
        var table = LodHierarchy.Build(fractal);
        var depths = new List<int>();
        for (var copy = 0; copy < table.NodeAt(table.LevelCount).ChildMaps.Length; copy++)
        {
            if (table.NodeAt(Below(table, table.LevelCount, copy)).ChildMaps.Length == 0
                || table.NodeAt(table.LevelCount).ChildLevelSteps[copy] != 1)
            {
                continue;
            }

            var address = new FractalAddress(table, Aside, Aside * new Vector(3, 4, 5));
            var map = table.NodeAt(table.LevelCount).ChildMaps[copy].ToAffineMap();
            var target = Aside * ((Matrix.Identity + (-1 * map.Linear)).Inverse() * map.Translation);
            for (var i = 0; i < 300; i++)
            {
                address.Move(0.3 * Math.Exp(-address.LogUnit) * (target - address.WorldPosition(Aside)));
                AssertFinite(address);
            }

            depths.Add(address.Depth);
        }

        Assert.True(depths.Max() is > 0 and < 300, $"depths {string.Join(", ", depths)}");
    }

    [Fact]
    public void Memory_AtDepth_IsSomeBytesALevel()
    {
        const int depth = 50_000;
        var dive = Dive("menger", 0, AffineMap.Identity);
        while (dive.Address.Depth < depth)
        {
            dive.Address.Move(0.5 * dive.Target(Vector.Zero));
        }

        // 16 bytes, and at most twice the room.
        Assert.InRange(dive.Address.StorageBytes, 16 * depth, (32 * depth) + 1000);
    }

    [Fact]
    public void Move_FromDeepToFarAway_LeavesAtOnce()
    {
        var dive = Dive("menger", 0, AffineMap.Identity);
        dive.GoTo(500);
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
        var dive = Dive("menger", 0, placement);
        dive.GoTo(20);
        AssertFinite(dive.Address);
        Near.Equal(Math.Log(scale) - (dive.Address.Depth * Math.Log(3)), dive.Address.LogUnit, 1e-9);
        dive.GoBack();
        Assert.Equal((0, 0.0), (dive.Address.Depth, dive.Address.LogUnit));
        Near.Equal(0, (dive.Address.WorldPosition(placement) - dive.Start).Length() / dive.Start.Length(), 1e-9);
    }

    /// <summary>Infinite fractals of one set.</summary>
    internal static Fractal Infinite(string name) => name switch
    {
        "menger" => DetailViews.Menger(null),
        "sierpinski" =>
            Samples.Repeated(null,
            [.. from corner in (Vector[])[Vector.Zero, Vector.I, Vector.J, Vector.K] select Samples.MoveAndScale(corner.X, 0.5 * corner.Y,
            1.5 * corner.Z, 0.5)]),
        "turned" =>
            Samples.Repeated(null, new(new(-1, 0, 0), new(10, 20, 30), 0.45 * Vector.One),
            new(new(1, 0, 0), new(50, 0, 70), new(0.5, 0.5, -0.5)), new(new(0, 1.5, 0), Vector.Zero, 0.4 * Vector.One)),
        // Cubes that do not touch.
        "apart" =>
            new(new(
            [new Repetition(
                [new TransformationSet(
                    [.. from x in (int[])[-1, 1] from y in (int[])[-1, 1] from z in (int[])[-1, 1] select Samples.MoveAndScale(0.8 * x,
                    0.8 * y, 0.8 * z, 0.2)])], null)]), DetailViews.Cube),
        "skewed" =>
            Samples.Repeated(null, new(new(-1, 0, 0), new(0, 0, 30), new(0.5, 0.35, 0.45)),
            new(new(1, 0, 0), new(50, 0, 70), new(0.5, 0.4, 0.5)), new(new(0, 1, 0), Vector.Zero, new(0.4, 0.4, 0.35))),
        "thin" =>
            Samples.Repeated(null, new(new(-1, 0, 0), Vector.Zero, new(0.5, 0.5, 0.001)),
            new(new(1, 0, 0), Vector.Zero, new(0.1, 0.5, 0.5))),
        _ => AssetFractals.Load(name, null),
    };

    internal static FractalDive Dive(string name, int copy, AffineMap placement) =>
        new(LodHierarchy.Build(Infinite(name)), copy, placement, name switch
    {
        "menger" => copy == 0 ? -Vector.One : new(-1, 1, 0.8),
        _ => new(-1, -0.7, -0.9),
    });

    private static void CheckDive(string name, int copy, AffineMap placement, int depth, double tolerance)
    {
        var dive = Dive(name, copy, placement);
        var (about, size) = (dive.Address.FrameToCamera, dive.Start.Length() + placement.Linear.MaxAbsEntry());
        Assert.Equal((0, 0.0), (dive.Address.Depth, dive.Address.LogUnit));
        dive.GoTo(depth);
        AssertFinite(dive.Address);
        dive.GoBack();
        Assert.Equal(0, dive.Address.Depth);
        Assert.Empty(dive.Address.Path);
        Assert.Equal(0.0, dive.Address.LogUnit);
        Near.Equal(0, Near.Difference(about, dive.Address.FrameToCamera) / size, tolerance);
    }

    private static void CheckRoots(Random random, Fractal fractal, AffineMap placement)
    {
        var table = LodHierarchy.Build(fractal);
        var top = table.NodeAt(table.LevelCount);
        if (top.IsEmpty)
        {
            return;
        }

        var position = placement * (top.Box.Centre + top.Box.Size.Stretch(random.Vector()));
        var address = new FractalAddress(table, placement, position);
        address.Move(Vector.Zero);
        // Deeper: to a corner of some sub-fractal, several times.
        for (var i = 0; i < 5; i++)
        {
            var step = 0.9
                * (address.FrameToCamera
                    * (State(table, address).Box.Centre + (0.5 * State(table, address).Box.Size.Stretch(random.Vector()))));
            position += Math.Exp(address.LogUnit) * step;
            address.Move(step);
        }

        var unit = Math.Exp(address.LogUnit);
        var found = new List<AffineMap>();
        foreach (var root in address.CollectRoots(int.MaxValue))
        {
            AddInstances(found, table, root.RemainingLevels, new(unit * root.FrameToCamera.Linear, unit * root.FrameToCamera.Translation));
        }

        // Of the table: of what overlaps beyond the end of a repetition, it has some twice (docs/colliders.md).
        var (expected, shift) = (new List<AffineMap>(), AffineMap.Translate(-position) * placement);
        AddInstances(expected, table, table.LevelCount, shift);
        DetailViews.AssertEachOnce([.. expected], found);
        var distinct = FractalGenerator.Expand(fractal, 2_000_000).Select(instance => shift * instance).ToArray();
        Assert.All(DetailViews.Count(distinct, found), count => Assert.True(count >= 1));
    }

    private static void AddInstances(List<AffineMap> found, LodHierarchy table, long levels, AffineMap map)
    {
        var state = table.NodeAt(levels);
        if (state.ChildMaps.Length == 0)
        {
            if (!state.IsEmpty)
            {
                found.Add(map);
            }

            return;
        }

        for (var child = 0; child < state.ChildMaps.Length; child++)
        {
            AddInstances(found, table, state.ChildLevelSteps[child] < 0
                ? ~state.ChildLevelSteps[child]
                : levels - state.ChildLevelSteps[child], map * state.ChildMaps[child].ToAffineMap());
        }
    }

    /// <summary>Goes into sub-fractals and out of them; wherever it is not deep, its place is compared with the sum of the steps.</summary>
    private static void CheckWalk(Random random, LodHierarchy table, int steps)
    {
        var (position, size) = (Aside * new Vector(2, 1, -2), table.NodeAt(table.LevelCount).Box.Transform(Aside).Diagonal);
        var address = new FractalAddress(table, Aside, position);
        address.Move(Vector.Zero);
        var (deepest, compared, isGoingIn) = (0, 0, true);
        for (var i = 0; i < steps; i++)
        {
            var state = State(table, address);
            // In for some levels, then out again.
            isGoingIn = isGoingIn ? address.Depth < 30 && random.Next(200) > 0 : address.Depth == 0 || random.Next(500) == 0;
            var step = isGoingIn
                ? random.Between(0.1, 0.6) * (address.FrameToCamera * (state.Box.Centre + (0.5 * state.Box.Size.Stretch(random.Vector()))))
                // Away from what is near, to some side.
                : random.Between(0.2, 2) * state.Box.Transform(address.FrameToCamera).Diagonal
                * ((0.7 * random.Direction()) - (address.FrameToCamera * state.Box.Centre).UnitVector());
            position += Math.Exp(address.LogUnit) * step;
            address.Move(step);
            AssertFinite(address);
            state = State(table, address);
            var camera = address.FrameToCamera.Inverse() * Vector.Zero;
            Assert.True(
                address.Depth == 0 || Math.Sqrt(state.Box.DistanceSquared(camera)) <= 1.001 * Left * state.Box.Diagonal,
                Text($"step {i}: too far away at depth {address.Depth}"));
            deepest = Math.Max(deepest, address.Depth);
            if (address.Depth <= 6)
            {
                compared++;
                Near.Equal(position, address.WorldPosition(Aside), 1e-9 * size);
            }

            if (position.Length() > 20 * size)
            {
                var back = Math.Exp(-address.LogUnit) * -position;
                position = position + (Math.Exp(address.LogUnit) * back);
                address.Move(back);
            }
        }

        Assert.True(deepest >= 6 && compared >= steps / 100, Text($"deepest {deepest}, compared {compared} times"));
    }

    private static void Wander(Random random, FractalAddress address, int steps)
    {
        for (var i = 0; i < steps; i++)
        {
            address.Move(random.Between(0, 0.5) * (address.FrameToCamera * random.Vector()));
        }
    }

    private static LodNode State(LodHierarchy table, FractalAddress address)
    {
        var levels = table.LevelCount;
        foreach (var copy in address.Path)
        {
            levels = Below(table, levels, copy);
        }

        return table.NodeAt(levels);
    }

    private static long Below(LodHierarchy table, long levels, int copy) =>
        table.NodeAt(levels).ChildLevelSteps[copy] switch { < 0 and var down => ~down, var down => levels - down };

    private static void AssertFinite(FractalAddress address) => Assert.True(
        address.FrameToCamera.IsFinite() && double.IsFinite(address.LogUnit) && address.FrameToCamera.Linear.Determinant() != 0,
        Text($"at depth {address.Depth}: {address.FrameToCamera}, {address.LogUnit}"));

    private static string Text(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);
}
