using System.Collections.Immutable;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.Sky;
using FractalEngine.Core.Visibility.SkyBaking;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Visibility;

/// <summary>Parts of the sky that the sides of instances see, where they are known in closed form.</summary>
public class SkyVisibilityTests
{
    // 64 directions of a cosine lobe.
    private const double Tolerance = 0.04;

    // Likewise, by a majority of at most seven points anywhere in the middle third of a side, for its very middle.
    private const double MiddleTolerance = 0.15;

    [Fact]
    public void Bake_OfPartsThatOverlapOnManyLevels_EndsAtOnceWithoutMasks()
    {
        // A ray enters nearly all of 4^50 parts that are larger than a fifteenth of the whole.
        static Transformation Map(double x, double y, double z) => new(new(x, y, z), new(10, 10, 20), 0.95 * Vector.One);
        var fractal = Fractal.Of(Shapes.Cube())
            .Repeat([Map(0.3, 0, 0), Map(0, 0, 0.3), Map(0, 0.3, 0), Map(0.3, 0.3, 0)], 60);
        var hierarchy = LodHierarchy.Build(fractal);
        ProcessorTime.RunWithin(10, () => SkyMaskBaker.Bake(hierarchy, 1));
        Assert.False(hierarchy.HasSkyMasks);
    }

    [Theory]
    // A thousandth of its size a level further: after a hundred levels, sizes underflow.
    [InlineData(400, 1e-3)]
    // Half a turn a level further.
    [InlineData(1_000_000_000, 1)]
    public void Bake_OfALongChainOfOnlyChildren_Ends(int depth, double scale)
    {
        // Two cubes side by side, each at the end of a chain.
        var pair = new Repetition([new TransformationSet([Move(-2, 0, 0), new(new(2, 0, 0), new(0, 30, 0), Vector.One)])], 1);
        var chain = new Repetition([new TransformationSet([new(Vector.Zero, new(0, 180, 0), scale * Vector.One)])], depth);
        var hierarchy = LodHierarchy.Build(new Fractal(new FractalDescription([pair, chain], Composition.Affine), RenderScenes.Cube(1)));
        ProcessorTime.RunWithin(10, () => SkyMaskBaker.Bake(hierarchy, 1));
        Assert.True(hierarchy.IsSkyBaked);
    }

    [Theory]
    // From the plane of a side, along it: through the box, and past it.
    [InlineData(1, 0, -5, 0, 4)]
    [InlineData(-1, 0, -5, 0, 4)]
    [InlineData(1, 3, -5, 0, double.PositiveInfinity)]
    // Beside it, and behind it.
    [InlineData(1.5, 0, -5, 0, double.PositiveInfinity)]
    [InlineData(1, 0, 5, 0, double.PositiveInfinity)]
    // Across.
    [InlineData(0, 0, -5, 0.1, 4)]
    public void EntryOf_ARayWithinASide_IsThatOfTheBox(double x, double y, double z, double across, double expected)
    {
        var hierarchy = LodHierarchy.Build(CubesAt([Move(0, 0, 0), Move(100, 0, 0)]));
        var whole = hierarchy.NodeAt(hierarchy.LevelCount);
        var child = Array.Find(
            SkyChild.ChildrenOf(hierarchy, whole, hierarchy.LevelCount), static child => child.Inverse.Translation == Vector.Zero);
        Assert.Equal(expected, child.EntryOf(new(x, y, z), new(1 / across, 1 / 0.0, 1)), 1e-9);
        Assert.Equal(expected, child.EntryOf(new(x, y, z), new(1 / -across, 1 / -0.0, 1)), 1e-9);
    }

    [Fact]
    public void VisiblePart_OfAHalfSky_IsAHalfForSurfacesUpright()
    {
        var above = 0ul;
        for (var i = 0; i < SkyDirections.Count; i++)
        {
            above |= SkyDirections.At(i).Y > 0 ? 1ul << i : 0;
        }

        Assert.Equal(1, SkyDirections.VisiblePart(above, ToVector256(Vector.J)), 1e-5);
        Assert.Equal(0, SkyDirections.VisiblePart(above, ToVector256(-Vector.J)), 1e-5);
        Assert.Equal(0.5, SkyDirections.VisiblePart(above, ToVector256(Vector.I)), Tolerance);
        Assert.Equal(1, SkyDirections.VisiblePart(ulong.MaxValue, ToVector256(new Vector(1, 2, 3))), 1e-5);
    }

