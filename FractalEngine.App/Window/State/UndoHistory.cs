namespace FractalEngine.App.Window.State;

/// <summary>A line of states with a present one. Each step back can be made again until another state is recorded.</summary>
/// <param name="first">The first state.</param>
/// <typeparam name="T">Immutable states that are equal where nothing has changed.</typeparam>
internal sealed class UndoHistory<T>(T first)
    where T : IEquatable<T>
{
    /// <summary>Maximum number of steps that can be undone.</summary>
    public const int MaxSteps = 100;

    private readonly LinkedList<T> _earlier = [];
    private readonly Stack<T> _later = [];

    /// <summary>The state that is shown at present.</summary>
    public T Present { get; private set; } = first;

    /// <summary>Makes a state the present one. A state that equals the present one is no step.</summary>
    public void Record(T state)
    {
        if (state.Equals(Present))
        {
            return;
        }

        _earlier.AddLast(Present);
        if (_earlier.Count > MaxSteps)
        {
            _earlier.RemoveFirst();
        }

        _later.Clear();
        Present = state;
    }

    /// <summary>Replaces the present state by one that looks the same. That is no step.</summary>
    public void ReplacePresent(T state) => Present = state;

    /// <summary>Replaces all states, since what they refer to has changed.</summary>
    public void Transform(Func<T, T> transform)
    {
        Present = transform(Present);
        for (var node = _earlier.First; node is not null; node = node.Next)
        {
            node.Value = transform(node.Value);
        }

        var later = _later.Reverse().Select(transform).ToArray();
        _later.Clear();
        Array.ForEach(later, _later.Push);
    }

    /// <summary>Returns to the state before the present one.</summary>
    /// <returns>False when there is none.</returns>
    public bool TryUndo()
    {
        if (_earlier.Last is not { } last)
        {
            return false;
        }

        _later.Push(Present);
        Present = last.Value;
        _earlier.RemoveLast();
        return true;
    }

    /// <summary>Returns to the state that the last <see cref="TryUndo"/> left.</summary>
    /// <returns>False when there is none.</returns>
    public bool TryRedo()
    {
        if (!_later.TryPop(out var next))
        {
            return false;
        }

        _earlier.AddLast(Present);
        Present = next;
        return true;
    }
}
