using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>
/// Finds the sides of instances that are never seen, where boxes stand side by side as in a Menger sponge: a neighbour covers them whole.
/// </summary>
/// <remarks>
/// Sides are bits: +x, +y, +z, −x, −y, −z. Where two equal siblings touch, each covers the side of the other, if opposite sides of a
/// sub-fractal have the same holes at every level. A child whose side lies in that of its parent shares what covers it. So 6 bits that
/// follow the path tell all covered sides of an instance, at any depth. Of a sponge of depth 5 they are two of three sides.
/// </remarks>
internal static class CoveredSides
{
    // Pairs of children are tested.
    private const int MaxChildren = 64;

    // By the size of the box: more than the rounding of maps, and less than a float of an instance tells.
    private const double Tolerance = 1e-9;

    /// <summary>Marks the sides of all children; of none unless all nodes have the box of the base mesh, and equal sides.</summary>
    /// <param name="nodes">The nodes of a hierarchy.</param>
    /// <param name="mesh">Its base mesh.</param>
    /// <returns>Whether any side is covered.</returns>
    public static bool TryMark(ReadOnlySpan<LodNode> nodes, Mesh mesh)
    {
        if (!IsBox(mesh))
        {
            return false;
        }

        var sides = new (byte Covered, byte Shared)[nodes.Length][];
        var equalAxes = 7;
        for (var i = 0; i < nodes.Length; i++)
        {
            (sides[i], var axes) = Compare(nodes[i], mesh.Bounds);
            equalAxes &= axes;
        }

        var kept = (byte)(9 * equalAxes);
        var isAnyCovered = false;
        for (var i = 0; i < nodes.Length && kept != 0; i++)
        {
            nodes[i].ChildSides = Array.ConvertAll(sides[i], child => ((byte)(child.Covered & kept), child.Shared));
            isAnyCovered |= Array.Exists(nodes[i].ChildSides, static child => child.Covered != 0);
        }

        return isAnyCovered;
    }

    /// <summary>Whether a mesh is a closed box along the axes: all faces lie in the sides of its bounding box.</summary>
    private static bool IsBox(Mesh mesh)
    {
        var (minimum, maximum) = mesh.Bounds;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var (least, most) = (Vector.Min(Vector.Min(a, b), c), Vector.Max(Vector.Max(a, b), c));
            if (!(IsSide(least.X, most.X, minimum.X, maximum.X) || IsSide(least.Y, most.Y, minimum.Y, maximum.Y)
                || IsSide(least.Z, most.Z, minimum.Z, maximum.Z)))
            {
                return false;
            }
        }

        return ClosedSurface.IsSolid(mesh);
    }

    private static bool IsSide(double least, double most, double minimum, double maximum) =>
        least == most && (least == minimum || least == maximum);

    /// <summary>
    /// Compares the children of a node: which of their sides siblings cover, which lie in sides of the node, and along which axes both
    /// sides of the node have the same holes, bits for x, y and z.
    /// </summary>
    private static ((byte Covered, byte Shared)[] Sides, int EqualAxes) Compare(LodNode node, BoundingBox box)
    {
        var count = node.ChildMaps.Length;
        if (count == 0)
        {
            return ([], 7);
        }

        var tolerance = Tolerance * SimdAffineMap.ToVector256(box.Size);
        if (count > MaxChildren || node.IsEmpty || BitsOf(node.Centre, SimdAffineMap.ToVector256(box.Centre), tolerance) != 7
            || BitsOf(node.HalfSize, SimdAffineMap.ToVector256(0.5 * box.Size), tolerance) != 7
            || !node.ChildMaps.All(static map => KeepsAxes(map.ToAffineMap().Linear)))
        {
            return ([], 0);
        }

        var sides = new (byte Covered, byte Shared)[count];
        var equalAxes = 7;
        for (var i = 0; i < count; i++)
        {
            var half = node.ChildMaps[i].TransformHalfSize(node.HalfSize);
            var place = node.ChildMaps[i].Apply(node.Centre);
            var offset = place - node.Centre;
            var shared = BitsOf(offset, node.HalfSize - half, tolerance) | (BitsOf(-offset, node.HalfSize - half, tolerance) << 3);
            var (covered, opposed) = (0, 0);
            for (var j = 0; j < count; j++)
            {
                if (node.ChildLevelSteps[j] == node.ChildLevelSteps[i]
                    && BitsOf(node.ChildMaps[j].TransformHalfSize(node.HalfSize), half, tolerance) == 7)
                {
                    // The other child touches this one, or lies in the opposite side of the node, where the way has one direction.
                    var way = node.ChildMaps[j].Apply(node.Centre) - place;
                    var resting = BitsOf(way, Vector256<double>.Zero, tolerance);
                    var along = resting == 7 ? 7 : resting is 3 or 5 or 6 ? 7 ^ resting : 0;
                    covered |= (along & BitsOf(way, 2 * half, tolerance)) | ((along & BitsOf(-way, 2 * half, tolerance)) << 3);
                    var across = 2 * (node.HalfSize - half);
                    opposed |= (along & BitsOf(-way, across, tolerance)) | ((along & BitsOf(way, across, tolerance)) << 3);
                }
            }

            sides[i] = ((byte)covered, (byte)shared);
            var lonely = shared & ~opposed;
            equalAxes &= ~(lonely | (lonely >> 3));
        }

        return (sides, equalAxes);
    }

    /// <summary>Whether a map scales along the axes only, and mirrors nothing.</summary>
    private static bool KeepsAxes(Matrix linear) =>
        Math.Min(linear.V1.X, Math.Min(linear.V2.Y, linear.V3.Z)) > 0
        && linear == Matrix.Diagonal(new(linear.V1.X, linear.V2.Y, linear.V3.Z));

    /// <summary>Returns a bit for each of x, y and z in which two vectors are equal.</summary>
    private static int BitsOf(Vector256<double> v1, Vector256<double> v2, Vector256<double> tolerance) =>
        (int)Vector256.LessThanOrEqual(Vector256.Abs(v1 - v2), tolerance).ExtractMostSignificantBits() & 7;
}
