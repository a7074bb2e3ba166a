namespace FractalEngine.Core.Physics.Statics;

/// <summary>Counts the steps of a world and adds up their lengths.</summary>
/// <remarks>
/// A run of equal steps is multiplied, not summed: n steps of 1/60 s make exactly n · (1/60) seconds, without accumulated rounding.
/// </remarks>
internal struct StepClock
{
    private double _runStartTime;
    private double _runStepLength;
    private long _runStepCount;

    /// <summary>Number of steps since the beginning.</summary>
    public long StepCount { get; private set; }

    /// <summary>Seconds since the beginning: the sum of all steps.</summary>
    public readonly double Time => _runStartTime + (_runStepCount * _runStepLength);

    /// <summary>Counts one step and adds its length.</summary>
    /// <param name="seconds">Length of the step, positive.</param>
    public void Tick(double seconds)
    {
        if (seconds != _runStepLength)
        {
            _runStartTime = Time;
            _runStepLength = seconds;
            _runStepCount = 0;
        }

        _runStepCount++;
        StepCount++;
    }
}
