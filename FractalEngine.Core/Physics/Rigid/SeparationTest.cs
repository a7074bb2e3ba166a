using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Finds axes along which parts of two moving surfaces are apart, and how long they stay so: separating axes (Gottschalk, Lin and Manocha
/// 1996) with bounds of the motion along each (Tang, Kim and Manocha 2009).
/// </summary>
/// <remarks>
/// A point p of a surface that turns by θ about what goes straight on with the velocity u moves along a unit vector n by
/// n·(u + θ×p)·t, and by no more than |θ|²·ρ·t²/2 besides, where ρ is the distance from the axis of the farthest point of its part.
/// Where the second surface turns and is large, the first one is seen from it: then it is at rest, and what is fictitious (2θ×v, θ×(θ×p))
/// adds to the acceleration of the first.
/// </remarks>
internal readonly ref struct SeparationTest
{
    // A shorter product of two edges has no direction: they are parallel.
    private const double MinSine = 1e-6;

    // So many times smaller must the bound of the motion be in the frame of the second surface.
    private const double MinGain = 4;

    private static readonly SurfaceMotion AtRest = new(default, Orientation.Identity, 1, default, default);

    private readonly ref readonly SurfaceMotion _first;
    private readonly ref readonly SurfaceMotion _second;
    private readonly double _curvature;

    /// <summary>Prepares the test of two parts.</summary>
    /// <param name="first">Motion of the first surface, from now on.</param>
    /// <param name="second">Motion of the second surface, in the same frame and unit of time.</param>
    /// <param name="centre1">Middle of the first part now.</param>
    /// <param name="radius1">Radius about it.</param>
    /// <param name="centre2">Middle of the second part now.</param>
    /// <param name="radius2">Radius about it.</param>
    /// <param name="relative">Receives the motion of the first surface as seen from the second one, if that is looked at.</param>
    public SeparationTest(
        in SurfaceMotion first, in SurfaceMotion second, Vector centre1, double radius1, Vector centre2, double radius2,
        [UnscopedRef] out SurfaceMotion relative)
    {
        Unsafe.SkipInit(out relative);
        _first = ref first;
        _second = ref second;
        _curvature = Curvature(in first, centre1, radius1) + Curvature(in second, centre2, radius2);
        if (!(second.Angle > 0) || radius2 <= MinGain * radius1)
        {
            return;
        }

        var way = (first.Travel - second.Travel).Length() + (first.Angle * ((centre1 - first.Position).Length() + radius1));
        var arm = (centre1 - second.Position).Length() + radius1 + way;
        var curvature = Curvature(in first, centre1, radius1) + (second.Angle * (way + (0.5 * second.Angle * arm)));
        if (MinGain * curvature < _curvature)
        {
            relative = first.SeenFrom(in second);
            _first = ref relative;
            _second = ref AtRest;
            _curvature = curvature;
        }
    }

    /// <summary>Finds for how long two boxes surely stay farther apart than a distance.</summary>
    /// <param name="first">The first part's box, now.</param>
    /// <param name="second">The second part's box, now.</param>
    /// <param name="distance">The distance, scene units.</param>
    /// <param name="enough">The method may return early any time that is no shorter.</param>
    public double SafeTime(in SurfaceBox first, in SurfaceBox second, double distance, double enough)
    {
        var between = first.Centre - second.Centre;
        var length = between.Length();
        var time = 0.0;
        if (length > 0 && TestAxis(between / length, in first, in second, distance, enough, ref time))
        {
            return time;
        }

        for (var i = 0; i < 6; i++)
        {
            var axis = i < 3 ? Column(first.Normals, i) : Column(second.Normals, i - 3);
            if (axis != Vector.Zero && TestAxis(axis, in first, in second, distance, enough, ref time))
            {
                return time;
            }
        }

        for (var i = 0; i < 9; i++)
        {
            var axis = Vector.Cross(Column(first.HalfAxes, i / 3), Column(second.HalfAxes, i % 3));
            var size = axis.LengthSquared();
            if (size > MinSine * MinSine * Column(first.HalfAxes, i / 3).LengthSquared() * Column(second.HalfAxes, i % 3).LengthSquared()
                && TestAxis(axis / Math.Sqrt(size), in first, in second, distance, enough, ref time))
            {
                return time;
            }
        }

        return time;
    }

    /// <summary>Finds the axis along which two boxes are farthest apart now, and by how much; negative where none parts them.</summary>
    /// <param name="first">The first box.</param>
    /// <param name="second">The second box.</param>
    /// <param name="enough">The first axis with a larger gap may be returned.</param>
    public static (Vector Axis, double Gap) Separate(in SurfaceBox first, in SurfaceBox second, double enough)
    {
        var between = first.Centre - second.Centre;
        var best = (Axis: Vector.Zero, Gap: double.NegativeInfinity);
        for (var i = 0; i < 15 && best.Gap <= enough; i++)
        {
            var axis = i < 3 ? Column(first.Normals, i)
                : i < 6 ? Column(second.Normals, i - 3)
                : Vector.Cross(Column(first.HalfAxes, (i - 6) / 3), Column(second.HalfAxes, (i - 6) % 3)).UnitVectorOrZero();
            var height = Vector.Dot(axis, between);
            var gap = Math.Abs(height) - first.Extent(axis) - second.Extent(axis);
            if (gap > best.Gap && axis != Vector.Zero)
            {
                best = (height < 0 ? -axis : axis, gap);
            }
        }

        return best;
    }

    /// <summary>Finds for how long two boxes surely stay farther apart than a distance along an axis.</summary>
    /// <param name="axis">Unit vector from the second to the first.</param>
    /// <param name="first">The first part's box, now.</param>
    /// <param name="second">The second part's box, now.</param>
    /// <param name="distance">The distance, scene units.</param>
    public double SafeTime(Vector axis, in SurfaceBox first, in SurfaceBox second, double distance) =>
        SafeTime(ReachOf(in first, axis, in _first, 1), ReachOf(in second, axis, in _second, -1), distance);

    /// <summary>Finds for how long a triangle of one surface surely stays farther from a box of the other than a distance.</summary>
    /// <param name="triangle">Of one surface, now.</param>
    /// <param name="box">Of the other surface, now.</param>
    /// <param name="isFirst">True for a triangle of the first surface.</param>
    /// <param name="distance">The distance, scene units.</param>
    /// <param name="enough">The method may return early any time that is no shorter.</param>
    public double SafeTime(in SurfaceTriangle triangle, in SurfaceBox box, bool isFirst, double distance, double enough)
    {
        var time = 0.0;
        for (var i = 0; i < 4 && time < enough; i++)
        {
            var axis = i == 3 ? triangle.Normal : Column(box.Normals, i);
            axis = Vector.Dot(axis, triangle.Centre - box.Centre) < 0 == isFirst ? -axis : axis;
            time = axis == Vector.Zero ? time : Math.Max(time, isFirst
                ? SafeTime(ReachOf(in triangle, axis, in _first, 1), ReachOf(in box, axis, in _second, -1), distance)
                : SafeTime(ReachOf(in box, axis, in _first, 1), ReachOf(in triangle, axis, in _second, -1), distance));
        }

        return time;
    }

    /// <summary>Finds for how long two triangles surely stay farther apart, by their planes and the line between their middles.</summary>
    /// <param name="first">Of the first surface, now.</param>
    /// <param name="second">Of the second surface, now.</param>
    /// <param name="distance">The distance, scene units.</param>
    /// <param name="enough">The method may return early any time that is no shorter.</param>
    public double SafeTime(in SurfaceTriangle first, in SurfaceTriangle second, double distance, double enough)
    {
        var between = first.Centre - second.Centre;
        var length = between.Length();
        var time = length > 0 ? SafeTime(between / length, in first, in second, distance) : 0;
        for (var i = 0; i < 2 && time < enough; i++)
        {
            var axis = i == 0 ? first.Normal : second.Normal;
            axis = Vector.Dot(axis, between) < 0 ? -axis : axis;
            time = axis == Vector.Zero ? time : Math.Max(time, SafeTime(axis, in first, in second, distance));
        }

        return time;
    }

    /// <summary>Finds for how long two triangles surely stay farther apart along axes at right angles to an edge of each.</summary>
    /// <param name="first">Of the first surface, now.</param>
    /// <param name="second">Of the second surface, now.</param>
    /// <param name="distance">The distance, scene units.</param>
    /// <param name="enough">The method may return early any time that is no shorter.</param>
    public double EdgeSafeTime(in SurfaceTriangle first, in SurfaceTriangle second, double distance, double enough)
    {
        var between = first.Centre - second.Centre;
        var time = 0.0;
        for (var i = 0; i < 9 && time < enough; i++)
        {
            var axis = Vector.Cross(Edge(in first, i / 3), Edge(in second, i % 3)).UnitVectorOrZero();
            axis = Vector.Dot(axis, between) < 0 ? -axis : axis;
            time = axis == Vector.Zero ? time : Math.Max(time, SafeTime(axis, in first, in second, distance));
        }

        return time;
    }

    /// <summary>Finds for how long two triangles surely stay farther apart along an axis.</summary>
    /// <param name="axis">Unit vector from the second to the first.</param>
    /// <param name="first">Of the first surface, now.</param>
    /// <param name="second">Of the second surface, now.</param>
    /// <param name="distance">The distance, scene units.</param>
    public double SafeTime(Vector axis, in SurfaceTriangle first, in SurfaceTriangle second, double distance) =>
        SafeTime(ReachOf(in first, axis, in _first, 1), ReachOf(in second, axis, in _second, -1), distance);

    private static double Curvature(in SurfaceMotion motion, Vector centre, double radius) =>
        motion.Angle > 0 ? 0.5 * motion.Angle * motion.Angle * ((centre - motion.Position).Length() + radius) : 0;

    private bool TestAxis(
        Vector axis, in SurfaceBox first, in SurfaceBox second, double distance, double enough, ref double time)
    {
        axis = Vector.Dot(axis, first.Centre - second.Centre) < 0 ? -axis : axis;
        var reach1 = ReachOf(in first, axis, in _first, 1);
        var reach2 = ReachOf(in second, axis, in _second, -1);
        var gap = reach1.A.Height + reach2.A.Height;
        time = Math.Max(time, gap > distance ? SafeTime(gap - distance, reach1.A.Speed + reach2.A.Speed) : 0);
        return time >= enough;
    }

    /// <summary>Finds for how long all points of two parts stay apart, of which each has up to three that decide.</summary>
    private double SafeTime(in Reach first, in Reach second, double distance)
    {
        var time = double.PositiveInfinity;
        for (var i = 0; i < first.Count; i++)
        {
            for (var j = 0; j < second.Count; j++)
            {
                var room = first[i].Height + second[j].Height - distance;
                if (!(room > 0))
                {
                    return 0;
                }

                time = Math.Min(time, SafeTime(room, first[i].Speed + second[j].Speed));
            }
        }

        return time;
    }

    // On approach the root is as large as the speed to many digits: their difference would tell nothing where bodies are fast.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private double SafeTime(double room, double speed) =>
        _curvature > 0 && speed < 0 ? 2 * room / (Math.Sqrt((speed * speed) + (4 * _curvature * room)) - speed)
        : _curvature > 0 ? (speed + Math.Sqrt((speed * speed) + (4 * _curvature * room))) / (2 * _curvature)
        : speed < 0 ? room / -speed
        : double.PositiveInfinity;

    /// <summary>How far the points of a box reach down along an axis, times a sign, and how fast they do at least.</summary>
    private static Reach ReachOf(in SurfaceBox box, Vector axis, in SurfaceMotion motion, int sign)
    {
        var height = (sign * Vector.Dot(axis, box.Centre)) - box.Extent(axis);
        var speed = sign * Vector.Dot(axis, motion.VelocityAt(box.Centre));
        return new((height, motion.Angle > 0 ? speed - box.Spread(Vector.Cross(axis, motion.Turn)) : speed));
    }

    /// <summary>How far the corners of a triangle reach down along an axis, times a sign, and how fast they do.</summary>
    private static Reach ReachOf(in SurfaceTriangle triangle, Vector axis, in SurfaceMotion motion, int sign)
    {
        var (a, b, c) = triangle.Corners;
        return new(
            ((sign * Vector.Dot(axis, a)) - triangle.Rounding, sign * Vector.Dot(axis, motion.VelocityAt(a))),
            ((sign * Vector.Dot(axis, b)) - triangle.Rounding, sign * Vector.Dot(axis, motion.VelocityAt(b))),
            ((sign * Vector.Dot(axis, c)) - triangle.Rounding, sign * Vector.Dot(axis, motion.VelocityAt(c))));
    }

    private static Vector Edge(in SurfaceTriangle triangle, int index) => index == 0 ? triangle.Corners.B - triangle.Corners.A
        : index == 1 ? triangle.Corners.C - triangle.Corners.B
        : triangle.Corners.A - triangle.Corners.C;

    private static Vector Column(in Matrix matrix, int index) => index == 0 ? matrix.V1 : index == 1 ? matrix.V2 : matrix.V3;

    /// <summary>Heights of points along an axis, and how fast they rise.</summary>
    private readonly struct Reach
    {
        private readonly (double Height, double Speed) _b;
        private readonly (double Height, double Speed) _c;

        public Reach((double Height, double Speed) all)
        {
            A = all;
            Count = 1;
        }

        public Reach((double Height, double Speed) a, (double Height, double Speed) b, (double Height, double Speed) c)
        {
            A = a;
            _b = b;
            _c = c;
            Count = 3;
        }

        public (double Height, double Speed) A { get; }

        public int Count { get; }

        public (double Height, double Speed) this[int index] => index == 0 ? A : index == 1 ? _b : _c;
    }
}
