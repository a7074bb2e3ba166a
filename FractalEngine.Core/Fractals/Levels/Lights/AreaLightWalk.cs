using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Lights;

/// <summary>
/// A walk down the light hierarchy, which chooses a part of each node as likely as it seems to matter to a surface; or follows a walk that
/// is known, and finds how likely it was.
/// </summary>
/// <remarks>
/// The importance is that of A. Conty Estevez and C. Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018:
/// the power over the squared distance, with bounds of the cosines at both ends. It may be rough; the probability is that of the choice.
/// </remarks>
/// <param name="position">Point of the surface, world space.</param>
/// <param name="normal">Its unit normal.</param>
/// <param name="number">From 0 to below 1: chooses.</param>
/// <param name="isUniform">True to choose by powers alone.</param>
internal struct AreaLightWalk(Vector position, Vector normal, double number, bool isUniform)
{
    // From so many radii away, distances and directions of the parts of a node are about the same.
    private const double FarRadii = 16;

    // A number with fewer digits left is replaced by a new one.
    private const double MinResolution = 1e-7;

    private double _number = number;
    private double _resolution = 1;
    private ulong _seed = BitConverter.DoubleToUInt64Bits(number);
    private bool _isFar;
    private double _norm = 1;
    private SimdAffineMap _map = SimdAffineMap.Identity;

    /// <summary>The probability of the walk so far.</summary>
    public double Probability { get; private set; } = 1;

    /// <summary>Goes on to the frame of a part.</summary>
    /// <param name="map">From there to the present frame.</param>
    /// <param name="norm">Upper bound of the factor by which the map lengthens vectors.</param>
    /// <param name="node">The outermost node in that frame.</param>
    public void Enter(in AffineMap map, double norm, AreaLightNode? node)
    {
        _map = SimdAffineMap.Compose(in _map, in map);
        _norm *= norm;
        _isFar |= node is not null && IsFarFrom(node);
    }

    /// <summary>Maps a triangle of the present frame to world space.</summary>
    public readonly (Vector A, Vector B, Vector C) ToWorld((Vector A, Vector B, Vector C) triangle) =>
        (_map.Apply(triangle.A), _map.Apply(triangle.B), _map.Apply(triangle.C));

    /// <summary>Chooses a part of a node.</summary>
    /// <returns>Its index.</returns>
    [SkipLocalsInit]
    public int Choose(AreaLightNode node)
    {
        Span<double> buffer = stackalloc double[node.Parts.Length];
        var weights = Weigh(node, buffer, out var sum);
        var target = _number * sum;
        var slot = 0;
        for (; slot < weights.Length - 1 && (target >= weights[slot] || weights[slot] == 0); slot++)
        {
            target -= weights[slot];
        }

        Probability *= weights[slot] / sum;
        _resolution *= weights[slot] / sum;
        _number = Math.Clamp(target / weights[slot], 0, 1 - 1e-15);
        if (!(_resolution > MinResolution))
        {
            // The generator splitmix64, after G. Steele and others, OOPSLA 2014.
            _seed += 0x9E3779B97F4A7C15;
            var bits = (_seed ^ (_seed >> 30)) * 0xBF58476D1CE4E5B9;
            bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EB;
            (_number, _resolution) = (Math.ScaleB((bits ^ (bits >> 31)) >> 11, -53), 1);
        }

        return slot;
    }

    /// <summary>Goes to a part of a node that is known.</summary>
    [SkipLocalsInit]
    public void Follow(AreaLightNode node, int slot)
    {
        Span<double> buffer = stackalloc double[node.Parts.Length];
        var weights = Weigh(node, buffer, out var sum);
        Probability *= weights[slot] / sum;
    }

    private readonly bool IsFarFrom(AreaLightNode node)
    {
        var reach = FarRadii * _norm * node.Total.Radius;
        return (_map.Apply(node.Total.Centre) - position).LengthSquared() > reach * reach;
    }

    /// <summary>Computes the weights of the parts of a node.</summary>
    /// <param name="node">In the present frame.</param>
    /// <param name="buffer">Memory for them.</param>
    /// <param name="sum">Their sum.</param>
    private readonly ReadOnlySpan<double> Weigh(AreaLightNode node, Span<double> buffer, out double sum)
    {
        sum = node.Total.Power;
        if (isUniform || node.Parts.Length == 1 || (node.IsAlike && (_isFar || IsFarFrom(node))))
        {
            return node.Powers;
        }

        var cofactors = _map.ToAffineMap().Linear.Cofactors();
        var upwards = SimdAffineMap.ToVector(_map.MultiplyTransposed(SimdAffineMap.ToVector256(normal))).Absolute();
        var areaFactor = AreaLightBounds.AreaFactor(in cofactors);
        sum = 0;
        for (var i = 0; i < buffer.Length; i++)
        {
            buffer[i] = Importance(in node.Parts[i], in cofactors, areaFactor, upwards);
            sum += buffer[i];
        }

        if (sum is > 0 and < double.PositiveInfinity)
        {
            return buffer;
        }

        // Nothing that would be seen: any choice is as good.
        sum = node.Total.Power;
        return node.Powers;
    }

    private readonly double Importance(in AreaLightBounds part, in Matrix cofactors, double areaFactor, Vector upwards)
    {
        var direction = _map.Apply(part.Centre) - position;
        // How high the box reaches above the surface: flat swarms are much lower than their balls.
        var height = Vector.Dot(normal, direction) + Vector.Dot(upwards, part.HalfSize);
        if (!(height > 0))
        {
            return 0;
        }

        var distanceSquared = direction.LengthSquared();
        var radius = _norm * part.Radius;
        var axis = part.Cosine > 0 ? cofactors * part.Axis : Vector.Zero;
        var axisLength = part.Cosine > 0 ? axis.Length() : 1;
        var power = part.Power * (part.Cosine == 1 ? axisLength : areaFactor);
        if (distanceSquared <= radius * radius)
        {
            // The mean of 1/d² over a ball is 3/r² from its centre, and about half of that from its surface.
            var squaredRadius = radius * radius;
            return power * (3 - (1.5 * distanceSquared / squaredRadius)) / squaredRadius;
        }

        // What the ball spans around its centre, as seen from the surface.
        var distance = Math.Sqrt(distanceSquared);
        var sine = radius / distance;
        var cosine = Math.Sqrt(1 - (sine * sine));
        var atSurface = Math.Min(height / distance, CosineOfDifference(Vector.Dot(normal, direction) / distance, cosine, sine));
        var partSine = Math.Sqrt(1 - (part.Cosine * part.Cosine));
        var spread = (part.Cosine * cosine) - (partSine * sine);
        var atLight = spread <= 0 ? 1 : CosineOfDifference(
            Math.Abs(Vector.Dot(axis, direction)) / (axisLength * distance), spread, (partSine * cosine) + (part.Cosine * sine));
        return power * atSurface * atLight / distanceSquared;
    }

    /// <summary>The cosine of the first angle less the second one, limited to those from 0 to 90 degrees.</summary>
    private static double CosineOfDifference(double cosine1, double cosine2, double sine2) => cosine1 >= cosine2 ? 1
        : Math.Max(0, (cosine1 * cosine2) + (Math.Sqrt(Math.Max(0, 1 - (cosine1 * cosine1))) * sine2));
}
