using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>A ray for boxes of objects, four at a time, in double precision: what all nodes of a hierarchy need of it.</summary>
/// <param name="ray">In the frame of the boxes.</param>
/// <param name="error">What boxes are widened by on all sides.</param>
internal readonly struct ObjectRay(in LocalRay ray, double error)
{
    // A slower ray than this passes no box within the range of coordinates.
    private const double MinComponent = 1e-30;

    private readonly Axis _x = new(ray.Origin[0], ray.Direction[0], error);
    private readonly Axis _y = new(ray.Origin[1], ray.Direction[1], error);
    private readonly Axis _z = new(ray.Origin[2], ray.Direction[2], error);

    /// <summary>Distance of the origin along the ray of the query.</summary>
    public double Start { get; } = ray.Start;

    /// <summary>Clips the parts of the ray within four boxes at their sides across an axis.</summary>
    /// <param name="axis">From 0 to 2.</param>
    /// <param name="minimum">The sides with the smaller coordinates.</param>
    /// <param name="maximum">The sides with the larger ones.</param>
    /// <param name="near">Receives the later of itself and where the ray enters, from its origin.</param>
    /// <param name="far">Receives the sooner of itself and where the ray leaves.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Clip(
        int axis, Vector256<double> minimum, Vector256<double> maximum, ref Vector256<double> near, ref Vector256<double> far)
    {
        ref readonly var slab = ref axis == 0 ? ref _x : ref axis == 1 ? ref _y : ref _z;
        var low = (minimum - slab.LowOrigin) * slab.Inverse;
        var high = (maximum - slab.HighOrigin) * slab.Inverse;
        near = Vector256.MaxNative(near, slab.IsPositive ? low : high);
        far = Vector256.MinNative(far, slab.IsPositive ? high : low);
    }

    private readonly struct Axis
    {
        public readonly Vector256<double> LowOrigin;
        public readonly Vector256<double> HighOrigin;
        public readonly Vector256<double> Inverse;
        public readonly bool IsPositive;

        public Axis(double origin, double component, double error)
        {
            var inverse = 1 / (Math.Abs(component) < MinComponent ? double.CopySign(MinComponent, component) : component);
            LowOrigin = Vector256.Create(origin + error);
            HighOrigin = Vector256.Create(origin - error);
            Inverse = Vector256.Create(inverse);
            IsPositive = inverse > 0;
        }
    }
}
