namespace FractalEngine.Core.Scenes.Films;

/// <summary>What a film shows at one time: a camera, or the value of a number.</summary>
/// <param name="Time">Seconds since the beginning of the film.</param>
public abstract record FilmKey(double Time)
{
    /// <summary>How the way from the key before to this one passes.</summary>
    public Ease Ease { get; init; }

    /// <summary>What the key is of, and what it gives that, as the words and numbers of a scene file in their order.</summary>
    public abstract IReadOnlyList<object> Declaration { get; }

    /// <summary>Tells whether another key is of the same thing, so that there is a way from one to the other.</summary>
    /// <param name="other">Any key.</param>
    public abstract bool IsOfSame(FilmKey other);

    /// <summary>Returns how far the way to this key has come.</summary>
    /// <param name="start">Time of the key before, seconds; less than that of this key.</param>
    /// <param name="time">Any time, seconds.</param>
    /// <returns>0 at the key before and earlier, 1 at this key and later.</returns>
    public double ProgressAt(double start, double time)
    {
        var fraction = Math.Clamp((time - start) / (Time - start), 0, 1);
        return Ease switch
        {
            Ease.In => fraction * fraction,
            Ease.Out => fraction * (2 - fraction),
            Ease.InOut => fraction * fraction * (3 - (2 * fraction)),
            Ease.Hold => Math.Floor(fraction),
            _ => fraction,
        };
    }
}
