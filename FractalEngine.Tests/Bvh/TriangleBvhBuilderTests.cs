using System.Runtime.CompilerServices;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;

namespace FractalEngine.Tests.Bvh;

/// <summary>The tree of a mesh and its references.</summary>
public class TriangleBvhBuilderTests
{
    public static TheoryData<string> Meshes => CollisionMeshes.Names;

    [Fact]
    public void Build_OnAnyNumberOfThreads_GivesTheSameBvh()
    {
        var mesh = MeshGenerators.Create("tree-stump", 1, 120_000);
        var expected = TriangleBvhBuilder.Build(mesh, Vector.Zero, 1, threads: 1);
        foreach (var threads in new[] { 2, 3, 16 })
        {
            var actual = TriangleBvhBuilder.Build(mesh, Vector.Zero, 1, threads: threads);
            Assert.Equal(expected.Children, actual.Children);
            Assert.Equal(expected.NodeBounds, actual.NodeBounds);
            Assert.Equal(expected.Faces, actual.Faces);
            Assert.Equal(expected.Frames, actual.Frames);
            Assert.Equal(expected.LongestEdge, actual.LongestEdge);
        }
    }

    [Theory]
    [MemberData(nameof(Meshes))]
    public void Build_OfAnyMesh_HasEachFaceOnceAndFewLevels(string name)
    {
        var mesh = CollisionMeshes.All[name]();
        var layout = TriangleBvhBuilder.Build(mesh, mesh.Bounds.Centre, 1 / Math.Max(1e-100, mesh.Bounds.Diagonal), threads: 2);
        var faces = new List<int>();
        Assert.InRange(HeightOf(BvhChild.Root), 1, 40);
        Assert.Equal(Enumerable.Range(0, mesh.FaceCount), faces.Order());

        int HeightOf(BvhChild child)
        {
            if (child.IsNode)
            {
                var children = layout.Children.Slice(BvhLayout.BranchingFactor * child.NodeIndex, BvhLayout.BranchingFactor);
                return 1 + children.Where(grandchild => grandchild != BvhChild.None).Max(HeightOf);
            }

            faces.AddRange(layout.Faces.AsSpan(child.FirstTriangle, child.TriangleCount));

            return 0;
        }
    }

    [Theory]
    [InlineData(0, 1)]
    [InlineData(0, 8)]
    [InlineData(7, 3)]
    [InlineData(200_000_000, 5)]
    public void ForLeaf_OfAnyLeaf_IsDecoded(int firstTriangle, int triangleCount)
    {
        var child = BvhChild.ForLeaf(firstTriangle, triangleCount);
        Assert.Equal((false, firstTriangle, triangleCount), (child.IsNode, child.FirstTriangle, child.TriangleCount));
        Assert.Equal(child, BvhChild.FromBits(Unsafe.BitCast<BvhChild, uint>(child)));
        Assert.NotEqual(BvhChild.None, child);
    }

    [Fact]
    public void Rebase_OfNodesLeavesAndAbsentChildren_MovesNodesOnly()
    {
        Assert.Equal(BvhChild.ForNode(17), BvhChild.ForNode(12).Rebase(firstNode: 5));
        Assert.Equal(BvhChild.ForLeaf(3, 2), BvhChild.ForLeaf(3, 2).Rebase(firstNode: 5));
        Assert.Equal(BvhChild.None, BvhChild.None.Rebase(firstNode: 5));
        Assert.True(BvhChild.FromBits(Unsafe.BitCast<BvhChild, uint>(BvhChild.ForNode(12))).IsNode);
    }

    [Theory]
    [InlineData(4)]
    [InlineData(8)]
    public void LeafCounts_OfAnyLeafSize_AddUpToTheFaces(int maxLeafTriangles)
    {
        var mesh = CollisionMeshes.TriangleSoup(1, 500, 0.1);
        var counts = TriangleBvhBuilder.Build(mesh, Vector.Zero, 1, maxLeafTriangles).LeafCounts();
        Assert.Equal(mesh.FaceCount, counts.Sum());
        Assert.All(counts, count => Assert.InRange(count, 1, maxLeafTriangles));
    }
}
