using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <content>What the solve demands of each contact in a step.</content>
internal sealed partial class IslandPlanner
{
    // Relative to the distance at which balls touch: on a longer way the mean line of contact may be far from that of the impact.
    private const double MaxShortWay = 0.25;

    // Relative to the restitution threshold: what is met more slowly is met at the end of the time, where that is known so far.
    private const double SlowFraction = 0.01;

    // Relative to the touch tolerance: smaller gaps are rounding, and stay.
    private const double NegligibleGap = 1e-9;

    /// <summary>Demands that two bodies be at least as far apart after the step as when they touch.</summary>
    /// <returns>By how much the line of contact has turned, radians.</returns>
    private double SetConstraint(ref ContactRow row, double stepLength, bool isFirst)
    {
        var velocity = row.HasArms ? BaseVelocity(in row)
            : bodies[row.First].Velocity - (row.Second >= 0 ? bodies[row.Second].Velocity : row.SurfaceVelocity);
        var shift = row.HasArms ? TurnShift(in row, stepLength, isFirst) : Vector.Zero;
        var distance = row.Offset.Length();
        var gap = distance - row.MinDistance;
        var turn = 0.0;
        if (isFirst && row.IsAhead)
        {
            SetImpactAhead(ref row, stepLength, velocity);
        }

        if (row.IsBouncingAhead)
        {
            // Its way ends where it touches. It gives no impulse before it bounces, in the next step.
            row.MinNormalVelocity = double.NegativeInfinity;
            return 0;
        }

        if (row.HasFixedNormal || !row.IsBall)
        {
            gap = RemoveRounding(Vector.Dot(row.Offset, row.Normal) - row.MinDistance, row.MinDistance);
            turn = row.HasArms ? (shift - row.TurnShift).MaxAbsComponent() / row.MinDistance : 0;
        }
        else if (row.IsBall)
        {
            var finalVelocity = isFirst ? velocity : _solver.RelativeVelocity(in row);
            var sum = (2 * row.Offset) + (0.5 * stepLength * (velocity + finalVelocity));
            sum = row.HasArms ? sum + shift : sum;
            var length = sum.Length();
            var normal = sum / length;
            // |r₁|² − |r₀|² = (r₀ + r₁)·(r₁ − r₀) must not fall below d² − |r₀|².
            gap = RemoveRounding(gap, row.MinDistance) * (distance + row.MinDistance) / length;
            turn = (normal - row.Normal).MaxAbsComponent();
            row.Normal = normal;
        }

        if (row.HasArms)
        {
            row.TurnShift = shift;
            _solver.ComputeMasses(ref row);
            gap += Vector.Dot(shift, row.Normal);
        }

        row.MinNormalVelocity = (-2 * gap / stepLength) - Vector.Dot(velocity, row.Normal);
        return turn;
    }

    /// <summary>Tells what will bounce that does not touch yet, and what goes so far that the line of its impact counts.</summary>
    private void SetImpactAhead(ref ContactRow row, double stepLength, Vector velocity)
    {
        var approach = -Vector.Dot(velocity, row.Normal);
        row.IsBouncingAhead = row.IsMetExactly ? approach > SlowFraction * Threshold(in row)
            : row.Restitution > 0 && approach > Threshold(in row);
        row.HasFixedNormal = row.IsBall && TryFindImpactNormal(in row, stepLength * velocity, out row.Normal);
    }

    /// <summary>The gap to close. Overlaps are left as they are, and rounding is no gap.</summary>
    private static double RemoveRounding(double gap, double minDistance) => gap > NegligibleGap * minDistance ? gap : 0;

    /// <summary>
    /// Finds the line of contact at the impact ahead, of two bodies that are so fast that the mean line would let them pass each other.
    /// </summary>
    /// <param name="row">A contact of two balls that do not touch yet.</param>
    /// <param name="way">Way of the first ball relative to the second, as far as it is known.</param>
    /// <param name="normal">Receives the unit vector of that line, or of the line now.</param>
    private static bool TryFindImpactNormal(in ContactRow row, Vector way, out Vector normal)
    {
        normal = row.Normal;
        var wayLengthSquared = way.LengthSquared();
        if (!row.IsBouncingAhead && wayLengthSquared <= MaxShortWay * MaxShortWay * row.MinDistance * row.MinDistance)
        {
            return false;
        }

        // |r + t·s| = d at the first time t, or the closest approach where they miss each other.
        var closest = -Vector.Dot(row.Offset, way) / wayLengthSquared;
        var missSquared = (row.Offset + (closest * way)).LengthSquared();
        var lead = Math.Sqrt(Math.Max(0, (row.MinDistance * row.MinDistance) - missSquared) / wayLengthSquared);
        normal = (row.Offset + (Math.Clamp(closest - lead, 0, 1) * way)).UnitVectorOrZero();
        return true;
    }
}
