using FractalEngine.Core.Bvh;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Closest;
using FractalEngine.Core.Queries.Regions;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>Searches by the best bound, levels that are expanded, and paths, against all faces.</summary>
public sealed class BestFirstSearchTests
{
    private static readonly SceneObject Tetrahedron = new(Samples.Tetrahedron);

    [Fact]
    public void Run_FromAnyPosition_FindsTheClosestWithAllOfItsPath() => Seeded.Run(12, random =>
    {
        var fractal = Samples.Repeated(3, random.Transformation(), random.Transformation(), random.Transformation());
        var hierarchy = fractal.Hierarchy;
        var faces = new SimpleCollider(FractalGenerator.Flatten(fractal, 100_000));
        var search = new BestFirstSearch(hierarchy, Array.ConvertAll(hierarchy.BaseMeshes, TriangleBvh.For));
        var context = new QueryContext();
        for (var i = 0; i < 12; i++)
        {
            var position = random.Vector(4);
            // Children that no search has recorded have no place in a path.
            context.PathBuffer(QueryContext.MaxStackDepth).Fill(int.MaxValue);
            context.BestPathBuffer(QueryContext.MaxStackDepth).Fill(int.MaxValue);
            var state = new FractalSearchState(double.PositiveInfinity, 0, position.MaxAbsComponent(), 10, context);
            if (i % 2 == 0)
            {
                state.UpdateClosest(1e20, 0, 0);
            }

            search.Run(position, AffineMap.Identity, ref state);
            Assert.True(state.IsComplete);
            var expected = faces.FindClosest(position).Distance;
            Near.Equal(expected, Math.Sqrt(state.ClosestDistanceSquared), 1e-11);
            context.ClearPath();
            var instance = hierarchy.ResolveInstance(state.ClosestDepth, hierarchy.Top, AffineMap.Identity, context, out _);
            ClosestPointFactory.OnInstance(
                hierarchy.BaseMeshes[context.MeshIndex], state.ClosestFace, in instance, in position, out var closest);
            Near.Equal(expected, closest.Distance, 1e-11);
            var map = AffineMap.Identity;
            for (var level = 0; level < context.InstancePath.Length; level++)
            {
                map *= fractal.LevelAt(level).Maps[context.InstancePath[level]];
            }

            Near.Equal(map, instance.ToAffineMap(), 1e-13);
        }
    });

