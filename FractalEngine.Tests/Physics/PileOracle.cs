using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics;

/// <summary>
/// Frictionless, inelastic balls of one mass on a floor at y = 0, from the mechanics alone: positions follow Newton's law in tiny steps,
/// x″ = −g, and distances are then restored by displacements along the lines of contact of the step before (SHAKE, for inequalities).
/// It knows neither impulses nor accelerations of contacts, unlike what it is compared with.
/// </summary>
internal sealed class PileOracle
{
    private const int MaxRounds = 2000;

    // Relative to the radius: by how much a distance may be violated.
    private const double Tolerance = 1e-13;

    private readonly double _radius;
    private readonly double _step;
    private readonly double _gravity;
    private Vector[] _positions;
    private Vector[] _previous;
    private bool _hasStarted;

    /// <summary>Puts balls at rest where they neither overlap nor lie under the floor.</summary>
    /// <param name="positions">Centres.</param>
    /// <param name="radius">Radius of all balls.</param>
    /// <param name="step">Seconds; the error of speeds is proportional to it.</param>
    /// <param name="gravity">Units per second², downwards.</param>
    public PileOracle(IEnumerable<Vector> positions, double radius, double step, double gravity = 9.8)
    {
        _positions = [.. positions];
        _previous = [.. _positions];
        _radius = radius;
        _step = step;
        _gravity = gravity;
    }

    /// <summary>The centres now.</summary>
    public IReadOnlyList<Vector> Positions => _positions;

    /// <summary>The highest speed of a ball in the last step.</summary>
    public double FastestSpeed => _positions.Zip(_previous, (now, before) => (now - before).Length()).Max() / _step;

    /// <summary>Makes one step of Verlet's method.</summary>
    public void Step()
    {
        var next = new Vector[_positions.Length];
        // From rest, half of what gravity adds in later steps.
        var fall = (_hasStarted ? 1 : 0.5) * _step * _step * _gravity * Vector.J;
        for (var i = 0; i < next.Length; i++)
        {
            next[i] = (2 * _positions[i]) - _previous[i] - fall;
        }

        _hasStarted = true;
        for (var round = 0; round < MaxRounds && Restore(next) > Tolerance * _radius; round++)
        {
        }

        _previous = _positions;
        _positions = next;
    }

    /// <summary>Highest speed of any ball within a time.</summary>
    public double MaxSpeedWithin(double seconds)
    {
        var maxSpeed = 0.0;
        for (var i = 0; i < (int)Math.Round(seconds / _step); i++)
        {
            Step();
            maxSpeed = Math.Max(maxSpeed, FastestSpeed);
        }

        return maxSpeed;
    }

    /// <summary>Restores all distances, one after the other.</summary>
    /// <returns>The largest violation that was found.</returns>
    private double Restore(Vector[] next)
    {
        var worst = 0.0;
        for (var i = 0; i < next.Length; i++)
        {
            if (next[i].Y < _radius)
            {
                worst = Math.Max(worst, _radius - next[i].Y);
                next[i] = new(next[i].X, _radius, next[i].Z);
            }

            for (var j = i + 1; j < next.Length; j++)
            {
                var line = next[j] - next[i];
                var diameter = 2 * _radius;
                if (line.LengthSquared() < diameter * diameter)
                {
                    worst = Math.Max(worst, diameter - line.Length());
                    var oldLine = _positions[j] - _positions[i];
                    var shift = ((diameter * diameter) - line.LengthSquared()) / (4 * Vector.Dot(line, oldLine)) * oldLine;
                    next[i] -= shift;
                    next[j] += shift;
                }
            }
        }

        return worst;
    }
}