    [Fact]
    public void Top_OfACubeUnderAnother_SeesWhatIsLeftOfTheSky()
    {
        // A square of the half size a at the height c hides 4 / 2π · 2 · s · atan(s) of a point below its middle, with s = a / √(a² + c²).
        var s = 1 / Math.Sqrt(2);
        var parts = PartsOf(Move(0, 0, 0), Move(0, 3, 0));
        Assert.Equal(1 - (4 / Math.PI * s * Math.Atan(s)), parts[1], MiddleTolerance);
        Assert.Equal(1, parts[4], MiddleTolerance);
    }

    [Fact]
    public void Top_OfACubeInACorner_SeesMoreThanHalfTheSky()
    {
        // A long wall of the height h over the top, at the distance w from its middle, hides (1 − w / √(w² + h²)) / 2 of the sky.
        var wall = new Transformation(new(1.5, 1, 0), Vector.Zero, new(0.5, 4, 6));
        Assert.Equal(1 - (0.5 * (1 - (1 / Math.Sqrt(17)))), PartsOf(Move(0, 0, 0), wall)[1], MiddleTolerance);
    }

    [Fact]
    public void Floor_OfASlot_SeesTheSineOfItsOpening()
    {
        // Between two long walls of the height h at the distance w on both sides, sin(atan(w / h)) of the sky is left.
        var parts = PartsOf(
            Move(0, 0, 0), new(new(-1.5, 0, 0), Vector.Zero, new(0.5, 3, 6)), new(new(1.5, 0, 0), Vector.Zero, new(0.5, 3, 6)));
        Assert.Equal(Math.Sin(Math.Atan(1 / 2.0)), parts[1], MiddleTolerance);
    }

    [Theory]
    [InlineData(-3, -3, 5, 0b100011)]
    [InlineData(3, 3, 5, 0b111000)]
    [InlineData(0, 0, 5, 0b100000)]
    public void VisibleSides_OfACube_AreThoseBeforeTheEye(double x, double y, double z, int expected)
    {
        var sides = new VisibleSides(RenderScenes.Cube(1));
        var map = new SimdAffineMap(AffineMap.Translate(new(x, y, z)));
        Assert.Equal(expected, sides.FindVisible(in map, isPerspective: true, isMirroredView: false, 1));
        // Parallel rays along z see one side.
        Assert.Equal(0b100000, sides.FindVisible(in map, isPerspective: false, isMirroredView: false, 1) & 0b100100);
        // From outside and from inside, the sides of all planes towards the eye, and in a mirrored frame all.
        var open = sides.FindVisible(in map, isPerspective: true, isMirroredView: false, 0);
        Assert.Equal(expected, open & expected);
        Assert.Equal(VisibleSides.All, sides.FindVisible(in map, isPerspective: true, isMirroredView: true, 1));
    }

    [Theory]
    [InlineData(-3, -3, 5, true, 0b100011)]
    [InlineData(3, 3, 5, true, 0b111000)]
    [InlineData(-3, 3, -5, true, 0b010101)]
    // Parallel rays come from −z, wherever the mesh is.
    [InlineData(-3, 3, -5, false, 0b100011)]
    public void FindFacing_GivesTheSidesTowardsTheEye(double x, double y, double z, bool isPerspective, int expected)
    {
        var sides = new VisibleSides(RenderScenes.Sphere(8));
        foreach (var scale in (double[])[0.5, -0.5])
        {
            var map = new SimdAffineMap(new AffineMap(Matrix.Diagonal(new(1, scale, 1)), new(x, y, z)));
            // A mirrored frame has its sides of ±y exchanged.
            var mirrored = (expected & 0b101101) | ((expected & 0b010010) == 2 ? 16 : 2);
            Assert.Equal(scale > 0 || !isPerspective ? expected : mirrored, sides.FindFacing(in map, isPerspective));
        }
    }

