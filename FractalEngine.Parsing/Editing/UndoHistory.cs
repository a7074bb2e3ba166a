using System.Collections.Immutable;

namespace FractalEngine.Parsing.Editing;

/// <summary>An immutable line of states with a present one. Each step back can be made again until another state is recorded.</summary>
/// <param name="Present">The state that is shown at present.</param>
/// <typeparam name="T">Immutable states that are equal where nothing has changed.</typeparam>
public sealed record UndoHistory<T>(T Present)
    where T : IEquatable<T>
{
    /// <summary>Maximum number of steps that can be undone.</summary>
    public const int MaxSteps = 100;

    // The last of each is the next to return to.
    private ImmutableList<T> Earlier { get; init; } = [];

    private ImmutableList<T> Later { get; init; } = [];

    /// <summary>Makes a state the present one. A state that equals the present one is no step.</summary>
    public UndoHistory<T> Record(T state) => state.Equals(Present) ? this
        : new(state) { Earlier = (Earlier.Count < MaxSteps ? Earlier : Earlier.RemoveAt(0)).Add(Present) };

    /// <summary>Replaces all states, since what they refer to has changed.</summary>
    public UndoHistory<T> Transform(Func<T, T> transform) =>
        new(transform(Present)) { Earlier = Earlier.ConvertAll(transform), Later = Later.ConvertAll(transform) };

    /// <summary>Returns to the state before the present one; null where there is none.</summary>
    public UndoHistory<T>? Undo() => Earlier is not [.., var last] ? null
        : new(last) { Earlier = Earlier.RemoveAt(Earlier.Count - 1), Later = Later.Add(Present) };

    /// <summary>Returns to the state that the last <see cref="Undo"/> left; null where there is none.</summary>
    public UndoHistory<T>? Redo() => Later is not [.., var next] ? null
        : new(next) { Earlier = Earlier.Add(Present), Later = Later.RemoveAt(Later.Count - 1) };
}
