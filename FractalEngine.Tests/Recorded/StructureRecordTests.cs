using System.Globalization;
using FractalEngine.Core;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Recorded;

/// <summary>Records what is built from fractals and meshes: counts, bounds, hierarchies, expansions, visible instances.</summary>
public class StructureRecordTests
{
    private const int MaxInstances = 3000;

    [Fact]
    public void Counts_AreAsRecorded() => Check("counts.txt", fractal =>
    {
        string distinct = Try(() => Text(DistinctInstances.Count(fractal, 20_000)));
        string expanded = Try(() => Maps(FractalGenerator.Expand(fractal, MaxInstances)));
        string once = Try(() => Maps(FractalGenerator.ExpandDistinct(fractal, MaxInstances)));
        string sums = Try(() => Text(FractalGenerator.ExpandComponentwise(fractal, MaxInstances).Length));
        return $"{Text(fractal.InstanceCount)} instances, {Text(fractal.FaceCount)} faces, {Text(fractal.LevelCount)} levels, "
            + $"distinct {distinct} {DistinctInstances.AreProvedDistinct(fractal)}, dimension {Dimension(fractal)}, "
            + $"box {new Digest().Add(fractal.Bounds)} {new Digest().Add(FractalBounds.ComputeBox(fractal))}, "
            + $"expanded {expanded}, each once {once}, sums {sums}";
    });

    [Fact]
    public void Hierarchies_AreAsRecorded() => Check("hierarchies.txt", fractal => fractal.Description.Composition == Composition.Affine
        ? $"{Hierarchy(fractal.Hierarchy)}; by sets {Hierarchy(fractal.HierarchyBySets)}"
        : "sums");

