using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Collision.Bvh;

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
            var actual = TriangleBvhBuilder.Build(mesh, Vector.Zero, 1, threads);
            Assert.Equal(expected.Children, actual.Children);
            Assert.Equal(expected.NodeBounds, actual.NodeBounds);
            Assert.Equal(expected.Leaves, actual.Leaves);
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

            for (var i = 0; i < child.TriangleCount; i++)
            {
                faces.Add(layout.Leaves[child.LeafIndex].FaceIndices[i]);
            }

            return 0;
        }
    }

    [Theory]
    [InlineData(0, 1)]
    [InlineData(0, 4)]
    [InlineData(7, 3)]
    [InlineData(500_000_000, 2)]
    public void ForLeaf_OfAnyLeaf_IsDecodedAndRebased(int leafIndex, int triangleCount)
    {
        var child = BvhChild.ForLeaf(leafIndex, triangleCount);
        Assert.Equal((false, leafIndex, triangleCount), (child.IsNode, child.LeafIndex, child.TriangleCount));
        Assert.Equal(child, BvhChild.FromBits(child.Bits));
        Assert.Equal(BvhChild.ForLeaf(leafIndex + 30, triangleCount), child.Rebase(firstNode: 5, firstLeaf: 30));
    }

    [Fact]
    public void Rebase_OfNodesAndAbsentChildren_MovesNodesOnly()
    {
        Assert.Equal(BvhChild.ForNode(17), BvhChild.ForNode(12).Rebase(firstNode: 5, firstLeaf: 30));
        Assert.Equal(BvhChild.None, BvhChild.None.Rebase(firstNode: 5, firstLeaf: 30));
        Assert.True(BvhChild.FromBits(BvhChild.ForNode(12).Bits).IsNode);
    }
}
