using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Merges the blocks of a mesh file into one mesh: each block knows where its elements go.</summary>
internal static class MeshAssembler
{
    /// <summary>Creates the mesh of all blocks, without names.</summary>
    /// <param name="blocks">Blocks in the order of the file.</param>
    /// <param name="counts">Numbers of elements in all of them.</param>
    /// <param name="threadCount">Number of threads that work on it, at least one.</param>
    public static Mesh Assemble(List<MeshBlock> blocks, ElementCounts counts, int threadCount)
    {
        if (blocks is [{ IsResolved: true } single])
        {
            return CreateMesh(single);
        }

        var all = Allocate(blocks, counts);
        ForEachBlock(blocks, threadCount, block => CopyElements(block, all));
        // Cutting a polygon needs the positions of all blocks.
        ForEachBlock(blocks, threadCount, block => new MeshBlockTriangulator(block, all).Write());
        return CreateMesh(all);
    }

    /// <summary>Makes a block of triangles with room for all elements.</summary>
    private static MeshBlock Allocate(List<MeshBlock> blocks, ElementCounts counts)
    {
        // Elements that no face refers to are no part of a mesh, except for its vertices.
        var hasColours = blocks.Exists(static block => block.Colours.Length > 0);
        var hasTextures = blocks.Exists(static block => block.TextureIndices.Length > 0);
        var hasNormals = blocks.Exists(static block => block.NormalIndices.Length > 0);
        return new()
        {
            Counts = counts,
            Positions = LargePages.Allocate<double>(3 * counts.Positions),
            Colours = LargePages.Allocate<double>(hasColours ? 3 * counts.Positions : 0),
            TextureCoordinates = LargePages.Allocate<double>(hasTextures ? 2 * counts.TextureCoordinates : 0),
            Normals = LargePages.Allocate<double>(hasNormals ? 3 * counts.Normals : 0),
            PositionIndices = LargePages.Allocate<int>(3 * counts.Faces),
            TextureIndices = LargePages.Allocate<int>(hasTextures ? 3 * counts.Faces : 0),
            NormalIndices = LargePages.Allocate<int>(hasNormals ? 3 * counts.Faces : 0),
            PolygonSizes = [],
        };
    }

    private static Mesh CreateMesh(MeshBlock block)
    {
        var mesh = new Mesh(Immutable(block.Positions), Immutable(block.PositionIndices));
        if (block.TextureIndices.Length > 0)
        {
            mesh = mesh.WithTextureCoordinates(Immutable(block.TextureCoordinates), Immutable(block.TextureIndices));
        }

        mesh = block.NormalIndices.Length == 0 ? mesh : mesh.WithNormals(Immutable(block.Normals), Immutable(block.NormalIndices));
        return block.Colours.Length == 0 ? mesh : mesh.WithColours(Immutable(block.Colours));
    }

    private static ImmutableArray<T> Immutable<T>(T[] array) => ImmutableCollectionsMarshal.AsImmutableArray(array);

    private static void ForEachBlock(List<MeshBlock> blocks, int threadCount, Action<MeshBlock> write)
    {
        var next = -1;
        Workers.Run(Math.Min(threadCount, blocks.Count), _ =>
        {
            for (var i = Interlocked.Increment(ref next); i < blocks.Count; i = Interlocked.Increment(ref next))
            {
                write(blocks[i]);
            }
        });
    }

    private static void CopyElements(MeshBlock block, MeshBlock all)
    {
        block.Positions.CopyTo(all.Positions, 3 * block.Before.Positions);
        if (all.Colours.Length > 0)
        {
            var colours = all.Colours.AsSpan(3 * block.Before.Positions, block.Positions.Length);
            colours.Fill(VertexColour.Default);
            block.Colours.CopyTo(colours);
        }

        if (all.TextureIndices.Length > 0)
        {
            block.TextureCoordinates.CopyTo(all.TextureCoordinates, 2 * block.Before.TextureCoordinates);
        }

        if (all.NormalIndices.Length > 0)
        {
            block.Normals.CopyTo(all.Normals, 3 * block.Before.Normals);
        }
    }
}
