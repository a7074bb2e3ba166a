using System.Collections.Immutable;

namespace FractalEngine.Core.Scenes.Films;

/// <summary>How the camera of a scene, and named numbers of its fractals, change in the course of time.</summary>
/// <param name="Duration">Seconds, positive.</param>
public sealed record Film(double Duration)
{
    /// <summary>Longest film, seconds: what its frames are rendered from takes hours.</summary>
    public const double MaxDuration = 3600;

    /// <summary>Keys, in the order of the file: of one thing, each is later than the one before.</summary>
    public ImmutableArray<FilmKey> Keys { get; init; } = [];

    /// <summary>Those of the keys that are cameras, in their order.</summary>
    public IEnumerable<CameraKey> Cameras => Keys.OfType<CameraKey>();

    /// <summary>Whether any number changes, and with it the shape of a fractal.</summary>
    public bool HasNumbers => Keys.Any(static key => key is NumberKey);

    /// <summary>Returns the values of all numbers that have keys.</summary>
    /// <param name="time">Seconds; before its first key and after its last, a number has the value of that key.</param>
    public ImmutableDictionary<string, double> ValuesAt(double time)
    {
        var values = ImmutableDictionary.CreateBuilder<string, double>();
        foreach (var track in Keys.OfType<NumberKey>().GroupBy(static key => key.Name))
        {
            var before = track.First();
            values[track.Key] = before.Value;
            foreach (var key in track.Skip(1))
            {
                if (time > before.Time)
                {
                    var progress = key.ProgressAt(before.Time, time);
                    values[track.Key] = ((1 - progress) * before.Value) + (progress * key.Value);
                }

                before = key;
            }
        }

        return values.ToImmutable();
    }

    /// <summary>Whether all numbers have the same values at two times, seconds.</summary>
    public bool HasSameValuesAt(double time1, double time2)
    {
        var others = ValuesAt(time2);
        return ValuesAt(time1).All(pair => others[pair.Key].Equals(pair.Value));
    }

    /// <inheritdoc/>
    public bool Equals(Film? other) => other is not null && Duration.Equals(other.Duration) && Keys.SequenceEqual(other.Keys);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Duration, Keys.Length);
}
