using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Merges the blocks of an OBJ file into one mesh: each block knows where its elements go.</summary>
internal sealed class ObjMeshAssembler
{
    private readonly List<ObjBlock> _blocks;
    private readonly int _threadCount;
    private readonly double[] _positions;
    private readonly double[] _colours;
    private readonly double[] _textureCoordinates;
    private readonly double[] _normals;
    private readonly int[] _positionIndices;
    private readonly int[] _textureIndices;
    private readonly int[] _normalIndices;

    private ObjMeshAssembler(List<ObjBlock> blocks, ObjCounts counts, int threadCount)
    {
        _blocks = blocks;
        _threadCount = Math.Min(threadCount, blocks.Count);
        // Elements that no face refers to are no part of a mesh, except for its vertices.
        var (hasColours, hasTextures, hasNormals) = (false, false, false);
        foreach (var block in blocks)
        {
            hasColours |= block.Colours.Length > 0;
            hasTextures |= block.TextureIndices.Length > 0;
            hasNormals |= block.NormalIndices.Length > 0;
        }

        _positions = Allocate<double>(3 * counts.Positions);
        _colours = Allocate<double>(hasColours ? _positions.Length : 0);
        _textureCoordinates = Allocate<double>(hasTextures ? 2 * counts.TextureCoordinates : 0);
        _normals = Allocate<double>(hasNormals ? 3 * counts.Normals : 0);
        _positionIndices = Allocate<int>(3 * counts.Faces);
        _textureIndices = Allocate<int>(hasTextures ? _positionIndices.Length : 0);
        _normalIndices = Allocate<int>(hasNormals ? _positionIndices.Length : 0);
    }

    /// <summary>Creates the mesh of all blocks, without names.</summary>
    /// <param name="blocks">Blocks in the order of the file.</param>
    /// <param name="counts">Numbers of elements in all of them.</param>
    /// <param name="threadCount">Number of threads that work on it, at least one.</param>
    public static Mesh Assemble(List<ObjBlock> blocks, ObjCounts counts, int threadCount)
    {
        if (blocks is [{ IsResolved: true } single])
        {
            return WithColours(single.Colours, CreateMesh(single.Positions, single.PositionIndices, single.TextureCoordinates,
                single.TextureIndices, single.Normals, single.NormalIndices));
        }

        var assembler = new ObjMeshAssembler(blocks, counts, threadCount);
        assembler.ForEachBlock(assembler.CopyElements);
        // Cutting a polygon needs the positions of all blocks.
        assembler.ForEachBlock(block => new ObjBlockTriangulator(
            block, assembler._positions, assembler._positionIndices, assembler._textureIndices, assembler._normalIndices).Write());
        return WithColours(assembler._colours, CreateMesh(assembler._positions, assembler._positionIndices, assembler._textureCoordinates,
            assembler._textureIndices, assembler._normals, assembler._normalIndices));
    }

    private static T[] Allocate<T>(int length)
        where T : unmanaged => LargePages.Allocate<T>(length);

    private static Mesh WithColours(double[] colours, Mesh mesh) =>
        colours.Length == 0 ? mesh : mesh.WithColours(ImmutableCollectionsMarshal.AsImmutableArray(colours));

    private static Mesh CreateMesh(
        double[] positions, int[] positionIndices, double[] textureCoordinates, int[] textureIndices, double[] normals, int[] normalIndices)
    {
        var mesh = new Mesh(ImmutableCollectionsMarshal.AsImmutableArray(positions),
            ImmutableCollectionsMarshal.AsImmutableArray(positionIndices));
        if (textureIndices.Length > 0)
        {
            mesh = mesh.WithTextureCoordinates(ImmutableCollectionsMarshal.AsImmutableArray(textureCoordinates),
                ImmutableCollectionsMarshal.AsImmutableArray(textureIndices));
        }

        return normalIndices.Length == 0 ? mesh : mesh.WithNormals(ImmutableCollectionsMarshal.AsImmutableArray(normals),
            ImmutableCollectionsMarshal.AsImmutableArray(normalIndices));
    }

    private void ForEachBlock(Action<ObjBlock> write)
    {
        var next = -1;
        Workers.Run(_threadCount, _ =>
        {
            for (var i = Interlocked.Increment(ref next); i < _blocks.Count; i = Interlocked.Increment(ref next))
            {
                write(_blocks[i]);
            }
        });
    }

    private void CopyElements(ObjBlock block)
    {
        block.Positions.CopyTo(_positions, 3 * block.Before.Positions);
        if (_colours.Length > 0)
        {
            var colours = _colours.AsSpan(3 * block.Before.Positions, block.Positions.Length);
            colours.Fill(ObjColour.Default);
            block.Colours.CopyTo(colours);
        }

        if (_textureIndices.Length > 0)
        {
            block.TextureCoordinates.CopyTo(_textureCoordinates, 2 * block.Before.TextureCoordinates);
        }

        if (_normalIndices.Length > 0)
        {
            block.Normals.CopyTo(_normals, 3 * block.Before.Normals);
        }
    }
}
