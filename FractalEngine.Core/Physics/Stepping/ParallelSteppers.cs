using FractalEngine.Core.Queries;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Stepping;

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

    private readonly List<(BodyStepper Stepper, QueryContext Context)> _steppers = [];
    private Action<BodyStepper, int>? _act;
    private int _count;
    private int _bodiesPerGroup;

    /// <summary>Number of threads that may work.</summary>
    public int MaxThreads => maxThreads;

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

    /// <summary>Makes the steppers for so many bodies, and for fewer, if they are many.</summary>
    public void Reserve(int bodyCount)
    {
        for (var missing = AreMany(bodyCount) ? SetGroups(bodyCount) - _steppers.Count : 0; missing > 0; missing--)
        {
            var context = new QueryContext();
            context.MakeRoom();
            _steppers.Add((createStepper(context), context));
        }

        foreach (var (stepper, _) in _steppers)
        {
            stepper.Reserve(bodyCount);
        }
    }

    /// <summary>Lets the first bodies of the world act, or those of an island, in groups that threads share.</summary>
    /// <param name="count">Their number, for which there must be steppers.</param>
    /// <param name="act">Changes the body of an index below that alone. What it does must not depend on the stepper.</param>
    public void Run(int count, Action<BodyStepper, int> act)
    {
        _act = act;
        _count = count;
        WorkerSet.Shared.Run(SetGroups(count), maxThreads, this, static (steppers, group) => steppers.RunGroup(group));
    }

    /// <summary>Sets how many bodies are in a group.</summary>
    /// <returns>The number of groups.</returns>
    private int SetGroups(int count)
    {
        _bodiesPerGroup = Math.Max(MinBodiesOfGroup, (count + MaxGroups - 1) / MaxGroups);
        return (count + _bodiesPerGroup - 1) / _bodiesPerGroup;
    }

    private void RunGroup(int group)
    {
        var end = Math.Min(_count, (group + 1) * _bodiesPerGroup);
        for (var i = group * _bodiesPerGroup; i < end; i++)
        {
            _act!(_steppers[group].Stepper, i);
        }
    }
}
