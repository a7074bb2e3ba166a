namespace FractalEngine.Core.Scenes.Films;

/// <summary>The value that a named number of the scene's fractals has at a time of a film.</summary>
/// <param name="Time">Seconds since the beginning of the film.</param>
/// <param name="Name">Name of the number, as the fractals declare it.</param>
/// <param name="Value">Finite.</param>
public sealed record NumberKey(double Time, string Name, double Value) : FilmKey(Time)
{
    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => [Name, "=", Value];

    /// <inheritdoc/>
    public override bool IsOfSame(FilmKey other) => other is NumberKey { Name: var name } && name == Name;
}
