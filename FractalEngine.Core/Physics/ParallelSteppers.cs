using FractalEngine.Core.Collision;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Lets threads share what bodies do one by one: they ask where surfaces are, and go their planned ways. Each group of bodies has a
/// stepper of its own, so that no two threads use the same one.
/// </summary>
/// <param name="createStepper">Makes a stepper with the context of its queries.</param>
/// <param name="maxThreads">Number of threads that may work.</param>
internal sealed class ParallelSteppers(Func<QueryContext, BodyStepper> createStepper, int maxThreads)
{
    // Fewer bodies are stepped as soon by one thread.
    private const int MinBodies = 256;
    private const int MinBodiesOfGroup = 32;
    private const int MaxGroups = 32;

    private readonly List<Body> _bodies = [];
    private readonly List<(BodyStepper Stepper, QueryContext Context)> _steppers = [];
    private Action<BodyStepper, Body>? _act;
    private Action<int>? _runGroup;
    private int _bodiesPerGroup;

    /// <summary>The bodies that take part next.</summary>
    public List<Body> Bodies => _bodies;

    /// <summary>True where so many bodies are worth more than one thread.</summary>
    public static bool AreMany(int bodyCount) => bodyCount >= MinBodies;

    /// <summary>Counts the tests of all queries so far.</summary>
    public (long Faces, long Bounds) CountTests()
    {
        var (faces, bounds) = (0L, 0L);
        foreach (var (_, context) in _steppers)
        {
            faces += context.Statistics.FaceTests;
            bounds += context.Statistics.BoundTests;
        }

        return (faces, bounds);
    }

    /// <summary>Lets all bodies act that take part, and ends their part.</summary>
    /// <param name="act">Changes its body alone. What it does must not depend on the stepper.</param>
    public void Run(Action<BodyStepper, Body> act)
    {
        _act = act;
        _bodiesPerGroup = Math.Max(MinBodiesOfGroup, (_bodies.Count + MaxGroups - 1) / MaxGroups);
        var groupCount = (_bodies.Count + _bodiesPerGroup - 1) / _bodiesPerGroup;
        while (_steppers.Count < groupCount)
        {
            var context = new QueryContext();
            _steppers.Add((createStepper(context), context));
        }

        WorkerSet.Shared.Run(groupCount, maxThreads, _runGroup ??= RunGroup);
        _bodies.Clear();
    }

    private void RunGroup(int group)
    {
        var end = Math.Min(_bodies.Count, (group + 1) * _bodiesPerGroup);
        for (var i = group * _bodiesPerGroup; i < end; i++)
        {
            _act!(_steppers[group].Stepper, _bodies[i]);
        }
    }
}
