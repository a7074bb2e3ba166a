using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>
/// A ray in the units of a sub-fractal's bounds, and which of the children it still has to visit. Fields are set in place: a frame is too
/// large to copy at each step.
/// </summary>
internal struct RayFrame
{
    // Farther away floats tell bounds apart less well than rounding allows.
    private const double MaxOriginDistance = 4;

    // What rounding in single precision may leave between a ray and a box that it enters.
    private const double EntryError = 1e-4;

    /// <summary>The bounds of the sub-fractal.</summary>
    public RayBounds Bounds;

    /// <summary>Remaining levels of the sub-fractal.</summary>
    public long RemainingLevels;

    /// <summary>The number of the way to it, as in <see cref="LevelState"/>.</summary>
    public ulong Way;

    /// <summary>The number of its size, as in <see cref="LevelState"/>.</summary>
    public long Size;

    /// <summary>Where the ray starts: x, y, z, 0.</summary>
    public Vector256<double> Origin;

    /// <summary>Its direction, of a length from 1 to 2: x, y, z, 0.</summary>
    public Vector256<double> Direction;

    /// <summary>The direction without components of 0.</summary>
    public Vector128<float> FloatDirection;

    /// <summary>Inverses of the components of the direction.</summary>
    public Vector128<float> InverseDirection;

    /// <summary>A bit for each component of the direction that is negative.</summary>
    public int Octant;

    /// <summary>Number of child instances that lead from the whole fractal to the sub-fractal.</summary>
    public int PathLength;

    /// <summary>The lane of the child that was entered last.</summary>
    public int Lane;

    /// <summary>A bit for each child that the ray has yet to visit, as of when it went on to the last one.</summary>
    public ulong Hits;

    /// <summary>Distance of the origin along the ray of the query.</summary>
    public double Start;

    /// <summary>
    /// Factors from the query to this frame, then from this frame to the query: <see cref="PerDistance"/>,
    /// <see cref="InverseScale"/>, <see cref="DistancePerParameter"/>, <see cref="Scale"/>. One product leads to a child.
    /// </summary>
    public Vector256<double> Factors;

    /// <summary>Factor from distances along the ray of the query to the parameter of this one.</summary>
    public readonly double PerDistance => Factors[0];

    /// <summary>Upper bound of the factor from lengths of the query to those in these units.</summary>
    public readonly double InverseScale => Factors[1];

    /// <summary>Factor from the parameter of this ray to distances along the ray of the query.</summary>
    public readonly double DistancePerParameter => Factors[2];

    /// <summary>Upper bound of the factor from lengths in these units to those of the query.</summary>
    public readonly double Scale => Factors[3];

    /// <summary>The origin in single precision.</summary>
    public readonly Vector128<float> FloatOrigin => ToFloats(Origin);

    /// <summary>What bounds are widened by on all sides: more than rounding.</summary>
    /// <param name="search">The search.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly float Widening(in RaySearch search) => FloatRay.Margin + (float)(InverseScale * search.Error);

    /// <summary>Converts a distance along the ray of the query to an upper bound of the parameter.</summary>
    public readonly float LimitFor(double distance) => FloatRay.LimitFor(Start, PerDistance, distance);

    /// <summary>Tells whether a ray that enters a child's box is near what the child is an instance of.</summary>
    /// <param name="box">The box.</param>
    /// <param name="parent">The box whose units are left.</param>
    /// <param name="map">From these units to those of the child.</param>
    public static bool IsNear(BoundingBox box, RayBox parent, AffineMap map)
    {
        var units = box.Transform(parent.ToUnits);
        var reach = new BoundingBox(units.Minimum - (EntryError * Vector.One), units.Maximum + (EntryError * Vector.One)).Transform(map);
        return Math.Max(reach.Minimum.MaxAbsComponent(), reach.Maximum.MaxAbsComponent()) < MaxOriginDistance;
    }

    /// <summary>Sets the bounds. Often the last ray left the same, and to write a reference costs more than to compare it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void SetBounds(RayBounds bounds)
    {
        if (Bounds != bounds)
        {
            Bounds = bounds;
        }
    }

