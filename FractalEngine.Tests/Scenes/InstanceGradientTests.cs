using FractalEngine.Core.Colliders;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Parsing;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;
using static System.FormattableString;

namespace FractalEngine.Tests.Scenes;

/// <summary>Where instances stand in gradients with palettes and of places, and the mean colours of proxies.</summary>
public class InstanceGradientTests
{
    private const string Tree =
        "z<box>. [#, ((1.5, 0.2, 0), (0, 20, 0), (0.7)), ((-2, 1, 0), #, (0.6))] box\n<$>. z 4";

    private const string Cubes =
        "z<box>. [((3, 0, 0), #, (0.5)), ((-3, 0, 1), (20, 0, 0), (0.5, 0.3, -0.4)), ((0, 3, 0), #, (0.5))] box\n<$>. z 3";

    private const string TwoMeshes =
        "l. ball\nb. box\ns. ((1, 0.9, 0), (0, 0, 40), (0.6))\n"
        + "z<l>. [((0, 1.2, 0), (0, 60, 9), (0.7))] l + [(#, (0, 120, 0), #)^0..2] [s.] l + b\n<$>. z 4";

    private const string TwoRecursives =
        "x<box>, y<ball>. [((3, 0, 0), #, (0.5))] box + [((0, 4, 0), #, (0.4))] ball + cone, "
        + "box + [((2, 1, 2), #, (0.5))] ball\n<$>. x 4";

    private static readonly Palette Colours = Palette.OfEven(
        new Colour(0.1, 0, 0.4), new Colour(0.9, 0.2, 0.1), new Colour(0.2, 0.9, 0.3), new Colour(1, 1, 0.8));

    /// <summary>What culling gives to an instance is what the definition says, and what a query of it says.</summary>
    [Theory]
    [InlineData(Tree)]
    [InlineData(Cubes)]
    [InlineData(TwoMeshes)]
    [InlineData(TwoRecursives)]
    public void Shades_OfInstances_AreThoseOfTheirPathsAndPlaces(string text)
    {
        var fractal = Read(text);
        var whole = LodHierarchy.Build(fractal);
        foreach (var kind in Enum.GetValues<GradientKind>().Skip(1))
        {
            var gradient = Gradient.Of(kind, Colours);
            var traced = new InstanceGradient(gradient, whole);
            var (count, checkedCount, factors) = (0, 0, new HashSet<double>());
            foreach (var (found, map, path, mesh) in FindInstances(fractal, gradient))
            {
                count++;
                if (path is null)
                {
                    continue;
                }

                checkedCount++;
                var expected = Factor(fractal, fractal.BaseMeshes[mesh], kind, map, path);
                factors.Add(Math.Round(expected, 6));
                // Single precision, of maps that lead there in another order.
                Assert.True(Math.Abs(expected - found.Factor) < 2e-5, Invariant($"{kind}: {found.Factor}, expected {expected}"));
                Near.Equal(Colours.ColourAt(expected), found.Colour, 1e-4);
                // The nearest approach is kept in single precision.
                Near.Equal(expected, traced.ShadeOf([.. path.Select(static step => step.Index)]).Factor, 1e-6);
            }

            Assert.True(
                checkedCount > 0.6 * count && (factors.Count > 3 || (kind == GradientKind.Level && factors.Count > 0)),
                Invariant($"{kind}: {checkedCount} of {count}, {factors.Count} positions"));
        }
    }

