using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// Bounds of copies that are all of the same solid, in any sizes but none of them turned, as in Sierpiński's and Menger's fractals: what is
/// known of the solid in one direction serves all of them, four at a time.
/// </summary>
internal sealed class UnrotatedChildBounds
{
    private const int Lanes = SubFractal.Lanes;

    // With more facets the solid is round, and they say little more than directions.
    private const int MaxFacets = 8;

    private readonly HullBound _childHull;
    private readonly int _paddedCount;
    private readonly double[] _translationsAndScales;
    private readonly Vector[] _normals;
    private readonly double[] _offsets;

    private UnrotatedChildBounds(HullBound childHull, ChildInstance[] children, int paddedCount)
    {
        (_childHull, _paddedCount, _translationsAndScales) = (childHull, paddedCount, new double[4 * paddedCount]);
        var planes = childHull.Planes.Count <= MaxFacets ? childHull.Planes : [];
        _normals = [.. planes.Select(plane => plane.Normal)];
        _offsets = new double[planes.Count * paddedCount];
        for (var i = 0; i < children.Length; i++)
        {
            var (translation, scale) = (children[i].Map.Translation, children[i].Map.Linear.V1.X);
            (_translationsAndScales[i], _translationsAndScales[paddedCount + i], _translationsAndScales[(2 * paddedCount) + i],
                _translationsAndScales[(3 * paddedCount) + i]) = (translation.X, translation.Y, translation.Z, scale);
            for (var plane = 0; plane < planes.Count; plane++)
            {
                _offsets[(plane * paddedCount) + i] = Vector.Dot(planes[plane].Normal, translation) + (scale * planes[plane].Offset);
            }
        }
    }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * (_translationsAndScales.Length + (3 * _normals.Length) + _offsets.Length)) + 64;

    /// <summary>True where no copy is turned.</summary>
    public static bool HasNoRotation(ChildInstance[] children) =>
        children.All(child => child.LevelStep == children[0].LevelStep && child.Map.Linear.V1.X > 0
        && child.Map.Linear == child.Map.Linear.V1.X * Matrix.Identity);

    /// <summary>For copies, if they are so.</summary>
    /// <param name="childHull">That they are copies of; null where their boxes are as good.</param>
    /// <param name="children">Of the same level all.</param>
    /// <param name="paddedCount">Their number, made a multiple of four.</param>
    public static UnrotatedChildBounds? CreateOrNull(HullBound? childHull, ChildInstance[] children, int paddedCount) =>
        childHull is not null && HasNoRotation(children) ? new(childHull, children, paddedCount) : null;

    /// <summary>Raises the bounds of all copies by the planes of their facets: for positions among them.</summary>
    /// <param name="position">In the frame of the shifts: x, y, z, 0.</param>
    /// <param name="queue">Of the copies.</param>
    public void RaiseByFacets(Vector256<double> position, ChildQueue queue)
    {
        Vector point = new(position[0], position[1], position[2]);
        Span<double> heights = stackalloc double[MaxFacets];
        for (var plane = 0; plane < _normals.Length; plane++)
        {
            heights[plane] = Vector.Dot(_normals[plane], point);
        }

        ref var offset = ref MemoryMarshal.GetArrayDataReference(_offsets);
        for (var i = 0; i < _paddedCount; i += Lanes)
        {
            var maxHeight = Vector256<double>.Zero;
            for (var plane = 0; plane < _normals.Length; plane++)
            {
                maxHeight =
                    Vector256.MaxNative(maxHeight, Vector256.Create(heights[plane])
                        - Vector256.LoadUnsafe(ref offset, (nuint)((plane * _paddedCount) + i)));
            }

            queue.RaiseBounds(maxHeight * maxHeight, i);
        }
    }

    /// <summary>Raises the bounds of all copies by how far they reach in one direction: for positions outside.</summary>
    /// <param name="direction">From about the middle of all copies to the position: x, y, z, 0.</param>
    /// <param name="directionLengthSquared">Of its length.</param>
    /// <param name="position">In the frame of the shifts.</param>
    /// <param name="queue">Of the copies.</param>
    public void RaiseBySupport(Vector256<double> direction, double directionLengthSquared, Vector256<double> position, ChildQueue queue)
    {
        var unitDirection = direction * (1 / Math.Sqrt(directionLengthSquared));
        ref var translations = ref MemoryMarshal.GetArrayDataReference(_translationsAndScales);
        var (x, y, z) = (Vector256.Create(unitDirection[0]), Vector256.Create(unitDirection[1]), Vector256.Create(unitDirection[2]));
        var (height, support) =
            (Vector256.Create(Vector256.Dot(unitDirection, position)), Vector256.Create(_childHull.Support(unitDirection)));
        for (var i = 0; i < _paddedCount; i += Lanes)
        {
            var translation = VectorX4.Load(ref translations, i, _paddedCount);
            var separation = height - ((x * translation.X) + (y * translation.Y) + (z * translation.Z))
                - (Vector256.LoadUnsafe(ref translations, (nuint)((3 * _paddedCount) + i)) * support);
            separation = Vector256.MaxNative(separation, Vector256<double>.Zero);
            queue.RaiseBounds(separation * separation, i);
        }
    }
}