    /// <summary>Begins with a ray in the frame of the sub-fractal.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="approach">How far it advances, to start near the box.</param>
    public void Set(in LocalRay ray, double approach)
    {
        var box = Bounds.Box;
        Origin = (ray.Origin + (Vector256.Create(approach) * ray.Direction) - box.Centre) * Vector256.Create(box.InverseHalfExtent);
        Start = ray.Start + approach;
        Factors = Vector256.Create(
            box.InverseHalfExtent, ray.InverseScale * box.InverseHalfExtent, box.HalfExtent, ray.Scale * box.HalfExtent);
        // Rays of a query in the frame of the fractal have unit directions.
        if (ray.Scale == 1 && ray.InverseScale == 1)
        {
            SetDirection(ray.Direction);
        }
        else
        {
            Turn(ray.Direction);
        }
    }

    /// <summary>Converts the ray back to the frame of the sub-fractal.</summary>
    /// <param name="box">The box of the sub-fractal.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly LocalRay ToLocal(RayBox box)
    {
        return new(
            box.Centre + (Origin * Vector256.Create(box.HalfExtent)), Direction * Vector256.Create(PerDistance * box.HalfExtent), Start,
            Scale * box.InverseHalfExtent, InverseScale * box.HalfExtent);
    }

    /// <summary>Takes the ray of another frame to a child, from where it enters the child's box.</summary>
    /// <param name="parent">The other frame.</param>
    /// <param name="child">The child.</param>
    /// <param name="entry">Parameter where the ray enters.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Enter(in RayFrame parent, in RayChild child, double entry)
    {
        var origin = Vector256.FusedMultiplyAdd(Vector256.Create(entry), parent.Direction, parent.Origin);
        Start = parent.Start + (entry * parent.DistancePerParameter);
        Factors = parent.Factors * child.Factors;
        PathLength = parent.PathLength + child.PathLength;
        RemainingLevels = child.RemainingLevels(parent.RemainingLevels);
        if (child.IsScaling)
        {
            Origin = Vector256.FusedMultiplyAdd(origin, Vector256.Create(child.Factors[0]), child.Map.Translation);
            Direction = parent.Direction;
            FloatDirection = parent.FloatDirection;
            InverseDirection = parent.InverseDirection;
            Octant = parent.Octant;
        }
        else
        {
            Origin = child.Map.Apply(origin);
            Turn(child.Map.ApplyLinear(parent.Direction));
        }
    }

    /// <summary>Moves the origin of a ray to where it may enter the box of a sub-fractal, if it is far away.</summary>
    /// <param name="box">The box.</param>
    /// <param name="search">The limit of the search, and its rounding.</param>
    /// <returns>False where a ray from afar misses the box.</returns>
    public bool TryApproach(RayBox box, in RaySearch search)
    {
        if (Vector256.LessThanAll(Vector256.Abs(Origin), Vector256.Create(MaxOriginDistance)))
        {
            return true;
        }

        var local = ToLocal(box);
        if (!box.TryApproach(ref local, in search))
        {
            return false;
        }

        Origin = (local.Origin - box.Centre) * Vector256.Create(box.InverseHalfExtent);
        Start = local.Start;
        return true;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector128<float> ToFloats(Vector256<double> v) => Avx.IsSupported
        ? Avx.ConvertToVector128Single(v)
        : Vector128.Narrow(v.GetLower(), v.GetUpper());

    /// <summary>Sets the direction after a map that is no mere scaling: a power of two makes its length one from 1 to 2, exactly.</summary>
    /// <param name="direction">The image of a direction whose parameter has the factors so far.</param>
    private void Turn(Vector256<double> direction)
    {
        const int MantissaBits = 52;
        const long One = 1023;
        var exponent = ((BitConverter.DoubleToInt64Bits(Vector256.Dot(direction, direction)) >> MantissaBits) - One) >> 1;
        var length = BitConverter.Int64BitsToDouble((One + exponent) << MantissaBits);
        var inverseLength = BitConverter.Int64BitsToDouble((One - exponent) << MantissaBits);
        Factors *= Vector256.Create(length, 1, inverseLength, 1);
        SetDirection(direction * Vector256.Create(inverseLength));
    }

    private void SetDirection(Vector256<double> direction)
    {
        Direction = direction;
        var components = ToFloats(direction);
        FloatDirection = FloatRay.WithoutZeros(components);
        InverseDirection = Vector128<float>.One / FloatDirection;
        Octant = (int)(components.ExtractMostSignificantBits() & 7);
    }
}