    /// <summary>
    /// The colour of a proxy beside the mean of all instances of its sub-fractal, weighted by area: the same by level, within the
    /// palette's range by others.
    /// </summary>
    [Theory]
    [InlineData(Tree, 0.3)]
    [InlineData(Cubes, 0.3)]
    public void Shades_OfProxies_AreMeansOfWhatTheyStandFor(string text, double maxError)
    {
        var fractal = Read(text);
        var hierarchy = LodHierarchy.Build(fractal);
        foreach (var kind in Enum.GetValues<GradientKind>().Skip(1))
        {
            var shading = new InstanceGradient(Gradient.Of(kind, Colours), hierarchy);
            var (largest, sum, count) = (0.0, 0.0, 0);
            Visit(ColourPath.Start, hierarchy.Start, AffineMap.Identity, 0);
            // Of parts as large as half of the fractal, with a palette of all colours; those of a pixel differ by so much less.
            Assert.True(largest < (kind == GradientKind.Level ? 1e-9 : maxError), Invariant($"{kind}: {largest} of {count}"));
            Assert.True(sum / count < (kind == GradientKind.Level ? 1e-9 : 0.1), Invariant($"{kind}: {sum / count} on the mean"));

            (Vector Colour, double Weight) Visit(ColourPath path, LevelState state, AffineMap map, int depth)
            {
                var node = hierarchy.NodeAt(state.Level);
                var shade = shading.ShadeOf(in path, node, state.Level, new(map));
                if (node.ChildMaps.Length == 0)
                {
                    return (shade.Colour, Math.Pow(Math.Abs(map.Linear.Determinant()), 2.0 / 3));
                }

                var (colours, weight) = (Vector.Zero, 0.0);
                for (var i = 0; i < node.ChildMaps.Length; i++)
                {
                    var childMap = map * node.ChildMaps[i].ToAffineMap();
                    var child = path.Append(node.ChildMapIndices[i], node.SetSize);
                    child = node.ChildMapIndices[i] < 0 ? child : shading.PassBy(child, new(childMap));
                    var (colour, area) = Visit(child, hierarchy.Enter(node, i, state), childMap, depth + 1);
                    (colours, weight) = (colours + (area * colour), weight + area);
                }

                // The whole fractal is not drawn as one proxy.
                if (depth > 0)
                {
                    var error = Near.Difference(colours / weight, shade.Colour);
                    (largest, sum, count) = (Math.Max(largest, error), sum + error, count + 1);
                }

                return (colours / weight, weight);
            }
        }
    }

    /// <summary>No instance of a sub-fractal stands outside of the interval that its proxy's colour is the mean of.</summary>
    [Theory]
    [InlineData(Tree)]
    [InlineData(Cubes)]
    [InlineData("z<box>. [((9, 0, 0), (0, 80, 30), (0.2, 1, 0.1)), ((0, -7, 1), (50, 0, 0), (-0.9))] box\n<$>. z 6")]
    [InlineData("z<box>. [((0.1, 5, 0), (0, 90, 0), (1)), ((4, 0, 0.2), #, (0.05, 2, 0.5))] box\n<$>. z 6")]
    public void Intervals_OfProxies_HoldAllInstances(string text)
    {
        var hierarchy = LodHierarchy.Build(Read(text));
        foreach (var kind in new[] { GradientKind.Path, GradientKind.Height, GradientKind.Distance, GradientKind.Trap })
        {
            var shading = new InstanceGradient(Gradient.Of(kind, Colours), hierarchy);
            var count = 0;
            Visit(ColourPath.Start, hierarchy.Start, AffineMap.Identity);
            Assert.InRange(count, 20, 1000);

            (double Least, double Most) Visit(ColourPath path, LevelState state, AffineMap map)
            {
                var node = hierarchy.NodeAt(state.Level);
                var (from, to) = shading.IntervalOf(in path, node, state.Level, new(map));
                var (least, most) = node.ChildMaps.Length == 0 ? (from, to) : (double.PositiveInfinity, double.NegativeInfinity);
                for (var i = 0; i < node.ChildMaps.Length; i++)
                {
                    var childMap = map * node.ChildMaps[i].ToAffineMap();
                    var child = shading.PassBy(path.Append(node.ChildMapIndices[i], node.SetSize), new(childMap));
                    var (first, last) = Visit(child, hierarchy.Enter(node, i, state), childMap);
                    (least, most) = (Math.Min(least, first), Math.Max(most, last));
                }

                // Paths and approaches are kept in single precision.
                Assert.True(from <= least + 1e-6 && most <= to + 1e-6, Invariant($"{kind}: {least}..{most} in {from}..{to}"));
                count++;
                return (least, most);
            }
        }
    }

