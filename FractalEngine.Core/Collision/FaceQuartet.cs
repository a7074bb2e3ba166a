using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// <see cref="FaceKernel"/> on four faces at once, squared distances only. It does the reference's operations in the reference's
/// order, so the results are the same to the last bit; what the reference does in another way, it does through the reference.
/// </summary>
internal readonly struct FaceQuartet
{
    private readonly VectorQuartet _a;
    private readonly VectorQuartet _b;
    private readonly VectorQuartet _c;
    private readonly VectorQuartet _normal;
    private readonly Vector256<double> _ab2;
    private readonly Vector256<double> _bc2;
    private readonly Vector256<double> _ca2;
    private readonly Vector256<double> _normal2;
    private readonly Vector256<double> _thin;

    /// <summary>Four faces by their corners; computes what does not depend on a position.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public FaceQuartet(VectorQuartet a, VectorQuartet b, VectorQuartet c)
    {
        (_a, _b, _c) = (a, b, c);
        var (ab, ac) = (b - a, c - a);
        _normal = VectorQuartet.Cross(ab, ac);
        _normal2 = _normal.LengthSquared();
        _ab2 = ab.LengthSquared();
        _bc2 = (c - b).LengthSquared();
        _ca2 = (a - c).LengthSquared();
        _thin = ~Vector256.GreaterThan(_normal2, Vector256.Create(FaceKernel.ThinSineSquared) * (_ab2 * _ca2));
    }

    /// <summary>The squared distances of a position from the four faces.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> SquaredDistances(Vector position)
    {
        var p = VectorQuartet.All(position);
        var (ab, ac, ap) = (_b - _a, _c - _a, p - _a);
        var nearest = ToEdge(p, ap, _a, _b, ab, _ab2);
        nearest = Vector256.MinNative(nearest, ToEdge(p, p - _b, _b, _c, _c - _b, _bc2));
        nearest = Vector256.MinNative(nearest, ToEdge(p, p - _c, _c, _a, _a - _c, _ca2));
        var weightC = VectorQuartet.Dot(VectorQuartet.Cross(ab, ap), _normal) / _normal2;
        var weightB = VectorQuartet.Dot(VectorQuartet.Cross(ap, ac), _normal) / _normal2;
        var weightA = Vector256<double>.One - weightB - weightC;
        var height = VectorQuartet.Dot(ap, _normal);
        var smallest = Vector256.MinNative(Vector256.MinNative(weightB, weightC), weightA);
        var inside = Vector256.GreaterThanOrEqual(smallest, Vector256<double>.Zero);
        nearest = Vector256.ConditionalSelect(inside, Vector256.MinNative(height * height / _normal2, nearest), nearest);
        return _thin.AsInt64() == Vector256<long>.Zero ? nearest : WithThinOnes(position, nearest);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> ToEdge(
        VectorQuartet position, VectorQuartet from, VectorQuartet start, VectorQuartet end, VectorQuartet along, Vector256<double> lengthSquared)
    {
        var zero = Vector256<double>.Zero;
        var t = VectorQuartet.Dot(from, along) / lengthSquared & Vector256.GreaterThan(lengthSquared, zero);
        t = Vector256.MinNative(Vector256.MaxNative(t, zero), Vector256<double>.One);
        var point = VectorQuartet.Select(Vector256.Equals(t, Vector256<double>.One), end, start + (t * along));
        return (position - point).LengthSquared();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private Vector256<double> WithThinOnes(Vector position, Vector256<double> nearest)
    {
        for (var i = 0; i < 4; i++)
        {
            if (_thin.AsInt64()[i] != 0)
            {
                nearest = nearest.WithElement(i, FaceKernel.ClosestPoint(position, Corner(_a, i), Corner(_b, i), Corner(_c, i)).DistanceSquared);
            }
        }

        return nearest;
    }

    private static Vector Corner(VectorQuartet corners, int i) => new(corners.X[i], corners.Y[i], corners.Z[i]);
}
