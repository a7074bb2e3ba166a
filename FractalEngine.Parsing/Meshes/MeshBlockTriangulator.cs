using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Writes the polygons of one block as triangles into a block that holds all of a mesh.</summary>
/// <param name="block">Polygons to write.</param>
/// <param name="all">
/// Has the positions of all blocks. Receives indices [faces × 3] of positions, and of texture coordinates and normals unless those arrays
/// are empty.
/// </param>
internal sealed class MeshBlockTriangulator(MeshBlock block, MeshBlock all)
{
    private readonly double[] _positions = all.Positions;
    private readonly int[] _positionIndices = all.PositionIndices;
    private readonly int[] _textureIndices = all.TextureIndices;
    private readonly int[] _normalIndices = all.NormalIndices;
    private readonly PolygonTriangulator _triangulator = new();
    private readonly List<Vector> _polygon = [];
    private readonly List<int> _triangleCorners = [];

    /// <summary>Writes all triangles of the block.</summary>
    public void Write()
    {
        if (block.HasRelativeIndices)
        {
            Resolve(block.PositionIndices, block.Before.Positions);
            Resolve(block.TextureIndices, block.Before.TextureCoordinates);
            Resolve(block.NormalIndices, block.Before.Normals);
        }

        if (block.PolygonSizes.Length == 0)
        {
            CopyTriangles(block.PositionIndices, _positionIndices);
            CopyTriangles(block.TextureIndices, _textureIndices);
            CopyTriangles(block.NormalIndices, _normalIndices);
        }
        else
        {
            WritePolygons();
        }
    }

    private static void Resolve(int[] indices, int before)
    {
        for (var i = 0; i < indices.Length; i++)
        {
            indices[i] += indices[i] < PolygonCorner.None ? before - MeshBlock.BlockStart : 0;
        }
    }

    /// <summary>Copies the indices of all triangles. A block without any is filled with none where other blocks have some.</summary>
    private void CopyTriangles(int[] from, int[] to)
    {
        if (from.Length > 0)
        {
            from.CopyTo(to, 3 * block.Before.Faces);
        }
        else if (to.Length > 0)
        {
            Array.Fill(to, PolygonCorner.None, 3 * block.Before.Faces, 3 * block.Counts.Faces);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void WritePolygons()
    {
        var corner = 0;
        var target = 3 * block.Before.Faces;
        foreach (int size in block.PolygonSizes)
        {
            if (size == 3)
            {
                WriteTriangle(target, corner, corner + 1, corner + 2);
            }
            else if (size == 4 && IsConvexQuad(corner))
            {
                // As PolygonTriangulator cuts it.
                WriteTriangle(target, corner + 3, corner, corner + 1);
                WriteTriangle(target + 3, corner + 1, corner + 2, corner + 3);
            }
            else
            {
                WritePolygon(target, corner, size);
            }

            corner += size;
            target += 3 * (size - 2);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private void WriteTriangle(int target, int corner1, int corner2, int corner3)
    {
        WriteIndices(block.PositionIndices, _positionIndices, target, corner1, corner2, corner3);
        if (_textureIndices.Length > 0)
        {
            WriteIndices(block.TextureIndices, _textureIndices, target, corner1, corner2, corner3);
        }

        if (_normalIndices.Length > 0)
        {
            WriteIndices(block.NormalIndices, _normalIndices, target, corner1, corner2, corner3);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void WriteIndices(int[] from, int[] to, int target, int corner1, int corner2, int corner3)
    {
        var triangle = to.AsSpan(target, 3);
        var hasIndices = from.Length > 0;
        triangle[2] = hasIndices ? from[corner3] : PolygonCorner.None;
        triangle[1] = hasIndices ? from[corner2] : PolygonCorner.None;
        triangle[0] = hasIndices ? from[corner1] : PolygonCorner.None;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private bool IsConvexQuad(int corner) => PolygonTriangulator.IsConvex(
        PositionOf(corner), PositionOf(corner + 1), PositionOf(corner + 2), PositionOf(corner + 3));

    private void WritePolygon(int target, int corner, int size)
    {
        _polygon.Clear();
        _triangleCorners.Clear();
        for (var i = 0; i < size; i++)
        {
            _polygon.Add(PositionOf(corner + i));
        }

        _triangulator.Triangulate(CollectionsMarshal.AsSpan(_polygon), _triangleCorners);
        for (var i = 0; i < _triangleCorners.Count; i += 3)
        {
            WriteTriangle(target + i, corner + _triangleCorners[i], corner + _triangleCorners[i + 1], corner + _triangleCorners[i + 2]);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector PositionOf(int corner)
    {
        var i = 3 * block.PositionIndices[corner];
        return new(_positions[i], _positions[i + 1], _positions[i + 2]);
    }
}