    [Fact]
    public void ShadeOf_SomeLevelsDeep_IsThatOfTheWholeFractal()
    {
        var fractal = FractalAddressTests.CreateInfinite("menger").WithDepth(6);
        var hierarchy = LodHierarchy.Build(fractal);
        var whole = RayCaster.For(fractal);
        var dive = new FractalDive(hierarchy, 7, AffineMap.Identity, new(-1, 1, 0.8));
        dive.GoToDepth(3);
        var roots = dive.Address.CollectRoots(64);
        var caster = new DeepZoomRayCaster(fractal, roots);
        var eye = dive.Address.WorldPosition(AffineMap.Identity);
        var gradients = Enum.GetValues<GradientKind>().Skip(1)
            .Select(kind => new InstanceGradient(Gradient.Of(kind, Colours), hierarchy)).ToArray();
        var context = new QueryContext();
        var hits = 0;
        Seeded.Run(200, random =>
        {
            var ray = new Ray(eye, random.Vector(1));
            if (!whole.TryFindNearest(ray, context, out var hit) || hit.Distance < 1e-6)
            {
                return;
            }

            var expected = Array.ConvertAll(gradients, gradient => gradient.ShadeOf(context.InstancePath));
            var path = context.InstancePath.ToArray();
            Assert.True(caster.TryFindNearest(new(Vector.Zero, ray.Direction), context, out _, out var rootIndex));
            // At an edge, either of two instances may be hit.
            if (Math.Abs(caster.GradientFactorOf(GradientKind.Path, rootIndex, context)
                - ColourPath.GradientFactorOf(fractal, GradientKind.Path, path)) > 1e-6)
            {
                return;
            }

            for (var i = 0; i < gradients.Length; i++)
            {
                var found = caster.ShadeOf(gradients[i], rootIndex, context);
                Near.Equal(expected[i].Factor, found.Factor, 1e-6);
                Near.Equal(expected[i].Colour, found.Colour, 1e-5);
            }

            hits++;
        });
        Assert.InRange(hits, 15, 200);

        // Culling from the same roots.
        foreach (var gradient in gradients)
        {
            var item = new CulledObject(hierarchy, AffineMap.Identity, Vector.Zero, 0)
            {
                Roots = roots, GradientKind = gradient.Gradient.Kind, Shading = gradient,
            };
            var set = new VisibleSet();
            set.Cull(CullingViews.CreateView(Vector.Zero, Vector.K), [item], CullingViews.NoCulling with { MinProjectedSize = 4 });
            for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
            {
                Assert.All(set.GradientFactors(0, chunk).ToArray(), static factor => Assert.InRange(factor, 0f, 1f));
            }
        }
    }

    [Fact]
    public void CreateOrNull_OfWhatNeedsNone_IsNull()
    {
        var model = new FractalModel(Read(Tree));
        Assert.Null(InstanceGradient.CreateOrNull(null, model));
        Assert.Null(InstanceGradient.CreateOrNull(new(GradientKind.Level, Colour.White), model));
        Assert.Null(InstanceGradient.CreateOrNull(Gradient.Of(GradientKind.None, Colours), model));
        Assert.NotNull(InstanceGradient.CreateOrNull(new(GradientKind.Height, Colour.White), model));
        Assert.Null(InstanceGradient.CreateOrNull(Gradient.Of(GradientKind.Height, Colours), LodHierarchy.Build(Samples.Tetrahedron)));
    }

    [Fact]
    public void Cull_WithAPalette_AllocatesNothing()
    {
        var hierarchy = LodHierarchy.Build(CullingViews.Menger(3));
        foreach (var kind in Enum.GetValues<GradientKind>().Skip(1))
        {
            var item = new CulledObject(hierarchy, AffineMap.Identity, Vector.Zero, 0)
            {
                GradientKind = kind, Shading = new(Gradient.Of(kind, Colours), hierarchy),
            };
            var set = new VisibleSet();
            var view = CullingViews.CreateView(new(2, 1, -3), Vector.Zero);
            CulledObject[] items = [item];
            var cull = () => set.Cull(in view, items, CullingViews.NoCulling);
            cull();
            Assert.InRange(Allocation.Measure(cull), 0, 100);
        }
    }

