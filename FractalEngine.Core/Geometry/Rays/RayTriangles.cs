using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>Triangles of a mesh by fours, as a <see cref="TriangleRay"/> reads them.</summary>
internal static class RayTriangles
{
    /// <summary>Number of triangles in a vector.</summary>
    public const int Count = 4;

    /// <summary>Copies up to four triangles of a mesh.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="faces">One to four face indices; the last one fills the lanes that are left over.</param>
    /// <param name="quad">Receives <see cref="TriangleRay.VectorsPerQuad"/> vectors.</param>
    public static void Gather(Mesh mesh, ReadOnlySpan<int> faces, ref Vector256<double> quad)
    {
        ref var target = ref Unsafe.As<Vector256<double>, double>(ref quad);
        ref var positions = ref MemoryMarshal.GetReference(mesh.Positions.AsSpan());
        var indices = mesh.VertexIndices.AsSpan();
        for (var lane = 0; lane < Count; lane++)
        {
            var corners = indices.Slice(3 * faces[Math.Min(lane, faces.Length - 1)], 3);
            for (var corner = 0; corner < 3; corner++)
            {
                ref var vertex = ref Unsafe.Add(ref positions, 3 * (nint)corners[corner]);
                Unsafe.Add(ref target, (12 * corner) + lane) = vertex;
                Unsafe.Add(ref target, (12 * corner) + 4 + lane) = Unsafe.Add(ref vertex, 1);
                Unsafe.Add(ref target, (12 * corner) + 8 + lane) = Unsafe.Add(ref vertex, 2);
            }
        }
    }

    /// <summary>Copies all triangles of a small mesh.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="faces">Face indices in the order of the fours.</param>
    public static Vector256<double>[] GatherAll(Mesh mesh, ReadOnlySpan<int> faces)
    {
        var quads = new Vector256<double>[(faces.Length + Count - 1) / Count * TriangleRay.VectorsPerQuad];
        for (var first = 0; first < faces.Length; first += Count)
        {
            Gather(mesh, faces[first..Math.Min(first + Count, faces.Length)], ref quads[first / Count * TriangleRay.VectorsPerQuad]);
        }

        return quads;
    }
}