    // Pillars: each level halves the width and keeps or stretches the height. What sees two fifths of the sky is not black.
    [Theory]
    [InlineData(1.25, 0.7, 1, 0.55)]
    [InlineData(0.6, 0.5, 0.55, 0.58)]
    [InlineData(0.5, 0.5, 0.5, 0.5)]
    public void Parts_OfAFractalThatStretchesAnAxis_AreNotBlackWhereTheSkyIsOpen(double s1, double s2, double s3, double s4)
    {
        static Transformation Pillar(double x, double z, double height) => new(new(x, 0, z), Vector.Zero, new(0.5, height, 0.5));
        var fractal = Fractal.Of(Shapes.Cube())
            .Repeat([Pillar(-0.5, -0.5, s1), Pillar(0.5, -0.5, s2), Pillar(-0.5, 0.5, s3), Pillar(0.5, 0.5, s4)], 5);
        var hierarchy = LodHierarchy.Build(fractal);
        SkyMaskBaker.Bake(hierarchy, 1);
        var occluder = new SkyOccluder(hierarchy, 1);
        var (node, levels) = occluder.Nodes[0];
        var (random, sample, path, parts) = (new Random(1), new SkySample(), new SkyPath(), new float[AmbientCube.Count]);
        var (blackened, open) = (0, 0);
        for (var i = 0; i < 3000; i++)
        {
            if (!occluder.TrySample(node, levels, random, sample))
            {
                continue;
            }

            var (free, _) = occluder.FreeDirections(node, levels, -1, sample.Point, SkyDirections.Above(sample.Normal));
            if (SkyDirections.VisiblePart(free, ToVector256(sample.Normal)) > 0.4)
            {
                path.Set(sample.Steps);
                path.ComputeParts(hierarchy, sample.Leaf!, sample.Steps.Count, 0, VisibleSides.All, parts);
                var part = AmbientCube.Blend(parts, (sample.FromMesh.Linear.Transpose() * sample.Normal).UnitVector());
                blackened += part < 0.05 ? 1 : 0;
                open++;
            }
        }

        // Hidden directions of a whole cell are those of its few voting points.
        Assert.InRange(open, 200, 3000);
        Assert.InRange(blackened, 0, open / 100);
    }

    [Fact]
    public void Apply_OfManyInstancesBetweenTwoCells_GivesBothInProportion()
    {
        // Free from the middle cell on, along x.
        var masks = new ulong[SkyMasks.MaskCount];
        for (var i = 0; i < masks.Length; i++)
        {
            masks[i] = i / AmbientCube.Count % SkyMasks.GridSize >= 2 ? ulong.MaxValue : 0;
        }

        var sky = new SkyMasks([masks], [new(new(Vector.Zero, Vector.One), Matrix.Identity, null)]);
        for (var x = -0.1; x < 1.1; x += 0.01)
        {
            Assert.Equal(Math.Clamp((4 * x) - 1, 0, 1), MeanPart(sky, 0, 1, new(x, 1.001, 0.3)), 0.01);
        }

        // Across a surface, what lies in a side of the box is told from what lies below it, whatever the hash.
        Assert.Equal((0, 1), (MeanPart(sky, 0, 3, new(-0.001, 0.5, 0.5)), MeanPart(sky, 0, 0, new(1.001, 0.5, 0.5))));
    }

    [Fact]
    public void Parts_OnBothSidesOfASharedEdge_Agree()
    {
        // Two cubes that touch, beside a wall, which hides the more the closer a place is.
        var wall = new Transformation(new(4, 1, 0), Vector.Zero, new(0.5, 4, 6));
        var hierarchy = LodHierarchy.Build(CubesAt([Move(0, 0, 0), Move(2, 0, 0), wall]));
        SkyMaskBaker.TryBake(hierarchy, 1, keepsAll: true);
        var node = hierarchy.NodeAt(hierarchy.LevelCount);
        var masks = hierarchy.SkyMasksAt(node, hierarchy.LevelCount)!;
        var occluder = new SkyOccluder(hierarchy, 1);
        var before = double.NaN;
        for (var x = -1.0; x <= 3; x += 0.25)
        {
            var part = MeanPartAt(x < 1 ? 0 : 2, x);
            var (free, _) = occluder.FreeDirections(node, hierarchy.LevelCount, -1, new(x, 1.001, 0), SkyDirections.Above(Vector.J));
            Assert.Equal(SkyDirections.VisiblePart(free, ToVector256(Vector.J)), part, 0.1);
            Assert.False(Math.Abs(part - before) > 0.08, $"{before} before {x}, {part} at it");
            before = part;
        }

        // The cell at an end has votes of its inner half only: each is an eighth of a cube off, on the mean a sixteenth.
        Assert.Equal(MeanPartAt(0, 1), MeanPartAt(2, 1), 0.08);

        double MeanPartAt(double place, double x)
        {
            var child = Array.FindIndex(node.ChildMaps, map => Math.Abs(map.Translation[0] - place) < 1e-9);
            return MeanPart(masks, child, 1, new(x - place, 1.001, 0));
        }
    }