    [Fact]
    public void VisibleInstances_AreAsRecorded() => Check("visible.txt", fractal =>
    {
        var gradient = (Core.Scenes.GradientKind)(1 + (fractal.BaseMesh.FaceCount % 3));
        var culled = CullingViews.CreateObject(fractal) with { GradientKind = gradient };
        var visible = new VisibleSet();
        var (instances, factors) = (new Digest(), new Digest());
        var total = default(CullingStatistics);
        var random = new Random(5);
        for (int i = 0; i < 3; i++)
        {
            visible.Cull(
                CullingViews.RandomView(random, fractal.Bounds), [culled],
                new() { MinProjectedSize = i, InstanceBudget = 20_000, IsMultisampled = i == 1, ThreadCount = 1 });
            for (int chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
            {
                foreach (float value in visible.Instances(0, chunk))
                {
                    instances.Add(value);
                }

                foreach (float value in visible.GradientFactors(0, chunk))
                {
                    factors.Add(value);
                }
            }

            total += visible.Statistics;
        }

        return $"{visible.InstanceCount} instances {instances} {factors} {total}";
    });

    [Fact]
    public void Addresses_AreAsRecorded() => Check("addresses.txt", fractal =>
    {
        var box = fractal.Bounds;
        var hierarchy = LodHierarchy.Build(fractal);
        var address = new FractalAddress(hierarchy, AffineMap.Identity, box.Maximum + (0.3 * box.Size));
        var (places, roots) = (new Digest(), new Digest());
        for (int i = 0; i < 12; i++)
        {
            double distance = address.ClosestSurfaceDistance();
            places.Add(distance).Add(address.LogUnit).Add(address.FrameToCamera).Add(address.MapIndices.AsSpan());
            address.Move((i % 5 == 4 ? -0.9 : 0.6) * distance * (new Vector(-1, -0.9, -0.8) + (0.1 * i * Vector.I)).UnitVector());
            var collected = address.CollectRoots(3);
            foreach (var root in collected)
            {
                roots.Add(root.RemainingLevels).Add(root.FrameToCamera).Add(root.ColourPath.PathFraction).Add(root.ColourPath.MapCount);
            }

            roots.Add(address.MaxDrawDistance(collected)).Add(address.WorldPosition(AffineMap.Identity));
        }

        return $"depth {address.Depth}, {address.StorageBytes} bytes, {places} roots {roots}";
    });

    [Fact]
    public void Hulls_AreAsRecorded() => RecordedText.Check("hulls.txt", RecordedShapes.Meshes().Select(shape =>
    {
        var points = Enumerable.Range(0, shape.Mesh.VertexCount).Select(shape.Mesh.Vertex).ToArray();
        var all = ConvexHull.Build([.. points], 64);
        var few = ConvexHull.Build([.. points], 10);
        return $"{shape.Name}: {Hull(all)}; {Hull(few)}; turned {Hull(all.Transform(new(Matrix.Pitch(0.6), Vector.One)))}";
    }));

    [Fact]
    public void GeneratedMeshes_AreAsRecorded() => RecordedText.Check("generated.txt", MeshGenerators.All.SelectMany(
        generator => ((ulong, int?)[])[(1, generator.MinFaceCount), (2, Math.Max(1001, generator.MinFaceCount + 1))],
        (generator, arguments) =>
        {
            var mesh = generator.Create(arguments.Item1, arguments.Item2);
            var positions = new Digest();
            foreach (double value in mesh.Positions)
            {
                positions.Add(value);
            }

            return $"{generator.Name}: {generator.Description}; {generator.MinFaceCount} to {generator.DefaultFaceCount}, "
                + $"{mesh.VertexCount} vertices, {mesh.FaceCount} faces {positions} {new Digest().Add(mesh.VertexIndices.AsSpan())}";
        }));

    private static void Check(string file, Func<Fractal, string> describe) => RecordedText.Check(
        file, RecordedShapes.Fractals().Select(shape => $"{shape.Name}: {Try(() => describe(shape.Fractal))}"));

    private static string Try(Func<string> describe)
    {
        try
        {
            return describe();
        }
        catch (Exception exception) when (exception is FractalEngineException or ArgumentException or SingularMatrixException)
        {
            return exception.Message.Split('\n')[0];
        }
    }

    private static string Text(IFormattable? number) => number?.ToString(null, CultureInfo.InvariantCulture) ?? "none";

    private static string Dimension(Fractal fractal) =>
        SimilarityDimension.Of(fractal.Description) is { } dimension ? RecordedText.Text(dimension) : "none";

    private static string Maps(IEnumerable<AffineMap> maps)
    {
        var digest = new Digest();
        int count = 0;
        foreach (var map in maps)
        {
            count++;
            digest.Add(map);
        }

        return $"{count} {digest}";
    }

    private static string Hull(ConvexHull hull)
    {
        var digest = new Digest().AddBound(hull.MaxOutsideDistance).Add(hull.Support(Vector.One)).Add(hull.Volume());
        Array.ForEach(hull.Vertices, vertex => digest.Add(vertex));
        Array.ForEach(hull.Planes, plane => digest.Add(plane.Normal).Add(plane.Offset));
        return $"{hull.Vertices.Length} vertices, {hull.Planes.Length} planes {digest}";
    }

    private static string Hierarchy(FractalHierarchy hierarchy)
    {
        var (boxes, bounds, hulls) = (new Digest(), new Digest(), new Digest());
        int subFractals = 0, children = 0, groups = 0;
        void Visit(SubFractal subFractal)
        {
            subFractals++;
            boxes.Add(subFractal.Box).Add(subFractal.RadiusSquared).Add(subFractal.Centre[0]).Add(subFractal.Centre[2]);
            Array.ForEach(subFractal.ChildBounds, value => bounds.Add(value));
            hulls.Add(subFractal.Clusters is null ? 0 : 1).Add(subFractal.ChildBoundsX8 is null ? 0 : 1)
                .Add(subFractal.Floats is null ? 0 : 1);
            if (subFractal.Hull is { } hull)
            {
                hulls.AddBound(hull.Margin);
                foreach (var plane in hull.Planes)
                {
                    hulls.Add(plane.Normal).Add(plane.Offset);
                }
            }

            foreach (var child in subFractal.Children)
            {
                children++;
                if (child.Group is { } group)
                {
                    groups++;
                    Visit(group);
                }
                else
                {
                    boxes.Add(child.Map).Add(child.InverseScale).Add(child.OperatorNormBound);
                }
            }
        }

        foreach (var region in hierarchy.AllLevels.Regions)
        {
            for (long level = region.FirstLevel; level < region.FirstLevel + Math.Min(region.LevelCount, 40); level++)
            {
                if (hierarchy.FindOrNull(level) is { } subFractal)
                {
                    Visit(subFractal);
                }
            }
        }

        return $"{hierarchy.Levels} levels in {hierarchy.AllLevels.Items.Length}, "
            + $"{hierarchy.HasOnlySimilarities} {hierarchy.HasDoubledPowers}, "
            + $"{hierarchy.StorageBytes} bytes, {subFractals} with {children} children, {groups} groups {boxes} {bounds} {hulls}";
    }
}