    /// <summary>The position in a gradient by its definition in the manual.</summary>
    private static double Factor(Fractal fractal, Mesh mesh, GradientKind kind, AffineMap map, IReadOnlyList<PathStep> path)
    {
        var bounds = fractal.Bounds;
        var place = map * mesh.Bounds.Centre;
        var (passed, nearest, fraction, weight, count) = (AffineMap.Identity, 1.0, 0.0, 0.5, 0);
        foreach (var step in path)
        {
            passed *= step.Map;
            if (step.Map != AffineMap.Identity)
            {
                nearest = Math.Min(nearest, 2 * ((passed * bounds.Centre) - bounds.Centre).Length() / bounds.Diagonal);
                fraction += weight * step.Index / Math.Max(1, step.SetSize - 1);
                weight /= 2;
                count++;
            }
        }

        var sweep = Math.Min(12, fractal.LevelCount!.Value);
        return kind switch
        {
            GradientKind.Level => 1 - Math.Abs(1 - (count / (double)sweep % 2)),
            GradientKind.Path => fraction,
            GradientKind.Height => Math.Clamp((place.Y - bounds.Minimum.Y) / bounds.Size.Y, 0, 1),
            GradientKind.Distance => Math.Min(1, 2 * (place - bounds.Centre).Length() / bounds.Diagonal),
            _ => nearest,
        };
    }

    /// <summary>All instances as culling finds them; those with a path of which a query is sure.</summary>
    private static IEnumerable<(GradientShade Shade, AffineMap Map, IReadOnlyList<PathStep>? Path, int Mesh)> FindInstances(
        Fractal fractal, Gradient gradient)
    {
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var from = fractal.Bounds.Centre - (3 * fractal.Bounds.Diagonal * Vector.K);
        var placement = new AffineMap((2 * Matrix.Identity), new(5, -3, 2));
        foreach (var (mesh, part) in fractal.ByMesh.Index())
        {
            var (corner, _, _) = fractal.BaseMeshes[mesh].Face(0);
            var hierarchy = LodHierarchy.Build(part);
            var item = new CulledObject(hierarchy, placement, Vector.Zero, 0)
            {
                GradientKind = gradient.Kind, Shading = new(gradient, hierarchy),
            };
            var set = new VisibleSet();
            set.Cull(CullingViews.CreateView(placement * from, placement * fractal.Bounds.Centre), [item], CullingViews.NoCulling);
            for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
            {
                var count = set.GradientFactors(0, chunk).Length;
                for (var i = 0; i < count; i++)
                {
                    var row = set.Instances(0, chunk)[(i * VisibleSet.FloatsPerInstance)..];
                    var map = placement.Inverse() * new AffineMap(
                        new(new(row[0], row[4], row[8]), new(row[1], row[5], row[9]), new(row[2], row[6], row[10])),
                        (placement * from) + new Vector(row[3], row[7], row[11]));
                    var colour = set.PaletteColours(0, chunk)[(4 * i)..];
                    Assert.Equal(0, colour[3]);
                    Assert.True(collider.TryFindClosest(map * corner, double.PositiveInfinity, context, out _));
                    var path = fractal.Follow(context.InstancePath)!;
                    var ofPath = path.Aggregate(AffineMap.Identity, static (outer, step) => outer * step.Map);
                    // Another instance may be as close to this corner.
                    var isSure = context.MeshIndex == mesh && Near.Difference(ofPath, map) < 1e-4;
                    yield return (
                        new(set.GradientFactors(0, chunk)[i], new(colour[0], colour[1], colour[2])), ofPath, isSure ? path : null, mesh);
                }
            }
        }
    }

    private static Fractal Read(string text)
    {
        using var folder = new TemporaryFolder();
        return FractalFile.Read(folder.Write("a.fdo", text + "\n"));
    }
}
