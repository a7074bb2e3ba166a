using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>
/// Finds fractals whose parts hide nothing of each other's sky, without a ray: those of one part, and those that lie in one plane.
/// </summary>
/// <remarks>
/// A flat base mesh lies in a plane. If each map of the hierarchy takes this plane to itself, then all instances lie in it, by induction
/// over the levels. No direction above the plane leads through it again.
/// </remarks>
internal static class OpenSky
{
    // Up to this angle in radians, and this part of the size, a map keeps the plane up to rounding.
    private const double Tolerance = 1e-9;

    /// <summary>Tells whether no node has more than one child: the fractal is a single instance of its base mesh.</summary>
    public static bool IsSinglePath(ReadOnlySpan<LodNode> nodes)
    {
        foreach (var node in nodes)
        {
            if (node.ChildMaps.Length > 1)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Tells whether all instances certainly lie in one plane.</summary>
    /// <param name="mesh">The base mesh of the fractal.</param>
    /// <param name="nodes">All nodes of its hierarchy.</param>
    public static bool IsFlat(Mesh mesh, ReadOnlySpan<LodNode> nodes) =>
        UnshadedSurface.FindPlane(mesh) is { } normal && KeepPlane(mesh, normal, nodes);

    private static bool KeepPlane(Mesh mesh, Vector normal, ReadOnlySpan<LodNode> nodes)
    {
        var origin = mesh.Vertex(mesh.VertexIndices[0]);
        var across = normal.Perpendicular();
        var along = Vector.Cross(normal, across);
        foreach (var node in nodes)
        {
            if (!Keeps(node.ProxyMap.ToAffineMap()) || !Array.TrueForAll(node.ChildMaps, map => Keeps(map.ToAffineMap())))
            {
                return false;
            }
        }

        return true;

        bool Keeps(AffineMap map)
        {
            var moved = map * origin;
            var scale = mesh.Bounds.Diagonal + (moved - origin).Length();
            return IsLevel(map.Linear * across) && IsLevel(map.Linear * along)
                && Math.Abs(Vector.Dot(normal, moved - origin)) <= Tolerance * scale;
        }

        bool IsLevel(Vector direction) => Math.Abs(Vector.Dot(normal, direction)) <= Tolerance * direction.Length();
    }
}
