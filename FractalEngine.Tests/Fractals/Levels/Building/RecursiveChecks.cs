using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Compares the hierarchy of recursives, and searches in it, with all their faces.</summary>
internal static class RecursiveChecks
{
    public const double Tolerance = 1e-12;

    /// <summary>A gabled roof of side 1, for recursives whose base mesh is not that of the others.</summary>
    public static readonly Mesh Roof = new(
        [0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0.5, 0.8, 0, 0.5, 0.8, 1], [0, 4, 1, 3, 2, 5, 0, 3, 5, 0, 5, 4, 1, 4, 5, 1, 5, 2]);

    public static (FractalHierarchy Hierarchy, ExpandedGraph Expanded) Create(FractalGraph graph) =>
        (FractalHierarchyBuilder.Build(graph), new(graph));

    public static (long Instances, long Faces) Count(FractalHierarchy hierarchy) => (
        (long)new InstanceCounts(hierarchy, static _ => 1).SumAt(hierarchy.Levels),
        (long)new InstanceCounts(hierarchy, index => hierarchy.BaseMeshes[index].FaceCount).SumAt(hierarchy.Levels));

    /// <summary>The box of the hierarchy holds all faces and is hardly larger; the searched one is exact.</summary>
    public static void AssertBounds(FractalHierarchy hierarchy, ExpandedGraph expanded, double maxLooseness)
    {
        var (box, exact) = (hierarchy.Root.Box, expanded.Box);
        Near.Equal(box.Minimum, BoundingBox.Union(box, exact).Minimum, Tolerance);
        Near.Equal(box.Maximum, BoundingBox.Union(box, exact).Maximum, Tolerance);
        Near.Equal(exact.Minimum, box.Minimum, maxLooseness * exact.Diagonal);
        Near.Equal(exact.Maximum, box.Maximum, maxLooseness * exact.Diagonal);
        var searched = FractalBounds.ComputeBox(hierarchy);
        Near.Equal(exact.Minimum, searched.Minimum, Tolerance * exact.Diagonal);
        Near.Equal(exact.Maximum, searched.Maximum, Tolerance * exact.Diagonal);
    }

    public static void AssertClosest(ExactFractalCollider collider, ExpandedGraph expanded, Vector position)
    {
        var context = new QueryContext();
        Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
        Near.Equal(expanded.Distances(position).Min(), closest.Distance, Tolerance);
        var (a, b, c) = expanded.FaceOf(context.InstancePath, closest.FaceIndex);
        Near.Equal(closest.Distance, Math.Sqrt(TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared), Tolerance);
        Assert.False(closest.Distance > 1e-9 && collider.TryFindClosest(position, closest.Distance - 1e-9, context, out _));
    }

    public static void AssertAllWithin(ExactFractalCollider collider, ExpandedGraph expanded, Vector position, double radius)
    {
        var expected = expanded.Distances(position).Where(distance => distance <= radius).Order().ToArray();
        var hits = collider.FindAllWithin(position, radius, 1_000_000);
        Assert.Equal(expected.Length, hits.Length);
        for (var i = 0; i < expected.Length; i++)
        {
            Near.Equal(expected[i], hits[i].Distance, Tolerance);
            var (a, b, c) = expanded.FaceOf(hits[i].InstancePath.AsSpan(), hits[i].FaceIndex);
            Near.Equal(hits[i].Distance, Math.Sqrt(TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared), Tolerance);
        }
    }

    public static Vector RandomPosition(Random random, BoundingBox box) =>
        box.Centre + (0.7 * box.Size.Stretch(random.Vector()));

    public static AffineMap MapOf(Transformation transformation) => new TransformationSet([transformation]).Maps[0];
}
