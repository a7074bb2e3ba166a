using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <content>What the solve demands of each contact in a step.</content>
internal sealed partial class IslandPlanner
{
    // Relative to the restitution threshold: what is met more slowly is met at the end of the time, where that is known so far.
    private const double SlowFraction = 0.01;

    // Relative to the touch tolerance: smaller gaps are rounding, and stay.
    private const double NegligibleGap = 1e-9;

    /// <summary>Demands that two bodies be at least as far apart after the step as when they touch.</summary>
    /// <returns>By how much the line of contact has turned, radians.</returns>
    private double SetConstraint(ref ContactRow row, double stepLength, bool isFirst)
    {
        var body = bodies[row.First];
        var velocity = body.Velocity + Vector.Cross(body.SpinBase, row.FirstArm) - row.SurfaceVelocity;
        var shift = TurnShift(body, row.FirstArm, stepLength, isFirst);
        var distance = row.Offset.Length();
        var gap = distance - row.MinDistance;
        var turn = 0.0;
        if (isFirst && row.IsAhead)
        {
            row.IsBouncingAhead = -Vector.Dot(velocity, row.Normal) > SlowFraction * Threshold(in row);
        }

        if (row.IsBouncingAhead)
        {
            // Its way ends where it touches. It gives no impulse before it bounces, in the next step.
            row.MinNormalVelocity = double.NegativeInfinity;
            return 0;
        }

        if (!row.IsBall)
        {
            gap = RemoveRounding(Vector.Dot(row.Offset, row.Normal) - row.MinDistance, row.MinDistance);
            turn = (shift - row.TurnShift).MaxAbsComponent() / row.MinDistance;
        }
        else
        {
            var finalVelocity = isFirst ? velocity : _solver.RelativeVelocity(in row);
            var sum = (2 * row.Offset) + (0.5 * stepLength * (velocity + finalVelocity)) + shift;
            var length = sum.Length();
            var normal = sum / length;
            // |r₁|² − |r₀|² = (r₀ + r₁)·(r₁ − r₀) must not fall below d² − |r₀|².
            gap = RemoveRounding(gap, row.MinDistance) * (distance + row.MinDistance) / length;
            turn = (normal - row.Normal).MaxAbsComponent();
            row.Normal = normal;
        }

        row.TurnShift = shift;
        _solver.ComputeMasses(ref row);
        gap += Vector.Dot(shift, row.Normal);
        row.MinNormalVelocity = (-2 * gap / stepLength) - Vector.Dot(velocity, row.Normal);
        return turn;
    }

    /// <summary>The gap to close. Overlaps are left as they are, and rounding is no gap.</summary>
    private static double RemoveRounding(double gap, double minDistance) => gap > NegligibleGap * minDistance ? gap : 0;
}
