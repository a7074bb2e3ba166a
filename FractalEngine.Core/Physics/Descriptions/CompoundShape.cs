using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>
/// A rigid body of several balls: where they are, and how its mass is spread. Balls may overlap. Immutable, and for any number of bodies.
/// </summary>
public sealed class CompoundShape
{
    /// <summary>Maximum number of balls of a shape.</summary>
    public const int MaxBalls = Scenes.BodyShape.MaxBallCount;

    // Relative to the radius: distance between the balls of a capsule. In between, they lie 1/32 of the radius deeper than its surface.
    private const double CapsuleSpacing = 0.5;

    private CompoundShape(IEnumerable<CompoundBall> balls, Vector centre, Matrix inertia)
    {
        Balls = [.. balls.Select(ball => ball with { Offset = ball.Offset - centre })];
        Centre = centre;
        Inertia = inertia;
        Radius = Balls.Max(static ball => ball.Offset.Length() + ball.Radius);
    }

    /// <summary>The balls, with offsets from the centre of mass.</summary>
    public ImmutableArray<CompoundBall> Balls { get; }

    /// <summary>True for a capsule, whose balls stand in a row and evenly.</summary>
    public bool IsCapsule { get; private init; }

    /// <summary>The centre of mass in the frame that the shape was described in, scene units.</summary>
    public Vector Centre { get; }

    /// <summary>Inertia tensor of one kilogram about the centre of mass, scene units².</summary>
    public Matrix Inertia { get; }

    /// <summary>Radius of the sphere about the centre of mass that holds all balls, scene units.</summary>
    public double Radius { get; }

    /// <summary>Makes a shape of solid balls of one density. Where two overlap, the matter of both counts.</summary>
    /// <param name="balls">One to <see cref="MaxBalls"/> balls, in any frame.</param>
    /// <exception cref="ArgumentException">There are none or too many, or a number is not finite or a radius not positive.</exception>
    public static CompoundShape OfBalls(IEnumerable<CompoundBall> balls)
    {
        var all = balls.ToImmutableArray();
        ArgumentCheck.Require(all.Length is > 0 and <= MaxBalls, $"expected 1 to {MaxBalls} balls");
        ArgumentCheck.Require(all.All(static ball => ball.Offset.IsFinite()), "the offsets of balls must be finite");
        ArgumentCheck.Require(
            all.All(static ball => ball.Radius > 0 && double.IsFinite(ball.Radius)), "the radii of balls must be positive");
        // Relative to the largest radius, so that no volume is too small or large for a double.
        var unit = all.Max(static ball => ball.Radius);
        var volume = all.Sum(ball => Cube(ball.Radius / unit));
        var centre = Vector.Zero;
        foreach (var ball in all)
        {
            centre += Cube(ball.Radius / unit) / volume * ball.Offset;
        }

        var inertia = 0 * Matrix.Identity;
        foreach (var ball in all)
        {
            // The inertia of a ball, moved by the theorem of parallel axes.
            var offset = ball.Offset - centre;
            var own = (0.4 * ball.Radius * ball.Radius) + offset.LengthSquared();
            inertia += Cube(ball.Radius / unit) / volume * ((own * Matrix.Identity) + (-1 * Matrix.Outer(offset, offset)));
        }

        return new(all, centre, inertia);
    }

    /// <summary>
    /// Makes a solid capsule: all points within a radius of a line segment. It is a row of balls half a radius apart, with the mass of the
    /// true capsule.
    /// </summary>
    /// <param name="from">One end of the segment.</param>
    /// <param name="to">The other end of the segment; both may be the same.</param>
    /// <param name="radius">Scene units, positive.</param>
    /// <exception cref="ArgumentException">
    /// A number is not finite, the radius is not positive, or the segment is longer than <see cref="MaxBalls"/> balls reach.
    /// </exception>
    public static CompoundShape Capsule(Vector from, Vector to, double radius)
    {
        ArgumentCheck.Require(from.IsFinite() && to.IsFinite(), "the ends of a capsule must be finite");
        ArgumentCheck.Require(radius > 0 && double.IsFinite(radius), "the radius of a capsule must be positive");
        var segment = to - from;
        var length = segment.Length();
        var gaps = Math.Ceiling(length / (CapsuleSpacing * radius));
        ArgumentCheck.Require(
            gaps < MaxBalls, FormattableString.Invariant($"a capsule may be {(MaxBalls - 1) * CapsuleSpacing} radii longer than its ends"));
        var balls = Enumerable.Range(0, (int)gaps + 1).Select(i => new CompoundBall(from + (i / Math.Max(1, gaps) * segment), radius));
        return new(balls, 0.5 * (from + to), CapsuleInertia(segment, length, radius)) { IsCapsule = true };
    }

    /// <summary>Inertia tensor of one kilogram of a cylinder between two half balls.</summary>
    private static Matrix CapsuleInertia(Vector segment, double length, double radius)
    {
        var cylinder = length / (length + (4.0 / 3 * radius));
        var ends = 1 - cylinder;
        var squared = radius * radius;
        var along = (0.5 * cylinder * squared) + (0.4 * ends * squared);
        // The centre of a half ball is 3/8 of the radius beyond the segment's end.
        var across = (cylinder * ((length * length / 12) + (0.25 * squared)))
            + (ends * ((0.4 * squared) + (0.25 * length * length) + (0.375 * length * radius)));
        var axis = length > 0 ? segment / length : Vector.I;
        return (across * Matrix.Identity) + ((along - across) * Matrix.Outer(axis, axis));
    }

    private static double Cube(double number) => number * number * number;
}
