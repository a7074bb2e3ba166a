using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>The box and the hull of a sub-fractal in single precision, for eight positions at a time.</summary>
internal sealed class FloatBound
{
    private const int MaxPlanes = 8;
    private const int MaxVertices = 16;

    private readonly Vector256<float> _centreX;
    private readonly Vector256<float> _centreY;
    private readonly Vector256<float> _centreZ;
    private readonly Vector256<float> _halfX;
    private readonly Vector256<float> _halfY;
    private readonly Vector256<float> _halfZ;
    private readonly float _margin;
    private readonly float[] _planes;
    private readonly float[] _vertices;

    /// <summary>Prepares the bounds of a sub-fractal.</summary>
    /// <param name="box">A box around it.</param>
    /// <param name="planes">The planes of a hull around it; none where the box bounds as well.</param>
    /// <param name="vertices">The vertices of the hull; none where they are not worth their cost.</param>
    /// <param name="margin">How far the sub-fractal may reach out of the hull of the vertices.</param>
    public FloatBound(BoundingBox box, IReadOnlyList<HullPlane> planes, Vector[] vertices, double margin)
    {
        var centre = box.IsEmpty ? Vector.Zero : box.Centre;
        var (x, y, z) = centre;
        var (halfX, halfY, halfZ) = box.IsEmpty ? Vector.Zero : 0.5 * box.Size;
        (_centreX, _centreY, _centreZ) = (Vector256.Create((float)x), Vector256.Create((float)y), Vector256.Create((float)z));
        (_halfX, _halfY, _halfZ) = (Vector256.Create((float)halfX), Vector256.Create((float)halfY), Vector256.Create((float)halfZ));
        _margin = (float)margin;
        var planeCount = planes.Count <= MaxPlanes ? planes.Count : 0;
        _planes = [.. planes.Take(planeCount).SelectMany(plane => (float[])
        [
            (float)plane.Normal.X, (float)plane.Normal.Y, (float)plane.Normal.Z,
            (float)(plane.Offset - Vector.Dot(plane.Normal, centre)),
        ])];
        var vertexCount = vertices.Length <= MaxVertices && planeCount > 0 ? vertices.Length : 0;
        _vertices = [.. vertices.Take(vertexCount).Select(vertex => vertex - centre)
            .SelectMany(static offset => (float[])[(float)offset.X, (float)offset.Y, (float)offset.Z])];
    }

    /// <summary>True for hulls of so few planes that they are tested for all children at once.</summary>
    public static bool IsSimple(HullBound hull) => hull.Planes.Count <= MaxPlanes;

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(float) * (long)(_planes.Length + _vertices.Length)) + 256;

    /// <summary>Computes lower bounds of the squared distances of eight positions times a factor, but for rounding.</summary>
    /// <param name="x">The x coordinates in the frame of the sub-fractal.</param>
    /// <param name="y">The y coordinates.</param>
    /// <param name="z">The z coordinates.</param>
    /// <param name="scaleSquared">Factors of the squared distances.</param>
    /// <param name="cutoffsSquared">The bounds need not be the best from there on.</param>
    /// <param name="fromCentreSquared">Squared distances from the centre of the box.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<float> DistanceSquared(
        Vector256<float> x, Vector256<float> y, Vector256<float> z, Vector256<float> scaleSquared,
        Vector256<float> cutoffsSquared, out Vector256<float> fromCentreSquared)
    {
        var zero = Vector256<float>.Zero;
        var (dx, dy, dz) = (x - _centreX, y - _centreY, z - _centreZ);
        fromCentreSquared = (dx * dx) + (dy * dy) + (dz * dz);
        var outsideX = Vector256.MaxNative(Vector256.Abs(dx) - _halfX, zero);
        var outsideY = Vector256.MaxNative(Vector256.Abs(dy) - _halfY, zero);
        var outsideZ = Vector256.MaxNative(Vector256.Abs(dz) - _halfZ, zero);
        var squared = (outsideX * outsideX) + (outsideY * outsideY) + (outsideZ * outsideZ);
        squared *= scaleSquared;
        if (_planes.Length == 0)
        {
            return squared;
        }

        if (Vector256.LessThan(squared, cutoffsSquared).ExtractMostSignificantBits() == 0)
        {
            return squared;
        }

        var height = zero;
        ref var plane = ref MemoryMarshal.GetArrayDataReference(_planes);
        for (var i = 0; i < _planes.Length; i += 4)
        {
            height = Vector256.MaxNative(
                height,
                (Vector256.Create(Unsafe.Add(ref plane, i)) * dx) + (Vector256.Create(Unsafe.Add(ref plane, i + 1)) * dy)
                    + ((Vector256.Create(Unsafe.Add(ref plane, i + 2)) * dz) - Vector256.Create(Unsafe.Add(ref plane, i + 3))));
        }

        squared = Vector256.MaxNative(squared, height * height * scaleSquared);
        if (_vertices.Length == 0 || Vector256.LessThan(squared, cutoffsSquared).ExtractMostSignificantBits() == 0)
        {
            return squared;
        }

        var support = Vector256.Create(float.NegativeInfinity);
        ref var vertex = ref MemoryMarshal.GetArrayDataReference(_vertices);
        for (var i = 0; i < _vertices.Length; i += 3)
        {
            support = Vector256.MaxNative(
                support,
                (Vector256.Create(Unsafe.Add(ref vertex, i)) * dx) + (Vector256.Create(Unsafe.Add(ref vertex, i + 1)) * dy)
                    + (Vector256.Create(Unsafe.Add(ref vertex, i + 2)) * dz));
        }

        // The summand keeps 0 ÷ 0 away from a position at the centre.
        var length = Vector256.Sqrt(fromCentreSquared + Vector256.Create(float.Epsilon));
        var separation = ((fromCentreSquared - support) / length) - Vector256.Create(_margin);
        separation = Vector256.MaxNative(separation, zero);
        return Vector256.MaxNative(squared, separation * separation * scaleSquared);
    }
}