    [Fact]
    public void Parts_OfASponge_AreCloseToRays()
    {
        var hierarchy = LodHierarchy.Build(AssetFractals.Load("menger", 3));
        SkyMaskBaker.Bake(hierarchy, 1);
        var occluder = new SkyOccluder(hierarchy, 1);
        var (node, levels) = occluder.Nodes[0];
        var (random, sample, path, parts) = (new Random(2), new SkySample(), new SkyPath(), new float[AmbientCube.Count]);
        var (sum, squares, count) = (0.0, 0.0, 0);
        for (var i = 0ul; i < 4000; i++)
        {
            if (occluder.TrySample(node, levels, random, sample))
            {
                var (free, _) = occluder.FreeDirections(node, levels, -1, sample.Point, SkyDirections.Above(sample.Normal));
                path.Set(sample.Steps);
                path.ComputeParts(hierarchy, sample.Leaf!, sample.Steps.Count, i * HashMixing.GoldenGamma, VisibleSides.All, parts);
                var error = AmbientCube.Blend(parts, (sample.FromMesh.Linear.Transpose() * sample.Normal).UnitVector())
                    - SkyDirections.VisiblePart(free, ToVector256(sample.Normal));
                sum += error;
                squares += error * error;
                count++;
            }
        }

        Assert.InRange(Math.Abs(sum / count), 0, 0.02);
        Assert.InRange(10 * Math.Log10(count / squares), 19, 60);
    }

    [Fact]
    public void Masks_OfADeepFractal_AreShared()
    {
        var hierarchy = LodHierarchy.Build(AssetFractals.Load("menger", 12));
        SkyMaskBaker.Bake(hierarchy, 1);
        Assert.True(hierarchy.HasSkyMasks);
        Assert.Same(hierarchy.NodeAt(12).SkyMasks, hierarchy.NodeAt(5).SkyMasks);
        Assert.InRange(hierarchy.SkyMaskBytes, 1, 500_000);
    }

    [Fact]
    public void Bake_OfTheSameFractal_GivesTheSameMasks()
    {
        var fractal = AssetFractals.Load("romanesco", 2);
        var (first, second) = (LodHierarchy.Build(fractal), LodHierarchy.Build(fractal));
        SkyMaskBaker.Bake(first, 1);
        SkyMaskBaker.Bake(second, 1);
        var root = first.NodeAt(first.LevelCount);
        var (parts1, parts2) = (new float[AmbientCube.Count], new float[AmbientCube.Count]);
        var path = new SkyPath();
        for (var child = 0; child < root.ChildMaps.Length; child++)
        {
            path.Set(0, new(root, first.LevelCount, child));
            path.ComputeParts(first, first.NodeAt(0), 1, 0, VisibleSides.All, parts1);
            path.Set(0, new(second.NodeAt(second.LevelCount), second.LevelCount, child));
            path.ComputeParts(second, second.NodeAt(0), 1, 0, VisibleSides.All, parts2);
            Assert.Equal(parts1, parts2);
        }
    }

    [Fact]
    public void Bake_WhereNothingHidesTheSky_LeavesNoMasks()
    {
        // Two small cubes far apart: masks would tell nothing.
        var fractal = CubesAt([Move(0, 0, 0), Move(500, 0, 0)]);
        var hierarchy = LodHierarchy.Build(fractal);
        SkyMaskBaker.Bake(hierarchy, 1);
        Assert.Equal((true, false, 0), (hierarchy.IsSkyBaked, hierarchy.HasSkyMasks, hierarchy.SkyMaskBytes));
    }