    [Fact]
    public void ResolveFace_OfAnExpandedLevel_LeadsToTheFaceThatIsThere()
    {
        var fractal = Samples.Repeated(3, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.4), Samples.Move(0, 5, 0));
        var hierarchy = fractal.Hierarchy;
        var expanded = new ExpandedSubFractal(hierarchy, fractal.BaseMesh, hierarchy.Levels);
        var mesh = expanded.Bvh.Mesh;
        Assert.Equal(27 * 4, mesh.FaceCount);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var context = new QueryContext();
            var state = new FractalSearchState(double.PositiveInfinity, 0, 1, 10, context);
            state.UpdateClosest(1, face, 0, expanded);
            Assert.Equal(face % 4, state.ClosestFace);
            var map = hierarchy.ResolveInstance(state.ClosestDepth, hierarchy.Top, AffineMap.Identity, context, out _).ToAffineMap();
            var (a, b, c) = fractal.BaseMesh.Face(state.ClosestFace);
            Assert.Equal(3, context.InstancePath.Length);
            var (imageA, imageB, imageC) = mesh.Face(face);
            Near.Equal(map * a, imageA, 1e-14);
            Near.Equal(map * b, imageB, 1e-14);
            Near.Equal(map * c, imageC, 1e-14);
        }

        var least = expanded.Bvh.StorageBytes + (8L * mesh.Positions.Length) + (4L * mesh.VertexIndices.Length) + (4 * 28);
        Assert.InRange(expanded.StorageBytes, least + (4 * 27), least + (4 * 27 * 3));
    }

    [Fact]
    public void ShapeTree_OfAMeshAndAFractal_TellsWhatItIs()
    {
        var mesh = new ShapeTree(Samples.Tetrahedron, null);
        Assert.Equal((false, false), (mesh.IsFractal, mesh.IsEmpty));
        Assert.Equal((0L, 0), (mesh.Root(AffineMap.Identity).State.Level, mesh.ChildCount(mesh.Root(AffineMap.Identity))));
        Assert.Equal(new[] { 0, 1, 2, 3 }, mesh.Faces(mesh.Root(AffineMap.Identity)).ToArray());
        Assert.Equal(0, mesh.MinRadiusSquared(AffineMap.Identity));
        Assert.Empty(mesh.InstancePath([], new()));
        Assert.NotSame(mesh, mesh.WithHierarchy());
        var fractal = Samples.Repeated(2, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.4));
        var tree = new ShapeTree(fractal.Hierarchy, [TriangleBvh.For(Samples.Tetrahedron)], 0.25);
        Assert.Equal((true, false), (tree.IsFractal, tree.IsEmpty));
        Assert.Same(tree, tree.WithHierarchy());
        var map = new AffineMap(2 * Matrix.Identity, Vector.Zero);
        Near.Equal(0.0625 * 12, tree.MinRadiusSquared(in map), 1e-15);
        Assert.Equal(fractal.Hierarchy.Root.Box, tree.Box);
    }

    [Fact]
    public void StorageBytes_OfAnExactCollider_AreThoseOfItsParts()
    {
        var fractal = Samples.Repeated(3, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.4));
        var collider = new ExactFractalCollider(fractal);
        var bvh = TriangleBvh.For(fractal.BaseMesh);
        Assert.Equal(
            fractal.Hierarchy.StorageBytes + bvh.StorageBytes + ExpandedLevels.For(fractal.Hierarchy, bvh).StorageBytes,
            collider.StorageBytes);
    }

    [Fact]
    public void TryFindClosest_OfNothing_GivesNoOldPoint()
    {
        var collider = new ExactFractalCollider(Samples.Repeated(2));
        var closest = new ClosestPoint(7, Vector.One, Vector.K, Vector.I, TriangleFeature.EdgeAB, 3) { ErrorBound = 2 };
        Assert.False(collider.TryFindClosest(Vector.Zero, 5, new(), out closest));
        Assert.Equal(default, closest);
    }

    [Fact]
    public void FindClosest_WithABeamOnAnInfiniteFractal_EndsAtTheLastPlace()
    {
        var fractal = Samples.Repeated(null, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5));
        var context = new QueryContext();
        Assert.True(new FractalCollider(fractal, 2).TryFindClosest(new(-1, -1, -1), 10, context, out var closest));
        // The first of 2⁻ⁿ below 1e-15.
        Assert.Equal(50, context.InstancePath.Length);
        Near.Equal(Math.Sqrt(3), closest.Distance, 1e-12);
        Assert.Equal(closest.Distance, closest.ErrorBound);
    }

    [Fact]
    public void WithAddedObject_BesideAHierarchy_TestsOneBoundMore()
    {
        var objects = Enumerable.Range(0, 70).Select(i => Tetrahedron with { Placement = Samples.Move(10 * i, 0, 0) });
        var scene = new SceneCollider(new Scene { Objects = [.. objects] });
        var (before, after) = (new QueryContext(), new QueryContext());
        var position = new Vector(333, 5, 5);
        scene.Build();
        Assert.True(scene.TryFindClosest(position, double.PositiveInfinity, before, out var expected, out var index));
        var added = scene.WithAddedObject(new PlacedModel(Tetrahedron with { Placement = Samples.Move(0, 1e6, 0) }));
        Assert.True(added.TryFindClosest(position, double.PositiveInfinity, after, out var closest, out var sameIndex));
        Assert.Equal((expected, index), (closest, sameIndex));
        Assert.Equal(before.Statistics.BoundTests + 1, after.Statistics.BoundTests);
        Assert.Equal(before.Statistics.FaceTests, after.Statistics.FaceTests);
        Assert.True(added.TryFindClosest(new(0, 1e6, 9), 10, after, out _, out var last));
        Assert.Equal(70, last);
    }

    [Fact]
    public void WithAddedObject_OfAMeshBesideFractals_StillTakesTheHierarchy()
    {
        var fractal = Samples.Repeated(2, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5));
        var scene = new SceneCollider(new Scene { Objects = [new(fractal)] }, ColliderKind.Fractal);
        var withMesh = scene.WithAddedObject(new PlacedModel(Tetrahedron with { Placement = Samples.Move(0, 0, 100) }));
        Assert.True(withMesh.TryFindClosest(new(0.1, 0.1, 98), 10, new(), out var closest, out var index));
        Assert.Equal(1, index);
        Near.Equal(2, closest.Distance, 1e-12);
        Assert.True(withMesh.TryFindClosest(new(0, 0, -1), 10, new(), out _, out index));
        Assert.Equal(0, index);
    }
}