    [Fact]
    public void OpenSky_OfTurnedPlanes_IsKnownWithoutABake()
    {
        // Squares in the plane z = 0: side by side, turned within it, out of it, and beside it.
        Assert.True(SquaresAt(Move(0, 0, 0), new(new(3, 0, 0), new(0, 0, 40), new(0.5, 0.5, 1))).HasOpenSky());
        Assert.False(SquaresAt(Move(0, 0, 0), new(new(3, 0, 0), new(0, 1, 0), Vector.One)).HasOpenSky());
        Assert.False(SquaresAt(Move(0, 0, 0), Move(3, 0, 1e-3)).HasOpenSky());
        var flat = SquaresAt(Move(0, 0, 0), Move(3, 0, 0));
        SkyMaskBaker.Bake(flat, 0);
        Assert.False(flat.HasSkyMasks);
        // A single cube, however often its only map is applied.
        Assert.True(LodHierarchy.Build(CubesAt([Move(0, 1, 0)])).HasOpenSky());
        Assert.False(LodHierarchy.Build(CubesAt([Move(0, 1, 0), Move(5, 0, 0)])).HasOpenSky());
    }

    [Fact]
    public void Bake_Cancelled_LeavesNothingAndCanBeRepeated()
    {
        var hierarchy = LodHierarchy.Build(AssetFractals.Load("menger", 3));
        Assert.ThrowsAny<OperationCanceledException>(() => SkyMaskBaker.Bake(hierarchy, 1, new(canceled: true)));
        Assert.Equal((false, false), (hierarchy.IsSkyBaked, hierarchy.HasSkyMasks));
        SkyMaskBaker.Bake(hierarchy, 1);
        Assert.True(hierarchy.HasSkyMasks);
    }

    /// <summary>Computes the mean part of the sky that a place of a side sees, of many instances.</summary>
    private static double MeanPart(SkyMasks masks, int child, int side, Vector point)
    {
        const int Count = 2000;
        var sum = 0.0;
        for (var i = 1ul; i <= Count; i++)
        {
            Span<SideVisibility> visibility = [new(side, ToVector256(point))];
            masks.Apply(child, SkyDither.Of(i * HashMixing.GoldenGamma), visibility);
            sum += SkyDirections.VisiblePart(visibility[0].Mask, side);
        }

        return sum / Count;
    }

    private static Vector256<double> ToVector256(Vector normal) => SimdAffineMap.ToVector256(normal);

    private static Fractal CubesAt(ImmutableArray<Transformation> cubes) =>
        new(new FractalDescription([new Repetition([new TransformationSet(cubes)], 1)], Composition.Affine), RenderScenes.Cube(1));

    private static LodHierarchy SquaresAt(params ImmutableArray<Transformation> squares) => LodHierarchy.Build(
        new Fractal(
            new FractalDescription([new Repetition([new TransformationSet(squares)], 2)], Composition.Affine), RenderScenes.Square(1)));

    private static Transformation Move(double x, double y, double z) => RenderScenes.TranslatedTo(x, y, z);

    /// <summary>Returns the parts of the sides of the first of some cubes, which is at its place: +x, +y, +z, −x, −y, −z.</summary>
    private static float[] PartsOf(params ImmutableArray<Transformation> cubes)
    {
        var hierarchy = LodHierarchy.Build(CubesAt(cubes));
        SkyMaskBaker.TryBake(hierarchy, 1, keepsAll: true);
        // Each of the sides but that of +z is seen from one of two places; 1 stands for those that are not.
        var above = PartsOf(hierarchy, cubes[0].Position, new(2000, 2000, -2000));
        var below = PartsOf(hierarchy, cubes[0].Position, new(-2000, -2000, -2000));
        return [.. above.Zip(below, Math.Min)];
    }

    private static float[] PartsOf(LodHierarchy hierarchy, Vector cube, Vector eye)
    {
        var visible = new VisibleSet();
        var settings = new CullingSettings
        {
            SkyVisibility = true, FrustumCulling = false, OcclusionCulling = false, MinProjectedSize = 0, ThreadCount = 1,
        };
        var view = new CullingView(eye, Matrix.Identity, true, 0.5, 640, 640, 1, 0.1, 10_000);
        visible.Cull(in view, [new(hierarchy, AffineMap.Identity, Vector.Zero, 1) { HasSkyMasks = true }], settings);
        for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
        {
            var rows = visible.Instances(0, chunk);
            for (var i = 0; i < rows.Length / VisibleSet.FloatsPerInstance; i++)
            {
                var translation = new Vector(rows[(12 * i) + 3], rows[(12 * i) + 7], rows[(12 * i) + 11]) + eye;
                if ((translation - cube).Length() < 1e-3)
                {
                    return visible.SkyParts(0, chunk).Slice(6 * i, 6).ToArray();
                }
            }
        }

        throw new InvalidOperationException("the first cube is not visible");
    }
}
